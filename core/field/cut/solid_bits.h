// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/field/cut/cut_field.h"
#include "core/field/grid/brick_bits.h"

namespace kerf {

/// Which samples of a brick are bone: both distances negative, as the surface has it, and strictly within the body's
/// region. [any] pure, nonblocking.
[[nodiscard]] BrickBits solid_bits(const Body& body, const CutField& cut, std::size_t brick_index) noexcept;

/// The same for one that no region's face cuts through.
[[nodiscard]] BrickBits solid_bits(const std::int16_t* surface, const std::int16_t* cut) noexcept;

}  // namespace kerf
