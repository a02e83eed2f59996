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

/// Plates: how they lie on bone, and the steps that follow their holes.
namespace kerf {

/// Bone in several bodies, seen from the world.
class BoneAround {
public:
    /// A bone before any cut, where it was imported.
    explicit BoneAround(const Body& bone) { parts_.push_back({&bone, nullptr, identity_pose()}); }
    /// What is left of all bodies of bone, where they are now. The simulation must not go on meanwhile.
    explicit BoneAround(const Simulation& simulation);

    /// To the bone that is left [m], negative inside, within ± `clamp`.
    [[nodiscard]] double distance(Vec3 point_in_world) const noexcept;
    /// The same before any cut.
    [[nodiscard]] double uncut(Vec3 point_in_world) const noexcept;
    /// [m] up to which all distances are known.
    [[nodiscard]] double clamp() const noexcept;
    /// [m] of the finest body.
    [[nodiscard]] double spacing() const noexcept;

private:
    struct Part {
        const Body* bone;
        const CutField* cut;  ///< null: nothing is cut
        Pose bone_from_world;
    };
    std::vector<Part> parts_;
};

/// How a solid of metal lies on bone.
struct PlateFit {
    double gap = 0.0;      ///< [m] between its surface and the nearest bone; `farthest_gap`: that or more
    double share = 0.0;    ///< [–] of its volume that is in bone
    double deepest = 0.0;  ///< [m] of its metal below the surface of bone
};
inline constexpr double farthest_gap = 10e-3;    ///< [m] up to which a gap is measured
inline constexpr double max_plate_gap = 3e-3;    ///< [m]
inline constexpr double max_plate_share = 0.15;  ///< [–]
inline constexpr double max_plate_depth = 3e-3;  ///< [m]

/// Measures the fit of a plate, to within half the spacing of its field.   [main]
[[nodiscard]] PlateFit fit_of(const Body& plate, const Pose& world_from_plate, const BoneAround& bone);

/// Returns why a plate does not lie on bone; empty if it does: within 3 mm of bone, at most 15 % of its volume in bone,
/// and at most 3 mm deep.   [any] pure.
[[nodiscard]] std::string misfit(const PlateFit& fit);

/// Refuses a planned pose that meets no bone, or lies through it (E0522, E0523).   [main]
void check_plate(const Procedure& procedure, const Implant& implant, const PlateFit& fit, Diagnostics& diagnostics);

/// Refuses holes of an implant that metal closes or does not surround (E0521).
/// @param distance   to its surface, negative inside, implant frame [m] → [m]
/// @return           one for each hole   [main]
std::vector<HoleInMetal> check_holes(const Procedure& procedure, const Implant& implant,
                                     const std::function<double(Vec3)>& distance, Diagnostics& diagnostics);
/// The same for implants of parts, which need no bone.   [main]
void check_holes_of_parts(const Procedure& procedure, Diagnostics& diagnostics);

/// Returns the hole that a step follows; nothing for a step on a landmark. The procedure must outlive it.   [main]
[[nodiscard]] std::optional<NamedHole> hole_of_step(const Procedure& procedure, const Step& step);

/// Refuses screws that do not fit the hole that their step follows: a thread that is wider, or a head that is narrower
/// (E0525, E0526).
/// @param tools   one for each step   [main]
void check_screws_of_plates(const Procedure& procedure, const std::vector<const ToolOutline*>& tools,
                            Diagnostics& diagnostics);

/// Refuses rehearsals that are to pass, and work on a hole of an implant that they have not placed (E0527).   [main]
void check_plates_are_placed(const Procedure& procedure, Diagnostics& diagnostics);

/// A step that follows a hole of an implant.
struct StepHole {
    std::size_t step = 0, implant = 0;  ///< among those of the procedure
    ImplantHole hole;                   ///< implant frame
    HoleInMetal metal;
};

/// Returns the frame of a step on a hole of an implant at a pose, in the frame of `bone`'s world: from where the hole's
/// axis first meets uncut bone, else from the middle of the metal.   [main]
[[nodiscard]] AxisFrame frame_of(const StepHole& hole, const Pose& world_from_implant, const BoneAround& bone,
                                 const Anatomy& anatomy, const LandmarkPlane* plane = nullptr);

}  // namespace kerf
