// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/field/grid.h"
#include "core/field/point_block.h"

/// A signed distance in a narrow band of bricks; immutable once built, so every thread may read it.
namespace kerf {

class LevelSet {
public:
    /// Samples `distance` (body frame [m] → [m], negative inside, 1-Lipschitz) at every grid node near its zero.
    /// [main]
    static LevelSet build(const Grid& grid, const std::function<double(Vec3)>& distance);

    /// Trilinear distance [m], within ± clamp; outside the grid `+clamp`.   [any] pure, nonblocking.
    [[nodiscard]] double at(const BrickPlace& place) const noexcept {
        if (!place.is_inside) return clamp_;
        const std::int32_t slot = table_[place.brick];
        if (slot < 0) return slot == air ? clamp_ : -clamp_;
        return quantum_ * trilinear(brick(slot), place);
    }
    /// The same for a block.   [any] pure, nonblocking.
    void at(const PlaceBlock& places, BlockValues& distances) const noexcept;
    /// The same with gradients, zero where the brick is uniform. False where they all are.
    bool at(const PlaceBlock& places, SlopeBlock& distances) const noexcept;
    /// The stored sample (i, j, k) [quanta]; outside the grid the largest.
    [[nodiscard]] std::int16_t sample(int i, int j, int k) const noexcept;

    [[nodiscard]] bool is_all_air(std::size_t brick_index) const noexcept { return table_[brick_index] == air; }
    [[nodiscard]] bool is_all_solid(std::size_t brick_index) const noexcept { return table_[brick_index] == solid; }
    [[nodiscard]] bool has_border(std::size_t brick_index) const noexcept { return table_[brick_index] >= 0; }
    /// The 9³ samples of a brick [quanta], or nullptr where it is uniform.
    [[nodiscard]] const std::int16_t* stored(std::size_t brick_index) const noexcept {
        return table_[brick_index] < 0 ? nullptr : brick(table_[brick_index]);
    }
    [[nodiscard]] std::int16_t uniform_value(std::size_t brick_index) const noexcept {
        return table_[brick_index] == air ? std::int16_t{32767} : std::int16_t{-32767};
    }
    [[nodiscard]] const Grid& grid() const noexcept { return grid_; }
    [[nodiscard]] bool is_empty() const noexcept { return grid_.brick_count() == 0; }  ///< never built: nothing to ask
    [[nodiscard]] std::size_t memory_bytes() const noexcept {
        return table_.size() * sizeof(std::int32_t) + pool_.size() * sizeof(std::int16_t);
    }

private:
    static constexpr std::int32_t air = -1;
    static constexpr std::int32_t solid = -2;
    [[nodiscard]] const std::int16_t* brick(std::int32_t slot) const noexcept {
        return pool_.data() + static_cast<std::size_t>(slot) * stored_samples;
    }

    Grid grid_;
    double clamp_ = 0.0, quantum_ = 0.0;
    std::vector<std::int32_t> table_;
    std::vector<std::int16_t> pool_;
};

/// Metres to the nearest quantum, clamped.
[[nodiscard]] inline std::int16_t quantised(double distance, double quantum) noexcept {
    const double q = distance * (1.0 / quantum);
    if (q >= 32767.0) return 32767;
    if (q <= -32767.0) return -32767;
    return static_cast<std::int16_t>(q >= 0.0 ? q + 0.5 : q - 0.5);
}

}  // namespace kerf
