// SPDX-License-Identifier: Apache-2.0
#include "core/field/removed_volume.h"

#include <algorithm>

namespace kerf {

namespace {
/// Share of a voxel that is inside a surface at distance `d` voxels from its centre.
double inside_share(double d) noexcept { return std::clamp(0.5 - d, 0.0, 1.0); }
}  // namespace

std::array<float, KERF_MAX_TISSUES> RemovedVolume::gone_in(const CutField& cut, std::size_t b) const noexcept {
    const double voxels_per_quantum = body_->grid().quantum() / body_->grid().spacing;
    std::array<double, KERF_MAX_TISSUES> gone{};
    const std::int16_t* removed = cut.stored(b);
    const std::int16_t* bone = body_->surface.stored(b);
    const std::int16_t uniform = body_->surface.uniform_value(b);
    const std::int16_t* room = body_->hollow.is_empty() ? nullptr : body_->hollow.stored(b);
    const int no_room = body_->hollow.is_empty() ? 0 : body_->hollow.uniform_value(b);
    for (int z = 0; z < brick_edge; ++z)
        for (int y = 0; y < brick_edge; ++y)
            for (int x = 0; x < brick_edge; ++x) {
                const int o = (z * stored_edge + y) * stored_edge + x;
                int before = bone != nullptr ? bone[o] : uniform;
                if (!body_->hollow.is_empty()) before = std::max(before, -(room != nullptr ? room[o] : no_room));
                const double phi = voxels_per_quantum * before;
                const double after = std::max(phi, voxels_per_quantum * removed[o]);
                const double share = inside_share(phi) - inside_share(after);
                if (share <= 0.0) continue;
                BrickPlace place;
                place.is_inside = true;
                place.brick = b;
                place.offset = o;
                double weight[KERF_MAX_TISSUES];
                material_weights(*body_, place, weight);
                for (std::size_t m = 0; m < KERF_MAX_TISSUES; ++m) gone[m] += share * weight[m];
            }
    std::array<float, KERF_MAX_TISSUES> result{};
    std::transform(gone.begin(), gone.end(), result.begin(), [](double v) { return static_cast<float>(v); });
    return result;
}

void RemovedVolume::update(const CutField& cut, std::span<const std::size_t> changed) {
    const double h = body_->grid().spacing, voxel_volume = h * h * h;
    for (const std::size_t b : changed) {
        const auto now = gone_in(cut, b);
        for (std::size_t m = 0; m < KERF_MAX_TISSUES; ++m)
            total_[m] += (static_cast<double>(now[m]) - static_cast<double>(per_brick_[b][m])) * voxel_volume;
        per_brick_[b] = now;
    }
}

void RemovedVolume::go_on_with(const CutField& cut) {
    for (std::size_t b = 0; b < per_brick_.size(); ++b)
        if (cut.stored(b) != nullptr && !cut.is_gone(b)) per_brick_[b] = gone_in(cut, b);
}

double RemovedVolume::total() const noexcept {
    double sum = 0.0;
    for (const double v : total_) sum += v;
    return sum;
}

}  // namespace kerf
