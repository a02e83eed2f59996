// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "core/field/cut/cut_log.h"
#include "run/run_result.h"
#include "session/recording.h"

namespace kerf {
class Simulation;
}  // namespace kerf
namespace kerf::bone {
struct ExactSurface;
}  // namespace kerf::bone

namespace kerf::run {

class Run;

/// Watches a run: its session, a program's progress, a test. The run calls its observers between two ticks, in the
/// order of the request. An observer may block and allocate.   [main]
class RunObserver {
public:
    virtual ~RunObserver() = default;

    /// Receives the run before its first tick. It outlives all other calls.
    virtual void on_begin(Run& /*run*/) {}
    /// Receives an event, with its texts cut as in the session.
    virtual void on_event(const session::EventRow& /*event*/) {}
    /// Receives a record that the cut log has closed.
    virtual void on_cut(const CutRecord& /*cut*/) {}
    /// Receives the row of a tick, after the events of that tick.
    virtual void on_tick(const session::TickRow& /*row*/) {}
    /// Receives the completed fraction of the run [–] and its present activity: every 250 ticks, and with the fraction
    /// 1 for each activity after the last tick. On a clock another thread than the one that ticks calls it.
    virtual void on_progress(double /*fraction*/, const std::string& /*what*/) {}
    /// Receives the exact surface, before the result, if an instrument leaves one. Returns the error as text, empty on
    /// success.
    [[nodiscard]] virtual std::string on_exact_surface(const bone::ExactSurface& /*made*/) { return {}; }
    /// Returns the reason to end the run after this tick; nothing to continue.
    [[nodiscard]] virtual std::optional<RunEnd> end() { return std::nullopt; }
    /// Receives the result and the remaining bone. Returns the error as text, empty on success.
    [[nodiscard]] virtual std::string on_result(const session::RunSummary& /*summary*/,
                                                const Simulation& /*simulation*/) {
        return {};
    }
};

}  // namespace kerf::run
