// SPDX-License-Identifier: Apache-2.0
#include "run/live_run.h"

#include <cmath>
#include <future>
#include <utility>

#include "run/clock/clock_row.h"
#include "run/clock/realtime_thread.h"
#include "run/clock/thread_watch.h"
#include "run/clock/wall_clock.h"
#include "run/live/followed_run.h"
#include "run/live/live_hands.h"
#include "run/live/live_mouse.h"

namespace kerf::run {

namespace {

void tick_until_done(FollowedRun& followed, TickClock& clock) {
    for (bool has_more = true; has_more;) {
        const std::uint32_t missed = clock.wait();
        has_more = followed.tick(missed);
        clock.tick_done();
    }
}

/// Ticks on this thread; the run catches up with each tick.
RunOutcome run_alone(FollowedRun& followed, LiveHand& hand, TickClock& clock) {
    followed.begin(hand, true);
    tick_until_done(followed, clock);
    return followed.finish();
}

/// Ticks on a thread of their own; the run follows on this one.
RunOutcome run_beside(FollowedRun& followed, LiveHand& hand, TickClock& clock) {
    followed.begin(hand, false);
    auto ticks = std::async(std::launch::async, [&] { tick_until_done(followed, clock); });
    while (!followed.has_ended()) followed.follow();
    ticks.get();
    return followed.finish();
}

/// Ticks on the wall clock, on a real-time thread; the run follows on this one.
RunOutcome run_live(FollowedRun& followed, LiveHand& hand) {
    ThreadWatch watch(std::llround(Simulation::dt * 1e9));
    WallClock clock(Simulation::dt, &watch);
    followed.begin(hand, false, &clock.parts());
    LateTicks late;
    const RealtimeState state = run_in_real_time(
        [&] {
            watch.watch_this_thread();
            tick_until_done(followed, clock);
            late = watch.finish();
        },
        [&] { followed.follow(); });
    followed.set_clock(clock_row(Simulation::dt, clock.times(), late, state));
    return followed.finish();
}

/// Calls `run(followed, hand)` with the hand of the rehearsal.
template <class RunWith>
RunOutcome with_rehearsal(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                          const RunWith& run) {
    RunOutcome outcome;
    const auto followed = FollowedRun::create(scene, plugins, request, outcome);
    if (followed == nullptr) return outcome;
    LiveRehearsal hand(followed->run().plan());
    return run(*followed, hand);
}

/// Calls `run(followed, hand)` with a hand at a device.
template <class RunWith>
RunOutcome with_device(const Scene& scene, const PluginRegistry& plugins, RunRequest request, OpenedDevice& device,
                       const documents::DeviceStation& station, const RunWith& run) {
    request.leader = device.name();
    request.leader_setup = station.text();
    RunOutcome outcome;
    const auto followed = FollowedRun::create(scene, plugins, request, outcome);
    if (followed == nullptr) return outcome;
    LiveDevice hand(device, station, followed->run().simulation().world_from_tool(),
                    arm_at(*scene.device, scene.gains.force_scale));
    return run(*followed, hand);
}

/// Calls `run(followed, hand)` with a hand at a mouse.
template <class RunWith>
RunOutcome with_mouse(const Scene& scene, const PluginRegistry& plugins, RunRequest request, MouseBox& box,
                      const RunWith& run) {
    request.leader = "mouse";
    request.is_led_by_mouse = true;
    RunOutcome outcome;
    const auto followed = FollowedRun::create(scene, plugins, request, outcome);
    if (followed == nullptr) return outcome;
    LiveMouse hand(box, scene, followed->run().rehearsal(), followed->run().simulation().world_from_tool());
    return run(*followed, hand);
}

}  // namespace

RunOutcome run_on_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                        TickClock& clock) {
    return with_rehearsal(scene, plugins, request,
                          [&](FollowedRun& followed, LiveHand& hand) { return run_alone(followed, hand, clock); });
}

RunOutcome run_beside_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                            TickClock& clock) {
    return with_rehearsal(scene, plugins, request,
                          [&](FollowedRun& followed, LiveHand& hand) { return run_beside(followed, hand, clock); });
}

RunOutcome run_on_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request, TickClock& clock,
                        OpenedDevice& device, const documents::DeviceStation& station) {
    return with_device(scene, plugins, request, device, station,
                       [&](FollowedRun& followed, LiveHand& hand) { return run_alone(followed, hand, clock); });
}

RunOutcome run_live(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request) {
    return with_rehearsal(scene, plugins, request,
                          [](FollowedRun& followed, LiveHand& hand) { return run_live(followed, hand); });
}

RunOutcome run_live(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request, OpenedDevice& device,
                    const documents::DeviceStation& station) {
    return with_device(scene, plugins, request, device, station,
                       [](FollowedRun& followed, LiveHand& hand) { return run_live(followed, hand); });
}

RunOutcome run_on_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request, TickClock& clock,
                        MouseBox& box) {
    return with_mouse(scene, plugins, request, box,
                      [&](FollowedRun& followed, LiveHand& hand) { return run_alone(followed, hand, clock); });
}

RunOutcome run_beside_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                            TickClock& clock, MouseBox& box) {
    return with_mouse(scene, plugins, request, box,
                      [&](FollowedRun& followed, LiveHand& hand) { return run_beside(followed, hand, clock); });
}

RunOutcome run_live(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request, MouseBox& box) {
    return with_mouse(scene, plugins, request, box,
                      [](FollowedRun& followed, LiveHand& hand) { return run_live(followed, hand); });
}

}  // namespace kerf::run
