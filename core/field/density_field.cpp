// SPDX-License-Identifier: Apache-2.0
#include "core/field/density_field.h"

#include <algorithm>

namespace kerf {

DensityField DensityField::build(const Grid& grid, const std::function<bool(std::size_t)>& is_needed,
                                 const std::function<double(Vec3)>& density) {
    DensityField field;
    field.table_.assign(grid.brick_count(), -1);
    for (int k = 0; k < grid.bricks[2]; ++k)
        for (int j = 0; j < grid.bricks[1]; ++j)
            for (int i = 0; i < grid.bricks[0]; ++i) {
                const std::size_t index = grid.brick_index(i, j, k);
                if (!is_needed(index)) continue;
                field.table_[index] = static_cast<std::int32_t>(field.pool_.size() / stored_samples);
                for (int z = 0; z < stored_edge; ++z)
                    for (int y = 0; y < stored_edge; ++y)
                        for (int x = 0; x < stored_edge; ++x)
                            field.pool_.push_back(static_cast<float>(density(
                                grid.sample_position(i * brick_edge + x, j * brick_edge + y, k * brick_edge + z))));
            }
    field.pool_.shrink_to_fit();
    if (!field.is_empty())
        field.largest_ = static_cast<double>(*std::max_element(field.pool_.begin(), field.pool_.end()));
    return field;
}

double DensityField::mean() const noexcept {
    double sum = 0.0;
    for (const float density : pool_) sum += static_cast<double>(density);
    return is_empty() ? 0.0 : sum / static_cast<double>(pool_.size());
}

void DensityField::at(const PlaceBlock& places, double elsewhere, BlockValues& densities) const noexcept {
    CornerBlock<float> corners(places);
    for (std::size_t i = 0; i < places.count; ++i) {
        const bool is_known = !is_empty() && places.brick[i] != PlaceBlock::outside;
        const std::int32_t slot = is_known ? table_[static_cast<std::size_t>(places.brick[i])] : -1;
        if (slot < 0)
            densities[i] = elsewhere;
        else
            corners.add(brick(slot), i);
    }
    corners.interpolate(1.0, densities);
}

}  // namespace kerf
