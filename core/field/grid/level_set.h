// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/field/grid/brick_memory.h"
#include "core/field/grid/distance_source.h"
#include "core/field/grid/grid.h"
#include "core/field/grid/point_block.h"

/// A signed distance in a narrow band of bricks. Immutable once built, so every thread may read it.
namespace kerf {

class LevelSet {
public:
    /// Samples `distance` (body frame [m] → [m], negative inside, 1-Lipschitz) in every brick that may have a sample
    /// within the clamp. Throws std::length_error, before it allocates samples, if these are more than
    /// `max_stored_bricks`.   [main]
    static LevelSet build(const Grid& grid, DistanceSource& distance);
    /// Builds one set for each distance. All distances are sampled in one brick before the next brick.
    static std::vector<LevelSet> build(const Grid& grid, std::span<DistanceSource* const> distances);
    static LevelSet build(const Grid& grid, const std::function<double(Vec3)>& distance);

    /// Returns the trilinear distance [m], within ± clamp; outside the grid `+clamp`.   [any] pure, nonblocking.
    [[nodiscard]] double at(const LocatedPoint& place) const noexcept {
        const std::int32_t start = place.is_inside ? start_[place.brick] : air;
        if (start < first_stored) return start == air ? clamp_ : -clamp_;
        return quantum_ * static_cast<double>(trilinear(brick(start), place));
    }
    /// Returns the trilinear distance [quanta], within ± 32767; outside the grid 32767.
    [[nodiscard]] float quanta_at(const LocatedPoint& place) const noexcept {
        const std::int32_t start = place.is_inside ? start_[place.brick] : air;
        return start < first_stored ? static_cast<float>(*brick(start)) : trilinear(brick(start), place);
    }
    /// Writes the trilinear distances at a block of points: `at` in [m], `quanta_at` in [quanta].
    /// [any] pure, nonblocking.
    void at(const LocatedBlock& places, BlockValues& distances) const noexcept {
        block_kernel().metres(shape(), places.count, places.places(), quantum_, clamp_, distances.data());
    }
    void quanta_at(const LocatedBlock& places, FloatBlock& quanta) const noexcept {
        block_kernel().values(shape(), places.count, places.places(), quanta.data());
    }
    [[nodiscard]] FieldShape shape() const noexcept { return {start_.data(), samples_.data(), first_stored, solid}; }
    /// Returns sample (i, j, k) of the grid [quanta]; outside the grid 32767.
    [[nodiscard]] std::int16_t sample(int i, int j, int k) const noexcept;

    [[nodiscard]] bool is_all_air(std::size_t brick_index) const noexcept { return start_[brick_index] == air; }
    [[nodiscard]] bool is_all_solid(std::size_t brick_index) const noexcept { return start_[brick_index] == solid; }
    [[nodiscard]] bool has_border(std::size_t brick_index) const noexcept {
        return start_[brick_index] >= first_stored;
    }
    /// Returns the 9³ samples of a brick [quanta], or nullptr where it is uniform.
    [[nodiscard]] const std::int16_t* stored(std::size_t brick_index) const noexcept {
        return has_border(brick_index) ? brick(start_[brick_index]) : nullptr;
    }
    [[nodiscard]] std::int16_t uniform_value(std::size_t brick_index) const noexcept {
        return start_[brick_index] == air ? std::int16_t{32767} : std::int16_t{-32767};
    }
    /// Returns whether any of a brick's 9³ samples is negative (`has_inside`), or any is not negative (`has_outside`).
    [[nodiscard]] bool has_inside(std::size_t brick_index) const noexcept {
        return (signs_[brick_index] & inside) != 0;
    }
    [[nodiscard]] bool has_outside(std::size_t brick_index) const noexcept {
        return (signs_[brick_index] & outside) != 0;
    }
    [[nodiscard]] const Grid& grid() const noexcept { return grid_; }
    [[nodiscard]] bool is_empty() const noexcept { return grid_.brick_count() == 0; }  ///< never built
    [[nodiscard]] std::size_t memory_bytes() const noexcept {
        return start_.size() * sizeof(std::int32_t) + samples_.size() * sizeof(std::int16_t) + signs_.size();
    }

private:
    static constexpr std::int32_t to_be_stored = -1;  ///< until its samples are known
    void find_stored_bricks(DistanceSource& distance);
    void store_brick(std::size_t brick_index, const BrickLattice& lattice, DistanceSource& distance);

    // All air bricks use one common brick of samples, and all solid bricks another: interpolation needs no special
    // case.
    static constexpr std::int32_t air = 0, solid = stored_samples, first_stored = 2 * stored_samples;
    static constexpr std::uint8_t inside = 1, outside = 2;
    [[nodiscard]] const std::int16_t* brick(std::int32_t start) const noexcept { return samples_.data() + start; }

    Grid grid_;
    double clamp_ = 0.0, quantum_ = 0.0;
    std::vector<std::int32_t> start_;  ///< first sample of each brick; the last entry: outside the grid
    BrickSamples<std::int16_t> samples_;
    std::vector<std::uint8_t> signs_;  ///< of each brick's samples: `inside` and `outside` bits
};

/// Returns a distance [m] in quanta: rounded to the nearest, and clamped to ± 32767. `quantum` in [m].
[[nodiscard]] inline std::int16_t quantised(double distance, double quantum) noexcept {
    const double q = distance * (1.0 / quantum);
    if (q >= 32767.0) return 32767;
    if (q <= -32767.0) return -32767;
    return static_cast<std::int16_t>(q >= 0.0 ? q + 0.5 : q - 0.5);
}

}  // namespace kerf
