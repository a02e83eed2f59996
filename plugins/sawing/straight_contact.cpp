// SPDX-License-Identifier: Apache-2.0
// Contact points of a straight blade.
#include <algorithm>
#include <array>
#include <cstddef>

#include "kerf/beam.hpp"
#include "saw_contact.h"

namespace kerf::sawing {

namespace {

constexpr std::size_t columns = 17, max_rows = row_behind.size() + 1;
static_assert(tip_points + 2 * max_rows * columns + 2 * max_rows + columns <= ContactPoints::max_points &&
              2 * max_rows * columns <= TouchingPoints::max_on_sides);

/// The rows of points on the sides [m] behind the roots of the teeth; the last is the back edge.
struct Rows {
    std::array<double, max_rows> behind;
    std::size_t count = 0;
};
Rows rows_of(const StraightBlade& blade) noexcept {
    constexpr double apart = 0.5e-3;  // [m] a row as near to the back edge as this is that edge
    const double back = blade.height - blade.tooth_height;
    Rows rows;
    for (const double behind : row_behind)
        if (behind < back - apart) rows.behind[rows.count++] = behind;
    rows.behind[rows.count++] = back;
    return rows;
}

/// Returns the stiffness across the blade [N/m] at (`x`, `z`), for a blade clamped at its −x end, in series with the
/// bone. The blade bends about z and twists about its long axis:
///
///     1/k = l³/(3 E I) + a² l/(G J) + 1/k_bone,    I = w d³/12,    J = w d³/3
///
/// with l the distance from the clamped end, a that from the long axis, w the blade's height, d its thickness.
double side_stiffness(const StraightBlade& blade, double x, double z, double contact) noexcept {
    constexpr double poisson = 0.3, shear_modulus = stainless_steel / (2.0 * (1.0 + poisson));
    const double cubed = blade.thickness * blade.thickness * blade.thickness;
    const double l = std::max(x + 0.5 * blade.length, 0.1 * blade.length), arm = z - blade.middle_z();
    const double bending = cantilever_stiffness(stainless_steel, blade.height * cubed / 12.0, l * l * l);
    const double twist_compliance = arm * arm * l / (shear_modulus * blade.height * cubed / 3.0);
    const double blade_stiffness = bending / (1.0 + bending * twist_compliance);
    return in_series(blade_stiffness, contact);
}

}  // namespace

TouchingPoints touching_points(const StraightBlade& blade, const SawParameters& law, const BoneQuery& bone,
                               bool removes) noexcept {
    const double stiffness = law.contact_stiffness;
    TouchingPoints points;
    if (!removes) points.add_still_teeth(blade, stiffness);
    const Rows rows = rows_of(blade);
    for (std::size_t row = 0; row < rows.count; ++row) {
        const double behind = rows.behind[row], z = -blade.tooth_height - behind;
        const bool is_far = z < blade.middle_z();
        for (std::size_t column = 0; column < columns; ++column) {
            const double x =
                0.9 * blade.half_front() * (2.0 * static_cast<double>(column) / static_cast<double>(columns - 1) - 1.0);
            points.add_sides(x, z, blade.thickness, behind, side_stiffness(blade, x, z, stiffness), is_far);
            if (row + 1 == rows.count)
                points.all.add({x, 0.0, z}, {0, 0, -1}, stiffness, TouchingPoints::tip_facing, slot_back);
        }
        points.add_ends(blade.half_front() - bone.wall_error(), z, stiffness);
    }
    return points;
}

}  // namespace kerf::sawing
