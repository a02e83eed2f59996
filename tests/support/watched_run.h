// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "run/run_procedure.h"

namespace kerf::test {

/// A run with all its rows, which `run_procedure` does not keep.
struct WatchedRun : run::RunOutcome {
    std::vector<session::TickRow> ticks;
    std::vector<session::EventRow> events;
};

inline WatchedRun watched_run(const run::Scene& scene, const PluginRegistry& plugins, run::RunRequest request) {
    struct Watcher final : run::RunObserver {
        WatchedRun run;
        void on_tick(const session::TickRow& row) override { run.ticks.push_back(row); }
        void on_event(const session::EventRow& event) override { run.events.push_back(event); }
    } watcher;
    request.observers.push_back(&watcher);
    static_cast<run::RunOutcome&>(watcher.run) = run::run_procedure(scene, plugins, request);
    return std::move(watcher.run);
}

}  // namespace kerf::test
