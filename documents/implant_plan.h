// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "documents/anatomy.h"
#include "kerf/math.hpp"

/// What a procedure plans of its implants: their solids, screw holes and poses.
namespace kerf::documents {

/// A screw hole of an implant.
struct ImplantHole {
    std::string id;
    Vec3 from{}, to{};      ///< [m] of its axis, from outside the bone into it, implant frame
    double diameter = 0.0;  ///< [m]
};

/// Where an implant is planned: its origin where the axis first meets bone, its z along the axis.
struct ImplantPlace {
    std::string axis;  ///< name of the landmark axis
    Vec3 up{0, 0, 1};  ///< LPS; the implant's x points as near to it as it can
};

/// A solid of metal that a hand brings into the scene. A waypoint puts its frame where the tool is then (z along its
/// axis, the tip at 0), or at its planned pose.
struct Implant {
    std::string id;
    MeshSource mesh{};       ///< its surface, if there are no parts
    PhantomSource solids{};  ///< its parts, implant frame
    std::vector<ImplantHole> holes{};
    std::optional<ImplantPlace> place{};

    [[nodiscard]] bool is_made_of_parts() const noexcept { return !solids.parts.empty(); }
};

/// Least angle between `up` and the axis of a place at which x is still defined [rad].
inline constexpr double min_angle_of_up = 0.02;

/// Returns the planned pose of an implant, LPS from its frame. Pre: `up` is at an angle to the unit vector `along`.
/// @param entry   where the axis first meets bone, LPS [m]   [any] pure.
[[nodiscard]] Pose planned_pose(Vec3 entry, Vec3 along, Vec3 up) noexcept;

/// What the axis of a step names, such as `plate.lag`.
struct NamedHole {
    const Implant* implant = nullptr;
    const ImplantHole* hole = nullptr;  ///< null: the implant has none of that name
    std::string name{};                 ///< behind the implant's
};
/// Returns the hole that `axis` names; nothing if it begins with no implant's name and a point. The implants must
/// outlive it.   [any] pure.
[[nodiscard]] std::optional<NamedHole> named_hole(const std::string& axis, const std::vector<Implant>& implants);

/// Returns a hole's axis in another frame.   [any] pure.
[[nodiscard]] LandmarkAxis axis_of(const ImplantHole& hole, const Pose& frame_from_implant, const std::string& name);

/// What metal is around the axis of a hole.
struct HoleInMetal {
    std::optional<Vec3> blocked;      ///< [m] the first point of metal within 0.9 of the diameter, implant frame
    double first = 0.0, last = -1.0;  ///< [m] from `from`: where metal surrounds the axis; first > last: nowhere

    [[nodiscard]] bool has_metal() const noexcept { return first <= last; }
    [[nodiscard]] double middle() const noexcept { return 0.5 * (first + last); }
};
/// Samples the metal around a hole, every sixteenth of its diameter along its axis.
/// @param distance   to the implant's surface, negative inside, implant frame [m] → [m]   [any] pure.
[[nodiscard]] HoleInMetal hole_in_metal(const ImplantHole& hole, const std::function<double(Vec3)>& distance);

/// Returns the spacing [m] at which an implant of parts is sampled: that of the procedure, or finer, so that each part
/// and each hole is at least six samples wide.   [any] pure.
[[nodiscard]] double fitting_spacing(const Implant& implant, double spacing) noexcept;

}  // namespace kerf::documents
