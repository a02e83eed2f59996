// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "run/live/live_loop.h"
#include "run/live/recorded_hand.h"
#include "run/run.h"

namespace kerf::run {

/// A run that follows a loop on a clock, with the loop and the link between both. One thread calls `tick`, for example
/// the servo callback of a device; another calls `follow` until `has_ended`, then `finish`.
class FollowedRun {
public:
    /// Returns null with the reason in `refusal`. Pre: scene and plugins outlive the run.   [main]
    [[nodiscard]] static std::unique_ptr<FollowedRun> create(const Scene& scene, const PluginRegistry& plugins,
                                                             const RunRequest& request, RunOutcome& refusal);
    [[nodiscard]] Run& run() noexcept { return *run_; }

    /// Makes the loop for a hand, which must outlive it. First repeats the recorded run with which the request begins.
    /// Pre: called once, before the first tick.   [main]
    /// @param is_alone  one thread does all: the run catches up with each tick within `tick`
    void begin(LiveHand& hand, bool is_alone, TickParts* parts = nullptr);
    /// Runs one tick after this number of missed periods. Returns whether the loop continues.
    /// [haptic] unless it is alone, it neither allocates nor blocks
    bool tick(std::uint32_t missed);
    /// Repeats the ticks that the loop has run, then sleeps for 0.2 ms. An exception ends the loop.   [main]
    void follow();
    /// Returns whether the loop has ended.   [any]
    [[nodiscard]] bool has_ended() const noexcept { return has_loop_ended_.load(std::memory_order_acquire); }
    /// Adds the figures of the clock to the result, with the loop's fades. Pre: the loop has ended.   [main]
    void set_clock(session::ClockRow clock);
    /// Judges the run and writes its results. Pre: the loop has ended.   [main]
    [[nodiscard]] RunOutcome finish();

private:
    FollowedRun(const Scene& scene, std::unique_ptr<Run> run);
    void repeat_beginning(RecordedHand& hand);
    void catch_up();
    void stop() noexcept;

    const Scene* scene_;
    LoopLink link_;
    std::unique_ptr<Run> run_;
    std::unique_ptr<HapticLoop> second_loop_;  ///< until `begin`
    std::optional<LiveLoop> loop_;
    bool has_run_ended_ = false;
    std::atomic<bool> has_loop_ended_{false};
};

}  // namespace kerf::run
