// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bone/report/import_report.h"
#include "core/field/grid/body.h"
#include "core/haptics/scene/simulation.h"
#include "core/plugin/loader.h"
#include "devices/simulated_hand/simulated_hand.h"
#include "documents/anatomy.h"
#include "documents/procedure.h"
#include "run/documents.h"
#include "run/plate.h"
#include "run/verdict/step_monitor.h"
#include "text/result.h"

/// Builds the input of a run from documents and plugins.
namespace kerf::run {

/// All data that are known before the first tick. [main]
struct Scene {
    documents::Procedure procedure;
    documents::Anatomy anatomy;
    Body body;                                   ///< of a fractured bone: the part behind the fracture
    std::optional<Body> whole{};                 ///< of a fractured bone: the bone before it broke
    std::optional<Body> fragment{};              ///< of a fractured bone: the other part, body 1
    Pose world_from_fragment = identity_pose();  ///< before the first tick
    std::vector<AxisFrame> frames;               ///< one per step, in the whole bone
    std::vector<double> fraction_in_bone;  ///< [–] for each step: fraction of its axis beyond the entry that is in bone
    std::vector<Tool> tools;               ///< the tools of the steps
    std::vector<std::size_t> tool_of_step;  ///< for each step: index into `tools`
    [[nodiscard]] const Tool& tool(std::size_t step) const noexcept { return tools[tool_of_step[step]]; }
    std::vector<std::optional<Guide>> guides;  ///< one per step: the sleeve that guides its instrument
    std::vector<Body> implants;                ///< implants that a hand may insert, each in its own frame
    std::vector<std::optional<Pose>> planned;  ///< planned pose of each implant, LPS from its frame; nothing: none
    std::vector<StepHole> holes;               ///< steps that follow a hole of an implant
    /// For each tool: the body that stays when its driver leaves, in the tool's frame; nothing: the implant is not
    /// drawn.
    std::vector<std::optional<Body>> staying;
    std::vector<documents::MeasureReading> measured_before;  ///< of the procedure's measures, before the first cut
    const DeviceRecord* device = nullptr;
    CouplingGains gains;
    double work_force = 0.0;         ///< [N] for which the force scale was computed
    bone::ImportReport import;       ///< of the import
    std::uint64_t anatomy_hash = 0;  ///< of the anatomy's text and data files
};

/// Returns the instrument of a tool. Pre: a step uses it.   [any] pure.
[[nodiscard]] const documents::Instrument& instrument_of(const Scene& scene, std::size_t tool);

/// Returns the landmark plane of a step, or null.   [any] pure.
[[nodiscard]] const documents::LandmarkPlane* plane_of(const documents::Step& step, const documents::Anatomy& anatomy);

/// Makes the bone of checked documents and runs the checks that need bone. Error: all that they found.
[[nodiscard]] text::Result<Scene> make_scene(Documents documents, const bone::ImportOptions& options = {});

/// Reads and checks all documents and makes the scene. `anatomy_file` empty: the one that the procedure names. Error:
/// all mistakes of the documents.
[[nodiscard]] text::Result<Scene> make_scene(const std::string& procedure_file, const std::string& anatomy_file,
                                             const PluginRegistry& plugins, const bone::ImportOptions& options = {});

/// A rehearsal as legs of the simulated hand, with its start pose.
struct HandPlan {
    simulated_hand::Plant plant;
    simulated_hand::Intent intent;
    Pose start = identity_pose();
    std::vector<std::vector<documents::HandInput>> inputs;  ///< at the start, and at the end of each leg
};
/// Returns the plan of a rehearsal.   [main]
[[nodiscard]] HandPlan plan_of(const documents::Rehearsal& rehearsal, const Scene& scene);

}  // namespace kerf::run
