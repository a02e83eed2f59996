// SPDX-License-Identifier: Apache-2.0
#include "core/field/grid/density_field.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace kerf {

DensityField DensityField::build(const Grid& grid, const std::function<bool(std::size_t)>& is_needed,
                                 const std::function<double(Vec3)>& density) {
    DensityField field;
    field.start_.assign(grid.brick_count() + 1, -1);
    std::size_t needed = 0;
    for (std::size_t brick = 0; brick < grid.brick_count(); ++brick) needed += is_needed(brick);
    if (needed > max_stored_bricks) throw std::length_error("more bricks than one field can store");
    field.samples_.reserve(needed * stored_samples);
    for (int k = 0; k < grid.bricks[2]; ++k)
        for (int j = 0; j < grid.bricks[1]; ++j)
            for (int i = 0; i < grid.bricks[0]; ++i) {
                const std::size_t index = grid.brick_index(i, j, k);
                if (!is_needed(index)) continue;
                field.start_[index] = static_cast<std::int32_t>(field.samples_.size());
                for (int z = 0; z < stored_edge; ++z)
                    for (int y = 0; y < stored_edge; ++y)
                        for (int x = 0; x < stored_edge; ++x)
                            field.samples_.push_back(static_cast<float>(density(
                                grid.sample_position(i * brick_edge + x, j * brick_edge + y, k * brick_edge + z))));
            }
    if (!field.is_empty())
        field.largest_ = static_cast<double>(*std::max_element(field.samples_.begin(), field.samples_.end()));
    return field;
}

double DensityField::mean() const noexcept {
    double sum = 0.0;
    for (const float density : samples_) sum += static_cast<double>(density);
    return is_empty() ? 0.0 : sum / static_cast<double>(samples_.size());
}

}  // namespace kerf
