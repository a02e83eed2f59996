// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/field/cut/cut_field.h"
#include "core/field/grid/brick_bits.h"

namespace kerf {

/// Returns the samples of a brick that are bone. There surface and cut are both negative, as in the surface mesh, and
/// the sample lies strictly within the body's region.   [any] pure, nonblocking.
[[nodiscard]] BrickBits solid_bits(const Body& body, const CutField& cut, std::size_t brick_index) noexcept;

/// Returns the samples where both of a brick's fields (9³ samples each) are negative, without a test of the region.
[[nodiscard]] BrickBits solid_bits(const std::int16_t* surface, const std::int16_t* cut) noexcept;

}  // namespace kerf
