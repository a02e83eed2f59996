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

/// Documents and plugins, put together into what a run needs.
namespace kerf {

/// Everything that is known before the first tick. [main]
struct Scene {
    Procedure procedure;
    Anatomy anatomy;
    Body body;                                   ///< of a fractured bone what is behind the fracture
    std::optional<Body> whole{};                 ///< of a fractured bone: before it broke
    std::optional<Body> fragment{};              ///< the rest of it: body 1
    Pose world_from_fragment = identity_pose();  ///< at first
    std::vector<AxisFrame> frames;               ///< one per step, in the whole bone
    std::vector<double> share_in_bone;           ///< of each step's axis behind its entry [–]
    std::vector<Tool> tools;                     ///< those that steps use
    std::vector<std::size_t> tool_of_step;       ///< for each step: which of them
    [[nodiscard]] const Tool& tool(std::size_t step) const noexcept { return tools[tool_of_step[step]]; }
    std::vector<std::optional<Guide>> guides;  ///< one per step: the sleeve through which its instrument works
    std::vector<Body> implants;                ///< that a hand may bring in, each in its own frame
    std::vector<std::optional<Pose>> planned;  ///< of each implant, LPS from its frame; nothing: it has no place
    std::vector<StepHole> holes;               ///< steps that follow a hole of an implant
    /// For each tool: what of it stays as a body when its driver leaves, in its frame; nothing: it stays unseen.
    std::vector<std::optional<Body>> staying;
    std::vector<MeasureReading> measured_before;  ///< of the procedure's measures, before the first cut
    const DeviceRecord* device = nullptr;
    CouplingGains gains;
    double work_force = 0.0;         ///< [N] the scale was made for
    ImportReport import;             ///< what import did
    std::uint64_t anatomy_hash = 0;  ///< of the anatomy's text and its data files
};

/// Returns the instrument of a tool that some step uses.   [any] pure.
[[nodiscard]] const Instrument& instrument_of(const Scene& scene, std::size_t tool);

/// Returns the landmark plane of a step; null: it has none.   [any] pure.
[[nodiscard]] const LandmarkPlane* plane_of(const Step& step, const Anatomy& anatomy);

/// Makes the bone of checked documents and checks what needs it. Error: in `diagnostics`.
[[nodiscard]] std::optional<Scene> make_scene(Documents documents, Diagnostics& diagnostics,
                                              const ImportOptions& options = {});

/// Reads and checks everything. `anatomy_file` empty: the procedure's own.
/// Error: whatever is wrong with the documents, all of it, in `diagnostics`.
[[nodiscard]] std::optional<Scene> make_scene(const std::string& procedure_file, const std::string& anatomy_file,
                                              const PluginRegistry& plugins, Diagnostics& diagnostics,
                                              const ImportOptions& options = {});

/// A rehearsal's intent as legs of the simulated hand, and where it starts.
struct HandPlan {
    simulated_hand::Plant plant;
    simulated_hand::Intent intent;
    Pose start = identity_pose();
    std::vector<std::vector<HandInput>> inputs;  ///< asked for at the start, and at the end of each leg
};
[[nodiscard]] HandPlan plan_of(const Rehearsal& rehearsal, const Scene& scene);

}  // namespace kerf
