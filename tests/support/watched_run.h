// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "run/run_procedure.h"

namespace kerf::test {

/// A run with all its rows, which `run_procedure` does not keep.
struct WatchedRun : RunOutcome {
    std::vector<TickRow> ticks;
    std::vector<EventRow> events;
};

inline WatchedRun watched_run(const Scene& scene, const PluginRegistry& plugins, RunRequest request) {
    WatchedRun run;
    request.on_tick = [&](const TickRow& row) { run.ticks.push_back(row); };
    request.on_event = [&](const EventRow& event) { run.events.push_back(event); };
    static_cast<RunOutcome&>(run) = run_procedure(scene, plugins, request);
    return run;
}

}  // namespace kerf::test
