// SPDX-License-Identifier: Apache-2.0
#include "run/live_run.h"

#include <chrono>
#include <cmath>
#include <functional>
#include <future>
#include <memory>
#include <thread>
#include <utility>

#include "run/clock/clock_row.h"
#include "run/clock/realtime_thread.h"
#include "run/clock/thread_watch.h"
#include "run/clock/wall_clock.h"
#include "run/live/live_hands.h"
#include "run/live/live_loop.h"
#include "run/run.h"

namespace kerf::run {

namespace {

/// A run that follows a loop on a clock, and the link between both.
class FollowedRun {
public:
    /// Returns null with the reason in `refusal`.
    static std::unique_ptr<FollowedRun> create(const Scene& scene, const PluginRegistry& plugins,
                                               const RunRequest& request, RunOutcome& refusal) {
        auto run = Run::create(scene, plugins, request, refusal);
        if (run == nullptr) return nullptr;
        return std::unique_ptr<FollowedRun>(new FollowedRun(scene, std::move(run)));
    }
    [[nodiscard]] Run& run() noexcept { return *run_; }

    /// Ticks with the hand until loop or run end. With `is_alone` the run catches up on this thread.   [haptic]
    void tick(TickClock& clock, LiveHand& hand, bool is_alone, TickParts* parts = nullptr) {
        LiveLoop loop(std::move(second_loop_), scene_, run_->plan(), run_->rehearsal(), link_, hand,
                      is_alone ? std::function<void()>([this] { catch_up(); }) : std::function<void()>());
        if (parts != nullptr) loop.measure(*parts);
        for (bool has_more = true; has_more;) {
            const std::uint32_t missed = clock.wait();
            has_more = loop.step(missed);
            clock.tick_done();
        }
    }
    /// Follows the loop for a moment. To be called again and again while it ticks on another thread.
    void follow() {
        try {
            catch_up();
        } catch (...) {
            stop();
            throw;
        }
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    /// Takes all messages that the loop has sent. Stops the loop when the run has ended.
    void catch_up() {
        while (const LoopMessage* message = link_.messages.front()) {
            if (!has_ended_ && !run_->take(*message)) stop();
            link_.messages.pop();
        }
    }
    /// Lets the loop end after its tick.
    void stop() noexcept {
        has_ended_ = true;
        link_.should_stop.store(true, std::memory_order_release);
    }
    /// Judges the run. Pre: the loop has ended.
    [[nodiscard]] RunOutcome finish() {
        catch_up();
        if (!has_ended_ && link_.is_overrun)
            static_cast<void>(
                run_->take({.kind = LoopMessage::Kind::ended, .index = static_cast<std::size_t>(RunEnd::fell_behind)}));
        return run_->finish();
    }

private:
    FollowedRun(const Scene& scene, std::unique_ptr<Run> run)
        : scene_(scene), run_(std::move(run)), second_loop_(run_->follow_loop(link_)) {}

    const Scene& scene_;
    LoopLink link_;
    std::unique_ptr<Run> run_;
    std::unique_ptr<HapticLoop> second_loop_;
    bool has_ended_ = false;
};

/// Ticks on the wall clock, on a real-time thread; the run follows on this one.
RunOutcome run_live(FollowedRun& followed, LiveHand& hand) {
    ThreadWatch watch(std::llround(Simulation::dt * 1e9));
    WallClock clock(Simulation::dt, &watch);
    LateTicks late;
    const RealtimeState state = run_in_real_time(
        [&] {
            watch.watch_this_thread();
            followed.tick(clock, hand, false, &clock.parts());
            late = watch.finish();
        },
        [&] { followed.follow(); });
    followed.run().set_clock(clock_row(Simulation::dt, clock.times(), late, state));
    return followed.finish();
}

RunRequest of_device(RunRequest request) {
    request.is_led = true;
    return request;
}

}  // namespace

RunOutcome run_on_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                        TickClock& clock) {
    RunOutcome outcome;
    const auto followed = FollowedRun::create(scene, plugins, request, outcome);
    if (followed == nullptr) return outcome;
    LiveRehearsal hand(followed->run().plan());
    followed->tick(clock, hand, true);
    return followed->finish();
}

RunOutcome run_beside_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                            TickClock& clock) {
    RunOutcome outcome;
    const auto followed = FollowedRun::create(scene, plugins, request, outcome);
    if (followed == nullptr) return outcome;
    LiveRehearsal hand(followed->run().plan());
    auto ticks = std::async(std::launch::async, [&] { followed->tick(clock, hand, false); });
    while (ticks.wait_for(std::chrono::seconds(0)) != std::future_status::ready) followed->follow();
    ticks.get();
    return followed->finish();
}

RunOutcome run_on_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request, TickClock& clock,
                        OpenedDevice& device, const documents::DeviceStation& station) {
    RunOutcome outcome;
    const auto followed = FollowedRun::create(scene, plugins, of_device(request), outcome);
    if (followed == nullptr) return outcome;
    LiveDevice hand(device, station, followed->run().simulation().world_from_tool());
    followed->tick(clock, hand, true);
    return followed->finish();
}

RunOutcome run_live(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request) {
    RunOutcome outcome;
    const auto followed = FollowedRun::create(scene, plugins, request, outcome);
    if (followed == nullptr) return outcome;
    LiveRehearsal hand(followed->run().plan());
    return run_live(*followed, hand);
}

RunOutcome run_live(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request, OpenedDevice& device,
                    const documents::DeviceStation& station) {
    RunOutcome outcome;
    const auto followed = FollowedRun::create(scene, plugins, of_device(request), outcome);
    if (followed == nullptr) return outcome;
    LiveDevice hand(device, station, followed->run().simulation().world_from_tool());
    return run_live(*followed, hand);
}

}  // namespace kerf::run
