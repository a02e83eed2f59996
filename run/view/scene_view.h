// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "run/scene.h"
#include "run/view/viewed_run.h"
#include "session/report/recorded_procedure.h"

namespace kerf::run {

/// The circumstances of a run that its viewer shows.
struct ViewedSetting {
    std::string mode{};      ///< "practice"
    std::string hand{};      ///< who leads the tool, for people
    std::string folder{};    ///< of the results, for people; empty: none
    std::string language{};  ///< of the procedure's words, as "de"; empty, or without a translation: its first one
    documents::Assist assist = documents::Assist::full;
    double repeated = 0.0;  ///< [s] of an earlier run, which this one repeats first
};

/// Returns what viewers draw of a scene and does not change: names, colours, shapes, steps in words. Of an examination
/// and without assistance it has no zone, no limit, no plan and no hint.   [main]
[[nodiscard]] ViewedScene viewed_scene(const Scene& scene, const ViewedSetting& setting);

/// Returns when a zone is drawn: always, if the procedure does not state it.   [any] pure
[[nodiscard]] documents::ZoneDisplay display_of(const documents::Zone& zone, const documents::Procedure& procedure);

/// Returns an id for people: "spinal_canal" as "spinal canal".   [any] pure
[[nodiscard]] std::string spaced(std::string id);

/// Returns a goal as a viewer shows it: "depth at least 35 mm".   [any] pure
[[nodiscard]] ViewedLimit viewed_goal(const documents::Goal& goal, const documents::Procedure& procedure);

/// Returns a limit as a viewer shows it: "thrust at most 60 N".   [any] pure
[[nodiscard]] ViewedLimit viewed_limit(const documents::Limit& limit, const documents::Procedure& procedure);

/// Returns a goal or limit of a recorded procedure as a viewer shows it.   [any] pure
[[nodiscard]] ViewedLimit viewed_demand(const session::RecordedDemand& demand);

/// Returns the tissues of a body with the colours that they have everywhere.   [any] pure
[[nodiscard]] std::vector<ViewedTissue> viewed_tissues(const Body& body);

}  // namespace kerf::run
