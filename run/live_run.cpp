// SPDX-License-Identifier: Apache-2.0
#include "run/live_run.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "run/clock/clock_row.h"
#include "run/clock/realtime_thread.h"
#include "run/clock/thread_watch.h"
#include "run/clock/wall_clock.h"
#include "run/device/device_hand.h"
#include "run/run.h"

namespace kerf::run {

namespace {

/// Runs one tick after this number of missed periods. Returns whether the run continues.
using Tick = std::function<bool(std::uint32_t missed)>;

void tick_until_done(const Tick& tick, TickClock& clock) {
    for (bool has_more = true; has_more;) {
        const std::uint32_t missed = clock.wait();
        has_more = tick(missed);
        clock.tick_done();
    }
}

/// A run with a hand at a device.
class LedRun final : ForceSink, RunObserver {
public:
    /// Returns null with the reason in `refusal`. Pre: the device outlives the run.
    static std::unique_ptr<LedRun> create(const Scene& scene, const PluginRegistry& plugins, RunRequest request,
                                          OpenedDevice& device, const documents::DeviceStation& station,
                                          RunOutcome& refusal) {
        std::unique_ptr<LedRun> led(new LedRun(device));
        request.is_led = true;
        request.observers.push_back(led.get());
        led->run_ = Run::create(scene, plugins, request, refusal);
        if (led->run_ == nullptr) return nullptr;
        led->hand_.emplace(station, device.facts(), led->run_->simulation().world_from_tool(),
                           arm_at(*scene.device, scene.gains.force_scale));
        led->run_->send_to(*led);
        led->run_->prepare(led->hand_->presses());
        return led;
    }
    [[nodiscard]] Run& run() noexcept { return *run_; }
    bool tick(std::uint32_t missed) {
        DeviceSample sample = hand_->take(device_.read(), grip());
        sample.missed = missed;
        const bool has_more = run_->step(sample);
        // Now, so that the clock counts the time that it takes before the device is read again.
        if (has_more) run_->prepare(hand_->presses());
        if (!has_more) rest();
        return has_more;
    }

private:
    static constexpr std::uint64_t max_silence = 10'000;  // ticks

    explicit LedRun(OpenedDevice& device) : device_(device) {}
    [[nodiscard]] Vec3 grip() const noexcept { return {0, 0, run_->simulation().outline().handling.grip_z}; }
    /// Ends the force after the last tick, before results are written.
    void rest() noexcept {
        kerf_device_command none{};
        none.device_from_tool.rotation.w = 1.0;
        device_.write(none);
    }
    void write(const TickResult& result, std::uint64_t tick) noexcept override {
        device_.write(hand_->command(result, tick));
    }
    std::optional<RunEnd> end() override {
        return hand_->is_silent(max_silence) ? std::optional(RunEnd::device_silent) : std::nullopt;
    }

    OpenedDevice& device_;
    std::optional<DeviceHand> hand_;
    std::unique_ptr<Run> run_;
};

RunOutcome run_live(Run& run, const Tick& tick) {
    ThreadWatch watch(std::llround(Simulation::dt * 1e9));
    WallClock clock(Simulation::dt, &watch);
    run.begin_clock(clock.parts());
    LateTicks late;
    const RealtimeState state = run_in_real_time(
        [&] {
            watch.watch_this_thread();
            tick_until_done(tick, clock);
            late = watch.finish();
        },
        [&] { run.pass_progress_on(); });
    run.set_clock(clock_row(Simulation::dt, clock.times(), late, state));
    return run.finish();
}

}  // namespace

RunOutcome run_on_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                        TickClock& clock) {
    RunOutcome outcome;
    const auto run = Run::create(scene, plugins, request, outcome);
    if (run == nullptr) return outcome;
    tick_until_done([&](std::uint32_t missed) { return run->step_after(missed); }, clock);
    return run->finish();
}

RunOutcome run_on_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request, TickClock& clock,
                        OpenedDevice& device, const documents::DeviceStation& station) {
    RunOutcome outcome;
    const auto led = LedRun::create(scene, plugins, request, device, station, outcome);
    if (led == nullptr) return outcome;
    tick_until_done([&](std::uint32_t missed) { return led->tick(missed); }, clock);
    return led->run().finish();
}

RunOutcome run_live(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request) {
    RunOutcome outcome;
    const auto run = Run::create(scene, plugins, request, outcome);
    if (run == nullptr) return outcome;
    return run_live(*run, [&](std::uint32_t missed) { return run->step_after(missed); });
}

RunOutcome run_live(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request, OpenedDevice& device,
                    const documents::DeviceStation& station) {
    RunOutcome outcome;
    const auto led = LedRun::create(scene, plugins, request, device, station, outcome);
    if (led == nullptr) return outcome;
    return run_live(led->run(), [&](std::uint32_t missed) { return led->tick(missed); });
}

}  // namespace kerf::run
