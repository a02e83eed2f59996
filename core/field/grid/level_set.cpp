// SPDX-License-Identifier: Apache-2.0
#include "core/field/grid/level_set.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace kerf {

LevelSet LevelSet::build(const Grid& grid, const std::function<double(Vec3)>& distance) {
    FunctionDistance source(distance);
    return build(grid, source);
}

LevelSet LevelSet::build(const Grid& grid, DistanceSource& distance) {
    LevelSet set;
    set.grid_ = grid;
    set.clamp_ = grid.clamp();
    set.quantum_ = grid.quantum();
    set.start_.assign(grid.brick_count() + 1, air);
    set.samples_.assign(stored_samples, 32767);
    set.samples_.resize(first_stored, -32767);
    set.signs_.assign(grid.brick_count(), outside);

    // A brick is uniform if its centre is farther from the surface than half of its diagonal plus the clamp.
    const double reach = (0.5 * brick_edge * std::sqrt(3.0) + clamp_voxels) * grid.spacing;
    constexpr std::int32_t to_be_stored = -1;
    std::size_t stored = 0;
    for (int k = 0; k < grid.bricks[2]; ++k)
        for (int j = 0; j < grid.bricks[1]; ++j)
            for (int i = 0; i < grid.bricks[0]; ++i) {
                const Vec3 low = grid.sample_position(i * brick_edge, j * brick_edge, k * brick_edge);
                const double half = 0.5 * brick_edge * grid.spacing;
                const double at_centre = distance.at(low + Vec3{half, half, half}, {-reach, reach});
                const bool is_stored = !(std::abs(at_centre) > reach);
                set.start_[grid.brick_index(i, j, k)] = is_stored ? to_be_stored : at_centre > 0.0 ? air : solid;
                stored += is_stored;
            }
    if (stored > max_stored_bricks) throw std::length_error("more bricks than one field can store");
    set.samples_.reserve((stored + 2) * stored_samples);
    std::array<double, stored_samples> distances{};

    for (int k = 0; k < grid.bricks[2]; ++k)
        for (int j = 0; j < grid.bricks[1]; ++j)
            for (int i = 0; i < grid.bricks[0]; ++i) {
                auto& start = set.start_[grid.brick_index(i, j, k)];
                auto& signs = set.signs_[grid.brick_index(i, j, k)];
                if (start != to_be_stored) {
                    signs = start == air ? outside : inside;
                    continue;
                }
                start = static_cast<std::int32_t>(set.samples_.size());
                signs = 0;
                distance.fill(BrickLattice::of(grid, i, j, k), {-set.clamp_, set.clamp_}, distances);
                for (const double d : distances) {
                    set.samples_.push_back(quantised(d, set.quantum_));
                    signs |= set.samples_.back() < 0 ? inside : outside;
                }
            }
    return set;
}

std::int16_t LevelSet::sample(int i, int j, int k) const noexcept {
    if (i < 0 || j < 0 || k < 0 || i >= grid_.samples(0) || j >= grid_.samples(1) || k >= grid_.samples(2))
        return 32767;
    const std::size_t b = grid_.brick_index(i / brick_edge, j / brick_edge, k / brick_edge);
    return brick(start_[b])[((k % brick_edge) * stored_edge + j % brick_edge) * stored_edge + i % brick_edge];
}

}  // namespace kerf
