// SPDX-License-Identifier: Apache-2.0
#include "core/field/removed_volume.h"

#include <algorithm>
#include <cmath>

namespace kerf {

namespace {
/// Share of a voxel that is inside a surface at distance `d` voxels from its centre.
double inside_share(double d) noexcept { return std::clamp(0.5 - d, 0.0, 1.0); }

/// Share of a voxel that two half spaces have in common, of which each alone takes a share `a` and `b`, and whose ways in are
/// `cosine` to each other: the smaller where they face alike, their product across, and what they have too much where they
/// face each other; in between in proportion. An edge of a cut is such a voxel: counted as facing, it would lose a twelfth of
/// a voxel's area for every length of edge.
double common_share(double a, double b, double cosine) noexcept {
    const double across = a * b;
    return cosine > 0.0 ? across + cosine * (std::min(a, b) - across) : across + cosine * (across - std::max(0.0, a + b - 1.0));
}
/// Between the ways into the bone and into the cut, by differences to the next samples along each axis. Where nothing of the
/// bone is stored, as if they faced each other.
double cosine_of(const std::int16_t* bone, const std::int16_t* cut) noexcept {
    if (bone == nullptr) return -1.0;
    double common = 0.0, of_bone = 0.0, of_cut = 0.0;
    for (const int step : {1, stored_edge, stored_edge * stored_edge}) {
        const double in_bone = bone[0] - bone[step], in_cut = cut[step] - cut[0];
        common += in_bone * in_cut;
        of_bone += in_bone * in_bone;
        of_cut += in_cut * in_cut;
    }
    return of_bone > 0.0 && of_cut > 0.0 ? common / std::sqrt(of_bone * of_cut) : -1.0;
}

}  // namespace

void RemovedVolume::update(CutField& cut) {
    const Grid& g = body_->grid();
    const double voxels_per_quantum = g.quantum() / g.spacing;
    const double voxel_volume = g.spacing * g.spacing * g.spacing;
    for (const std::size_t b : cut.take_changed()) {
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
                    const double bone_share = inside_share(phi), cut_share = inside_share(-voxels_per_quantum * removed[o]);
                    if (bone_share <= 0.0 || cut_share <= 0.0) continue;
                    double share = std::min(bone_share, cut_share);
                    if (bone_share < 1.0 && cut_share < 1.0)
                        share = common_share(bone_share, cut_share, cosine_of(bone != nullptr ? bone + o : nullptr, removed + o));
                    if (share <= 0.0) continue;
                    BrickPlace place;
                    place.is_inside = true;
                    place.brick = b;
                    place.offset = o;
                    double weight[KERF_MAX_TISSUES];
                    material_weights(*body_, place, weight);
                    for (std::size_t m = 0; m < KERF_MAX_TISSUES; ++m) gone[m] += share * weight[m];
                }
        for (std::size_t m = 0; m < KERF_MAX_TISSUES; ++m) {
            const auto now = static_cast<float>(gone[m]);
            total_[m] += (static_cast<double>(now) - static_cast<double>(per_brick_[b][m])) * voxel_volume;
            per_brick_[b][m] = now;
        }
    }
}

double RemovedVolume::total() const noexcept {
    double sum = 0.0;
    for (const double v : total_) sum += v;
    return sum;
}

}  // namespace kerf
