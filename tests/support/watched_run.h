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
    struct Watcher final : RunObserver {
        WatchedRun run;
        void on_tick(const TickRow& row) override { run.ticks.push_back(row); }
        void on_event(const EventRow& event) override { run.events.push_back(event); }
    } watcher;
    request.observers.push_back(&watcher);
    static_cast<RunOutcome&>(watcher.run) = run_procedure(scene, plugins, request);
    return std::move(watcher.run);
}

}  // namespace kerf::test
