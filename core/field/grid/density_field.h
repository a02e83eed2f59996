// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/field/grid/brick_memory.h"
#include "core/field/grid/point_block.h"

/// The density of a heterogeneous material. Immutable once built, so every thread may read it.
namespace kerf {

/// Stored as float, and only in bricks that contain the material. The density passed to `build` continues from inside
/// beyond the material's border. So interpolation at the border includes no value of a neighbouring material.
class DensityField {
public:
    DensityField() = default;  ///< without samples

    /// Samples `density` (body frame [m] → [kg/m³]) in every brick for which `is_needed(brick index)` is true. Throws
    /// std::length_error if these are more than `max_stored_bricks`.   [main]
    static DensityField build(const Grid& grid, const std::function<bool(std::size_t)>& is_needed,
                              const std::function<double(Vec3)>& density);

    [[nodiscard]] bool is_empty() const noexcept { return samples_.empty(); }
    /// Returns the trilinear density [kg/m³]; `elsewhere` [kg/m³] in bricks without samples and outside the grid.
    /// [any] pure, nonblocking.
    [[nodiscard]] double at(const LocatedPoint& place, double elsewhere) const noexcept {
        if (is_empty() || !place.is_inside) return elsewhere;
        const std::int32_t start = start_[place.brick];
        return start < 0 ? elsewhere : static_cast<double>(trilinear(brick(start), place));
    }
    /// Writes the same for a block of points. Pre: not empty.   [any] pure, nonblocking.
    void at(const LocatedBlock& places, double elsewhere, FloatBlock& densities) const noexcept {
        block_kernel().densities(start_.data(), samples_.data(), places.count, places.places(),
                                 static_cast<float>(elsewhere), densities.data());
    }

    /// Returns the largest density of all samples [kg/m³]; 0 if empty.
    [[nodiscard]] double largest() const noexcept { return largest_; }
    [[nodiscard]] double mean() const noexcept;
    [[nodiscard]] std::size_t memory_bytes() const noexcept {
        return start_.size() * sizeof(std::int32_t) + samples_.size() * sizeof(float);
    }

private:
    [[nodiscard]] const float* brick(std::int32_t start) const noexcept { return samples_.data() + start; }

    std::vector<std::int32_t> start_;  ///< first sample of each brick, then outside the grid; −1: no samples
    BrickSamples<float> samples_;
    double largest_ = 0.0;
};

}  // namespace kerf
