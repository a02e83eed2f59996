// SPDX-License-Identifier: Apache-2.0
#include "core/field/grid/level_set.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace kerf {

LevelSet LevelSet::build(const Grid& grid, const std::function<double(Vec3)>& distance) {
    FunctionDistance source(distance);
    return build(grid, source);
}

LevelSet LevelSet::build(const Grid& grid, DistanceSource& distance) {
    DistanceSource* const one = &distance;
    return std::move(build(grid, std::span(&one, 1)).front());
}

std::vector<LevelSet> LevelSet::build(const Grid& grid, std::span<DistanceSource* const> distances) {
    std::vector<LevelSet> sets(distances.size());
    for (std::size_t n = 0; n < sets.size(); ++n) {
        sets[n].grid_ = grid;
        sets[n].find_stored_bricks(*distances[n]);
    }
    for (int k = 0; k < grid.bricks[2]; ++k)
        for (int j = 0; j < grid.bricks[1]; ++j)
            for (int i = 0; i < grid.bricks[0]; ++i) {
                const BrickLattice lattice = BrickLattice::of(grid, i, j, k);
                const std::size_t brick_index = grid.brick_index(i, j, k);
                for (std::size_t n = 0; n < sets.size(); ++n)
                    if (sets[n].start_[brick_index] == to_be_stored)
                        sets[n].store_brick(brick_index, lattice, *distances[n]);
            }
    return sets;
}

void LevelSet::find_stored_bricks(DistanceSource& distance) {
    clamp_ = grid_.clamp();
    quantum_ = grid_.quantum();
    start_.assign(grid_.brick_count() + 1, air);
    samples_.assign(stored_samples, 32767);
    samples_.resize(first_stored, -32767);
    signs_.assign(grid_.brick_count(), outside);

    // A brick is uniform if its centre is farther from the surface than half of its diagonal plus the clamp.
    const double half = 0.5 * brick_edge * grid_.spacing, reach = std::sqrt(3.0) * half + clamp_;
    std::size_t stored = 0;
    for (int k = 0; k < grid_.bricks[2]; ++k)
        for (int j = 0; j < grid_.bricks[1]; ++j)
            for (int i = 0; i < grid_.bricks[0]; ++i) {
                const Vec3 low = grid_.sample_position(i * brick_edge, j * brick_edge, k * brick_edge);
                const double at_centre = distance.at(low + Vec3{half, half, half}, {-reach, reach});
                const std::size_t brick_index = grid_.brick_index(i, j, k);
                const bool is_stored = !(std::abs(at_centre) > reach);
                start_[brick_index] = is_stored ? to_be_stored : at_centre > 0.0 ? air : solid;
                signs_[brick_index] = at_centre > 0.0 ? outside : inside;
                stored += is_stored;
            }
    if (stored > max_stored_bricks) throw std::length_error("more bricks than one field can store");
    samples_.reserve((stored + 2) * stored_samples);
}

void LevelSet::store_brick(std::size_t brick_index, const BrickLattice& lattice, DistanceSource& distance) {
    std::array<double, stored_samples> distances{};
    distance.fill(lattice, {-clamp_, clamp_}, distances);
    start_[brick_index] = static_cast<std::int32_t>(samples_.size());
    signs_[brick_index] = 0;
    for (const double d : distances) {
        samples_.push_back(quantised(d, quantum_));
        signs_[brick_index] |= samples_.back() < 0 ? inside : outside;
    }
}

std::int16_t LevelSet::sample(int i, int j, int k) const noexcept {
    if (i < 0 || j < 0 || k < 0 || i >= grid_.samples(0) || j >= grid_.samples(1) || k >= grid_.samples(2))
        return 32767;
    const std::size_t b = grid_.brick_index(i / brick_edge, j / brick_edge, k / brick_edge);
    return brick(start_[b])[((k % brick_edge) * stored_edge + j % brick_edge) * stored_edge + i % brick_edge];
}

}  // namespace kerf
