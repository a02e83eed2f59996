// SPDX-License-Identifier: Apache-2.0
#include "run/live_run.h"

#include <cmath>
#include <memory>

#include "run/clock/clock_row.h"
#include "run/clock/realtime_thread.h"
#include "run/clock/thread_watch.h"
#include "run/clock/wall_clock.h"
#include "run/run.h"

namespace kerf::run {

namespace {

void tick_until_done(Run& run, TickClock& clock) {
    for (bool has_more = true; has_more;) {
        const std::uint32_t missed = clock.wait();
        has_more = run.step_after(missed);
        clock.tick_done();
    }
}

}  // namespace

RunOutcome run_on_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                        TickClock& clock) {
    RunOutcome outcome;
    const auto run = Run::create(scene, plugins, request, outcome);
    if (run == nullptr) return outcome;
    tick_until_done(*run, clock);
    return run->finish();
}

RunOutcome run_live(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request) {
    RunOutcome outcome;
    const auto run = Run::create(scene, plugins, request, outcome);
    if (run == nullptr) return outcome;
    ThreadWatch watch(std::llround(Simulation::dt * 1e9));
    WallClock clock(Simulation::dt, &watch);
    run->begin_clock(clock.parts());
    LateTicks late;
    const RealtimeState state = run_in_real_time(
        [&] {
            watch.watch_this_thread();
            tick_until_done(*run, clock);
            late = watch.finish();
        },
        [&] { run->pass_progress_on(); });
    run->set_clock(clock_row(Simulation::dt, clock.times(), late, state));
    return run->finish();
}

}  // namespace kerf::run
