// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>

#include "core/field/cut/tool_solid.h"
#include "core/field/grid/body.h"

/// How true a drilled hole was: its middle line in the bone, held against the planned axis; and how far a cylinder
/// along it, such as a screw, leaves the bone.
namespace kerf {

/// Where a planned hole is looked for, body frame.
struct HolePlan {
    Vec3 entry{};           ///< [m] on the planned axis, where it meets bone
    Vec3 along{};           ///< unit, the planned axis, into the bone
    double depth = 0.0;     ///< [m] of the deepest tip, along the axis
    ToolSolid cutting{};    ///< of the drill, a solid of revolution
    double beside = 10e-3;  ///< [m] of bone around the planned hole in which the drilled one is looked for
};

/// Share of the bone at a point that was drilled away [–], body frame.
using DrilledShare = std::function<double(Vec3)>;

/// A hole against its plan. Depths are along the planned axis from its entry.
struct DrilledHole {
    double entry_depth = 0.0;              ///< [m] where a drill has bitten: one diameter behind the first whole circle
    std::optional<double> entry_offset{};  ///< [m] of the hole's middle from the axis there; nothing: it ends before
    double narrowest_depth = 0.0;  ///< [m] of the waist of the bone around the planned axis; without a waist, the entry
    std::optional<double> narrowest_offset{};  ///< [m] of the hole's middle there; nothing: it ends before
    double waist_end = 0.0;                    ///< [m] where the bone behind the waist is half as wide again: of a
                                               ///< pedicle its end; without a waist, the end of the hole
    double end_depth = 0.0;                    ///< [m] of the last whole circle
    double end_offset = 0.0;                   ///< [m] of the hole's middle there
    std::optional<double> angle{};             ///< [rad] between hole and axis; nothing for a hole under two diameters
    Vec3 at{}, direction{};                    ///< the line of least squares through its middles, body frame; unit
    double drilled = 0.0;                      ///< [m³] in the window
    double ideal = 0.0;                        ///< [m³] that the same drill takes on the planned axis, as deep
};

/// Measures a hole on sections across the planned axis, half a millimetre apart. Nothing where no section shows a whole
/// circle, as after a scratch.   [worker] pure.
[[nodiscard]] std::optional<DrilledHole> measure_hole(const Body& body, const HolePlan& plan,
                                                      const DrilledShare& drilled);

/// Returns the axis of an implant in bone as if it were a hole: from `tip` back along unit `direction`, body frame.
/// Nothing for one that lies at more than 60° to the plan. Its volumes are 0.   [worker] pure.
[[nodiscard]] std::optional<DrilledHole> hole_along(const Body& body, const HolePlan& plan, Vec3 tip, Vec3 direction);

/// How far a cylinder leaves the bone, by the side that it leaves it on [m]; 0: nowhere.
struct Breach {
    static constexpr std::size_t side_count = 4;
    std::array<double, side_count> towards{};  ///< +a, −a, +b, −b of the two directions that were given
    double depth = 0.0;                        ///< [m] along the planned axis, of the worst
    [[nodiscard]] double worst() const noexcept;
};

/// Depths along the planned axis [m].
struct DepthRange {
    double from = 0.0, to = HUGE_VAL;
};
/// Looks along rays from the hole's line for the border of the bone before any cut: a cylinder of `radius` breaches by
/// what it reaches beyond it [gertzbein-robbins-1990]. Looked at is the stretch from where the planned cylinder is
/// first all in bone to where the hole ends, as far as it lies in `range`.   [worker] pure.
/// @param a,b   unit, across the axis and each other: which sides are told apart
[[nodiscard]] Breach breach_of(const Body& body, const HolePlan& plan, const DrilledHole& hole, double radius, Vec3 a,
                               Vec3 b, DepthRange range = {});

}  // namespace kerf
