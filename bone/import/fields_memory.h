// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "core/field/grid/box.h"

/// Memory that a bone's fields will take, estimated before allocation.
namespace kerf::bone {

/// Largest memory for the bone of one run [bytes].
inline constexpr double max_bone_memory = 4.0 * 1024 * 1024 * 1024;

struct FieldsMemory {
    double bytes = 0.0;     ///< tables, and the samples of bricks near a border
    double bricks = 0.0;    ///< in the grid
    double cuttable = 0.0;  ///< bricks that are not all air
};

/// Returns the estimated memory of fields over `bounds` [m] at `spacing` [m]. Probes at scattered points estimate the
/// fractions of bricks near a border and in bone. Accurate to a few per cent.   [any] pure, takes as long as 20 000
/// distances of each field
/// @param borders        one signed distance for each field [m], the bone's own first
/// @param has_densities  bone has a density for every sample
[[nodiscard]] FieldsMemory fields_memory(const Box& bounds, double spacing,
                                         const std::vector<std::function<double(Vec3)>>& borders, bool has_densities);

/// Returns the factor by which the need exceeds the limits of memory, of bricks in a grid, or of bricks that can be
/// cut. At most 1: it fits.   [any] pure
[[nodiscard]] double excess_of(const FieldsMemory& needed) noexcept;

}  // namespace kerf::bone
