// SPDX-License-Identifier: Apache-2.0
#include "core/field/level_set.h"

#include <cmath>

namespace kerf {

LevelSet LevelSet::build(const Grid& grid, const std::function<double(Vec3)>& distance) {
    LevelSet set;
    set.grid_ = grid;
    set.clamp_ = grid.clamp();
    set.quantum_ = grid.quantum();
    set.table_.assign(grid.brick_count(), air);

    // A brick whose centre is farther from the surface than its own corner plus the band is uniform.
    const double reach = (0.5 * brick_edge * std::sqrt(3.0) + clamp_voxels) * grid.spacing;
    for (int k = 0; k < grid.bricks[2]; ++k)
        for (int j = 0; j < grid.bricks[1]; ++j)
            for (int i = 0; i < grid.bricks[0]; ++i) {
                auto& slot = set.table_[grid.brick_index(i, j, k)];
                const Vec3 low = grid.sample_position(i * brick_edge, j * brick_edge, k * brick_edge);
                const double half = 0.5 * brick_edge * grid.spacing;
                const double at_centre = distance(low + Vec3{half, half, half});
                if (std::abs(at_centre) > reach) {
                    slot = at_centre > 0.0 ? air : solid;
                    continue;
                }
                slot = static_cast<std::int32_t>(set.pool_.size() / stored_samples);
                for (int z = 0; z < stored_edge; ++z)
                    for (int y = 0; y < stored_edge; ++y)
                        for (int x = 0; x < stored_edge; ++x) {
                            const Vec3 p =
                                grid.sample_position(i * brick_edge + x, j * brick_edge + y, k * brick_edge + z);
                            set.pool_.push_back(quantised(distance(p), set.quantum_));
                        }
            }
    set.pool_.shrink_to_fit();
    return set;
}

void LevelSet::at(const PlaceBlock& places, BlockValues& distances) const noexcept {
    CornerBlock<std::int16_t> corners(places);
    for (std::size_t i = 0; i < places.count; ++i) {
        const std::int32_t slot =
            places.brick[i] == PlaceBlock::outside ? air : table_[static_cast<std::size_t>(places.brick[i])];
        if (slot < 0)
            distances[i] = slot == air ? clamp_ : -clamp_;
        else
            corners.add(brick(slot), i);
    }
    corners.interpolate(quantum_, distances);
}

bool LevelSet::at(const PlaceBlock& places, SlopeBlock& distances) const noexcept {
    CornerBlock<std::int16_t> corners(places);
    for (std::size_t i = 0; i < places.count; ++i) {
        const std::int32_t slot =
            places.brick[i] == PlaceBlock::outside ? air : table_[static_cast<std::size_t>(places.brick[i])];
        if (slot < 0)
            distances.set(i, slot == air ? clamp_ : -clamp_);
        else
            corners.add(brick(slot), i);
    }
    corners.interpolate(quantum_, distances);
    return !corners.is_empty();
}

std::int16_t LevelSet::sample(int i, int j, int k) const noexcept {
    if (i < 0 || j < 0 || k < 0 || i >= grid_.samples(0) || j >= grid_.samples(1) || k >= grid_.samples(2))
        return 32767;
    const std::size_t b = grid_.brick_index(i / brick_edge, j / brick_edge, k / brick_edge);
    if (table_[b] < 0) return uniform_value(b);
    return brick(table_[b])[((k % brick_edge) * stored_edge + j % brick_edge) * stored_edge + i % brick_edge];
}

}  // namespace kerf
