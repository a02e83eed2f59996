// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/field/grid/kernel/block_kernel.h"

/// The stages of a solid's outline and of stamps, as `BlockKernel` has them: for any machine, and for AVX2.
namespace kerf {

namespace portable {
void depths(const OutlineShape& outline, std::size_t count, const ConstCoordinates& in_tool, double* depths) noexcept;
void tangents(const OutlineShape& outline, std::size_t count, const ConstCoordinates& in_tool, double* depths,
              const Coordinates& gradients) noexcept;
void deepest(const SingleOutline& outline, const SingleFrame* solid_from_points, std::size_t solids, std::size_t count,
             const kerf_vec3* points, const Walls& walls) noexcept;
bool raise(const SingleOutline& outline, const SampleCell& cell, float band, float per_quantum, std::int16_t* samples,
           std::int16_t& lowest, std::int16_t& highest, std::int16_t* spare) noexcept;
void find(const std::int16_t* samples, std::int16_t low, std::int16_t high, std::uint32_t (&found)[3]) noexcept;
}  // namespace portable

namespace avx2 {
void depths(const OutlineShape& outline, std::size_t count, const ConstCoordinates& in_tool, double* depths) noexcept;
void tangents(const OutlineShape& outline, std::size_t count, const ConstCoordinates& in_tool, double* depths,
              const Coordinates& gradients) noexcept;
void deepest(const SingleOutline& outline, const SingleFrame* solid_from_points, std::size_t solids, std::size_t count,
             const kerf_vec3* points, const Walls& walls) noexcept;
bool raise(const SingleOutline& outline, const SampleCell& cell, float band, float per_quantum, std::int16_t* samples,
           std::int16_t& lowest, std::int16_t& highest, std::int16_t* spare) noexcept;
void find(const std::int16_t* samples, std::int16_t low, std::int16_t high, std::uint32_t (&found)[3]) noexcept;
}  // namespace avx2

}  // namespace kerf
