// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "core/field/grid/box.h"

/// What a bone's fields will take, before any of it is asked for.
namespace kerf {

/// The most that the bone of one run may take [bytes].
inline constexpr double most_bone_memory = 4.0 * 1024 * 1024 * 1024;

struct FieldsMemory {
    double bytes = 0.0;     ///< tables, and the samples of bricks near a border
    double bricks = 0.0;    ///< of the grid
    double cuttable = 0.0;  ///< of them those that are not all air
};

/// About what fields over `bounds` [m] take at `spacing` [m]: the shares of bricks near a border and in bone are found
/// by asking at scattered points. A few per cent off.   [any] pure, takes as long as 20 000 distances of each field
/// @param borders         one signed distance for each field [m], the bone's own first
/// @param has_densities   bone has a density for every sample
[[nodiscard]] FieldsMemory fields_memory(const Box& bounds, double spacing,
                                         const std::vector<std::function<double(Vec3)>>& borders, bool has_densities);

/// How many times too much that is: of memory, of bricks in a grid, or of bricks that can be cut. At most 1: it fits.
/// [any] pure
[[nodiscard]] double excess_of(const FieldsMemory& needed) noexcept;

}  // namespace kerf
