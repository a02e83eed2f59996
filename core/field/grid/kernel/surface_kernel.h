// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/field/grid/kernel/block_kernel.h"

/// The stages of a brick's surface in `BlockKernel`: for any machine, and for AVX2.
namespace kerf {

namespace portable {
void larger_rows(const BrickAround& a, const BrickAround& b, std::int16_t* samples, std::uint16_t* inside) noexcept;
void larger_border(const BrickAround& a, const BrickAround& b, std::int16_t* samples) noexcept;
void crossings(const std::int16_t* samples, const std::uint16_t* slots, std::size_t count, int axis,
               const SampleFrame& frame, SurfaceVertex* vertices) noexcept;
}  // namespace portable

namespace avx2 {
void larger_rows(const BrickAround& a, const BrickAround& b, std::int16_t* samples, std::uint16_t* inside) noexcept;
void larger_border(const BrickAround& a, const BrickAround& b, std::int16_t* samples) noexcept;
void crossings(const std::int16_t* samples, const std::uint16_t* slots, std::size_t count, int axis,
               const SampleFrame& frame, SurfaceVertex* vertices) noexcept;
}  // namespace avx2

}  // namespace kerf
