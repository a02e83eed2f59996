// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "documents/read_procedure.h"
#include "tests/support/drill_rig.h"
#include "tests/support/recorded_operation.h"
#include "tests/support/watched_run.h"

/// Operations that tests rehearse.
namespace kerf::test {

/// Returns the scene of a request. Throws what is wrong with it, and the test fails with that.
inline run::Scene scene_of(const run::DocumentRequest& request) {
    text::Diagnostics diagnostics;
    auto documents = run::check_documents(request, plugins()).take(diagnostics);
    auto made = documents ? make_scene(std::move(*documents)).take(diagnostics) : std::nullopt;
    if (!made) throw std::runtime_error(to_text(diagnostics));
    return std::move(*made);
}
inline run::Scene scene_of(const std::string& procedure, const std::string& variant = "",
                           const std::vector<std::string>& settings = {}, const std::string& anatomy = "") {
    run::DocumentRequest request{.procedure = procedure, .anatomy = anatomy};
    request.changes = {variant, settings};
    return scene_of(request);
}

/// The first rehearsal where none is named.
inline WatchedRun rehearsed(const run::Scene& scene, const std::string& rehearsal = "") {
    run::RunRequest request;
    request.rehearsal = rehearsal;
    return watched_run(scene, plugins(), request);
}

/// Rehearsals of one scene; each is run once. Those of a shipped operation are read from the sessions that a ctest
/// fixture has left, where ctest runs the test; the scene is not made then.
class Rehearsals {
public:
    /// @param operation  procedure of kerf_add_operation(), "amputation"
    Rehearsals(const run::Scene& (*scene)(), std::string operation) : scene_(scene), operation_(std::move(operation)) {}

    /// Returns the run without its ticks, which take seconds to read.
    const WatchedRun& operator[](const std::string& rehearsal) {
        const auto found = runs_.find(rehearsal);
        return found != runs_.end() ? found->second : runs_.emplace(rehearsal, made(rehearsal)).first->second;
    }
    /// The same with all ticks.
    const WatchedRun& with_ticks(const std::string& rehearsal) {
        static_cast<void>((*this)[rehearsal]);
        WatchedRun& run = runs_.at(rehearsal);
        if (run.ticks.empty()) run.ticks = recorded_ticks(folder_of(rehearsal));
        return run;
    }

private:
    [[nodiscard]] std::string folder_of(const std::string& id) const { return recorded_folder(operation_ + "/" + id); }
    [[nodiscard]] WatchedRun made(const std::string& id) const {
        const std::string folder = folder_of(id);
        if (folder.empty()) return rehearsed(scene_(), id);
        text::Diagnostics diagnostics;
        const auto procedure =
            documents::read_procedure(KERF_SOURCE_DIR "/procedures/" + operation_ + ".yaml", plugins().catalog())
                .take(diagnostics);
        if (!procedure) throw std::runtime_error(to_text(diagnostics));
        for (const documents::Rehearsal& rehearsal : procedure->rehearsals)
            if (rehearsal.id == id) return recorded_run(folder, rehearsal);
        throw std::runtime_error("no rehearsal " + id);
    }

    const run::Scene& (*scene_)();
    std::string operation_;
    std::map<std::string, WatchedRun> runs_;
};

inline const session::MetricRow& metric_row(const session::RunSummary& summary, const std::string& id) {
    for (const session::MetricRow& row : summary.metrics)
        if (row.id == id) return row;
    throw std::runtime_error("no metric " + id);
}
inline double metric(const session::RunSummary& summary, const std::string& id) {
    return metric_row(summary, id).value;
}

/// A line for each reason of the verdict, after the error if there is one.
inline std::string reasons_of(const run::RunOutcome& run) {
    std::string reasons = run.error;
    for (const std::string& reason : run.summary.reasons) reasons += reason + "\n";
    return reasons;
}

}  // namespace kerf::test
