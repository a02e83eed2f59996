// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>

#include "core/field/cut/tool_solid.h"
#include "core/field/grid/body.h"

/// Accuracy of a drilled hole: its middle line in bone, compared with the planned axis. Breach: how far a cylinder
/// along this line, such as a screw, leaves the bone.
namespace kerf::bone {

/// The region around a planned hole that is searched for the drilled one, body frame.
struct HolePlan {
    Vec3 entry{};           ///< [m] on the planned axis, where it meets bone
    Vec3 along{};           ///< unit, the planned axis, into the bone
    double depth = 0.0;     ///< [m] of the deepest tip, along the axis
    ToolSolid cutting{};    ///< cutting solid of the drill, a solid of revolution
    double beside = 10e-3;  ///< [m] width of the searched bone around the planned hole
};

/// Fractions of the bone at a point that drilling has removed [–].
struct Drilled {
    double now = 0.0;     ///< by the hole that is measured
    double before = 0.0;  ///< by earlier ones, such as the hole that it widens
};
/// Returns what is drilled at a point, body frame.
using DrilledFraction = std::function<Drilled(Vec3)>;

/// A hole compared with its plan. Depths are along the planned axis from its entry.
struct DrilledHole {
    double entry_depth = 0.0;              ///< [m] where the drill is guided: a diameter behind the first whole circle
    std::optional<double> entry_offset{};  ///< [m] of the hole's middle from the axis there, if it is so deep
    double narrowest_depth = 0.0;  ///< [m] of the bone's waist around the planned axis; without a waist, the entry
    std::optional<double> narrowest_offset{};  ///< [m] of the hole's middle there; nothing if the hole ends before
    double waist_end = 0.0;                    ///< [m] where the bone behind the waist is 1.5 times as wide, the end of
                                               ///< a pedicle; without a waist, the end of the hole
    double end_depth = 0.0;                    ///< [m] of the last whole circle
    double end_offset = 0.0;                   ///< [m] of the hole's middle there
    std::optional<double> angle{};             ///< [rad] between hole and axis; none below two diameters
    Vec3 at{}, direction{};                    ///< least-squares line through its middles, body frame; unit
    double drilled = 0.0;                      ///< [m³] in the window
    double ideal = 0.0;                        ///< [m³] of the same drill on the planned axis, to the same depth,
                                               ///< without what was drilled before
    double whole = 0.0;                        ///< [m³] the same with what was drilled before
};

/// Measures a hole on sections across the planned axis, half a millimetre apart. A hole that widens an earlier one
/// counts the bone that the earlier one removed within its circles. Nothing if no section has a whole circle, as after
/// a scratch.   [worker] pure.
[[nodiscard]] std::optional<DrilledHole> measure_hole(const Body& body, const HolePlan& plan,
                                                      const DrilledFraction& drilled);

/// Returns the axis of an implant in bone as a hole: from `tip` backwards along the unit vector `direction`, body
/// frame. Nothing for an angle above 60° to the plan. Its volumes are 0.   [worker] pure.
[[nodiscard]] std::optional<DrilledHole> hole_along(const Body& body, const HolePlan& plan, Vec3 tip, Vec3 direction);

/// How far a cylinder leaves the bone on each side [m]; 0: not at all.
struct Breach {
    static constexpr std::size_t side_count = 4;
    std::array<double, side_count> towards{};  ///< +a, −a, +b, −b of the two given directions
    double depth = 0.0;                        ///< [m] along the planned axis, of the largest
    [[nodiscard]] double worst() const noexcept;
};

/// Depths along the planned axis [m].
struct DepthRange {
    double from = 0.0, to = HUGE_VAL;
};
/// Returns the breach of a cylinder of `radius` [m] along the hole's line. Rays from the line find the border of the
/// bone before any cut; the breach is the cylinder's reach beyond it [gertzbein-robbins-1990]. The face through which
/// the hole enters does not count, at any angle. The tested stretch begins where the planned cylinder is first
/// completely in bone, and ends with the hole. `range` limits it.   [worker] pure.
/// @param a,b  unit, perpendicular to the axis and to each other; they define the sides
[[nodiscard]] Breach breach_of(const Body& body, const HolePlan& plan, const DrilledHole& hole, double radius, Vec3 a,
                               Vec3 b, DepthRange range = {});

}  // namespace kerf::bone
