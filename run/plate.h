// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/field/cut/cut_field.h"
#include "core/field/grid/body.h"
#include "core/haptics/law/tool.h"
#include "core/haptics/scene/simulation.h"
#include "documents/anatomy.h"
#include "documents/implant_plan.h"
#include "documents/procedure.h"
#include "run/verdict/step_monitor.h"

/// Plates: their fit on bone, and the steps that follow their holes.
namespace kerf::run {

/// Distances to the bone of several bodies, in the world frame.
class BoneAround {
public:
    /// An imported bone before any cut.
    explicit BoneAround(const Body& bone) { parts_.push_back({&bone, nullptr, identity_pose()}); }
    /// The present bone of all bodies at their present poses. Pre: the simulation does not advance during its lifetime.
    explicit BoneAround(const Simulation& simulation);

    /// Returns the signed distance to the present bone [m], negative inside, clamped to ± `clamp`.
    [[nodiscard]] double distance(Vec3 point_in_world) const noexcept;
    /// Returns the same for the uncut bone.
    [[nodiscard]] double uncut(Vec3 point_in_world) const noexcept;
    /// Returns the largest distance known in all bodies [m].
    [[nodiscard]] double clamp() const noexcept;
    /// Returns the spacing of the finest body [m].
    [[nodiscard]] double spacing() const noexcept;

private:
    struct Part {
        const Body* bone;
        const CutField* cut;  ///< null: no cut
        Pose bone_from_world;
    };
    std::vector<Part> parts_;
};

/// Fit of a metal solid on bone.
struct PlateFit {
    double gap = 0.0;               ///< [m] between its surface and the nearest bone; at most `farthest_gap`
    double fraction_in_bone = 0.0;  ///< [–] fraction of its volume that is in bone
    double deepest = 0.0;           ///< [m] maximum depth of its metal below the surface of bone
};
inline constexpr double farthest_gap = 10e-3;       ///< [m] largest measured gap
inline constexpr double max_plate_gap = 3e-3;       ///< [m]
inline constexpr double max_plate_fraction = 0.15;  ///< [–]
inline constexpr double max_plate_depth = 3e-3;     ///< [m]

/// Measures the fit of a plate, to within half the spacing of its field.   [main]
[[nodiscard]] PlateFit fit_of(const Body& plate, const Pose& world_from_plate, const BoneAround& bone);

/// Returns why a plate does not fit; empty if it does. It must be within 3 mm of bone, have at most 15 % of its volume
/// in bone, and be at most 3 mm deep.   [any] pure.
[[nodiscard]] std::string misfit(const PlateFit& fit);

/// Refuses a planned pose that is off the bone, or through it (E0522, E0523).   [main]
void check_plate(const documents::Procedure& procedure, const documents::Implant& implant, const PlateFit& fit,
                 text::Diagnostics& diagnostics);

/// Refuses holes of an implant that are blocked by metal, or not surrounded by it (E0521).
/// @param distance   signed distance to its surface, negative inside, implant frame [m] → [m]
/// @return           one for each hole   [main]
std::vector<documents::HoleInMetal> check_holes(const documents::Procedure& procedure,
                                                const documents::Implant& implant,
                                                const std::function<double(Vec3)>& distance,
                                                text::Diagnostics& diagnostics);
/// Same as `check_holes`, for implants made of parts, which need no bone.   [main]
void check_holes_of_parts(const documents::Procedure& procedure, text::Diagnostics& diagnostics);

/// Returns the hole that a step follows; nothing for a step on a landmark. Pre: the procedure outlives the result.
/// [main]
[[nodiscard]] std::optional<documents::NamedHole> hole_of_step(const documents::Procedure& procedure,
                                                               const documents::Step& step);

/// Refuses screws that do not fit the hole of their step: the thread is wider than the hole, or the head is narrower
/// (E0525, E0526).
/// @param tools   one for each step   [main]
void check_screws_of_plates(const documents::Procedure& procedure, const std::vector<const ToolOutline*>& tools,
                            text::Diagnostics& diagnostics);

/// Refuses rehearsals that are expected to pass but use a hole of an implant that they have not placed (E0527).
/// [main]
void check_plates_are_placed(const documents::Procedure& procedure, text::Diagnostics& diagnostics);

/// A step that follows a hole of an implant.
struct StepHole {
    std::size_t step = 0, implant = 0;  ///< indices in the procedure
    documents::ImplantHole hole;        ///< implant frame
    documents::HoleInMetal metal;
};

/// Returns the frame of a step on a hole of an implant at a pose, in the world frame of `bone`. Its entry is the first
/// uncut bone on the hole's axis, else the middle of the metal.   [main]
[[nodiscard]] AxisFrame frame_of(const StepHole& hole, const Pose& world_from_implant, const BoneAround& bone,
                                 const documents::Anatomy& anatomy, const documents::LandmarkPlane* plane = nullptr);

}  // namespace kerf::run
