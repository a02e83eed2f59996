// SPDX-License-Identifier: Apache-2.0
#include "run/live_run.h"

#include <sys/utsname.h>

#include <cstdlib>
#include <memory>

#include "run/clock/realtime_thread.h"
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

session::ClockRow::Times times_of(const CallTimes& times) {
    const auto at = [&](double fraction) { return 1e-9 * static_cast<double>(times.within(fraction)); };
    return {at(0.5), at(0.99), at(0.999), 1e-9 * static_cast<double>(times.longest())};
}

session::ClockRow row_of(const TickTimes& times, const RealtimeState& state) {
    session::ClockRow row;
    row.period = Simulation::dt;
    row.ticks = times.ticks;
    row.late_ticks = times.late;
    row.missed_periods = times.missed;
    row.pauses = times.pauses;
    row.over_period = times.over_period;
    row.lateness = times_of(times.lateness);
    row.compute = times_of(times.compute);
    row.priority = state.priority;
    row.is_memory_locked = state.is_locked;
    row.refusals = state.refusals;
    double load = 0.0;
    if (getloadavg(&load, 1) == 1) row.load = load;
    if (utsname system{}; uname(&system) == 0) row.kernel = system.release;
    return row;
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
    WallClock clock(Simulation::dt);
    const RealtimeState state = run_in_real_time([&] { tick_until_done(*run, clock); });
    run->set_clock(row_of(clock.times(), state));
    return run->finish();
}

}  // namespace kerf::run
