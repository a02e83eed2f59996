// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/haptics/law/tool.h"

/// Grooves of a solid of revolution: the flutes of a drill, the blades of a burr. They lie inside the outline.
namespace kerf::run {

inline constexpr std::size_t max_columns = 48;  ///< of a surface without grooves

/// A column of points along the tool. Its azimuth at the tip rises from column to column, through one turn.
struct GrooveColumn {
    double azimuth = 0.0;     ///< [rad]
    double fraction = 1.0;    ///< [–] of the outline's radius; of a drill: of its widest radius
    double floor = HUGE_VAL;  ///< [m] radius to which a drill's flute reaches
};

struct Grooves {
    std::vector<GrooveColumn> columns;
    double twist = 0.0;      ///< [rad/m] of the columns, rises with z: a right-hand helix
    double begin = 0.0;      ///< [m] z up to which the columns are straight, from the tip backwards
    double end = 0.0;        ///< [m] z at which all grooves end
    double widest = 0.0;     ///< [m] radius of a drill over its lips; 0: no drill
    double fade_from = 0.0;  ///< [m] z behind which a drill's flutes become shallower

    [[nodiscard]] bool is_drill() const noexcept { return widest > 0.0; }
    /// Returns the radius of the surface in a column at `z`, where the outline has `radius` [m].
    [[nodiscard]] double radius_at(const GrooveColumn& column, double z, double radius) const noexcept;
};

/// Returns `count` columns of equal pitch without grooves.
[[nodiscard]] Grooves no_grooves(std::size_t count);

/// Returns the grooves of a tool by the rules of docs/guide/plugins.md. Pre: a solid of revolution without a thread.
/// [main]
[[nodiscard]] Grooves grooves_of(const Tool& tool);

}  // namespace kerf::run
