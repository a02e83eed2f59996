// SPDX-License-Identifier: Apache-2.0
#include "core/field/cut/removed_volume.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace kerf {

namespace {
/// Returns the fraction of a voxel inside a surface. `d` [voxels]: signed distance of its centre, negative inside.
double inside_fraction(double d) noexcept { return std::clamp(0.5 - d, 0.0, 1.0); }

/// Returns the fraction of a voxel inside both of two half spaces, which contain the fractions `a` and `b` of it.
/// `cosine` is that of the angle between their inward directions. The result for parallel directions is the smaller
/// fraction, for perpendicular ones the product, for opposite ones the overlap max(0, a + b − 1). In between it is
/// linear in the cosine. At an edge of a cut the directions are perpendicular. The overlap would be too small there by
/// h²/12 per length of edge, with h the spacing.
double common_fraction(double a, double b, double cosine) noexcept {
    const double across = a * b;
    return cosine > 0.0 ? across + cosine * (std::min(a, b) - across)
                        : across + cosine * (across - std::max(0.0, a + b - 1.0));
}
/// Returns the cosine of the angle between the inward directions of bone and cut, from differences to the next sample
/// along each axis. Returns −1 if the bone has no stored samples or a gradient is zero.
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

/// For each sample of a brick, the fraction of its voxel that was bone before any cut, and the fraction that the cut
/// removed.
class BrickFractions {
public:
    BrickFractions(const Body& body, const CutField& cut, std::size_t brick) noexcept
        : voxels_per_quantum_(body.grid().quantum() / body.grid().spacing),
          removed_(cut.stored(brick)),
          bone_(body.surface.stored(brick)),
          uniform_(body.surface.uniform_value(brick)),
          has_cavity_(!body.hollow.is_empty()),
          cavity_(has_cavity_ ? body.hollow.stored(brick) : nullptr),
          uniform_cavity_(has_cavity_ ? body.hollow.uniform_value(brick) : 0) {}

    [[nodiscard]] double bone(int sample) const noexcept {
        int before = bone_ != nullptr ? bone_[sample] : uniform_;
        if (has_cavity_) before = std::max(before, -(cavity_ != nullptr ? cavity_[sample] : uniform_cavity_));
        return inside_fraction(voxels_per_quantum_ * before);
    }
    /// Returns the fraction of the sample's voxel that is removed bone. `bone` is the fraction from `bone(sample)`.
    [[nodiscard]] double lost(int sample, double bone) const noexcept {
        const double cut = removed_ != nullptr ? inside_fraction(-voxels_per_quantum_ * removed_[sample]) : 0.0;
        if (bone <= 0.0 || cut <= 0.0) return 0.0;
        if (bone >= 1.0 || cut >= 1.0) return std::min(bone, cut);
        return common_fraction(bone, cut, cosine_of(bone_ != nullptr ? bone_ + sample : nullptr, removed_ + sample));
    }

private:
    double voxels_per_quantum_;
    const std::int16_t *removed_, *bone_;
    std::int16_t uniform_;
    bool has_cavity_;
    const std::int16_t* cavity_;
    int uniform_cavity_;
};

template <class Do>
void for_each_sample(const Do& what) noexcept {
    for (int z = 0; z < brick_edge; ++z)
        for (int y = 0; y < brick_edge; ++y)
            for (int x = 0; x < brick_edge; ++x) what((z * stored_edge + y) * stored_edge + x, x, y, z);
}

}  // namespace

std::array<float, KERF_MAX_TISSUES> RemovedVolume::removed_voxels(const CutField& cut,
                                                                  std::size_t brick) const noexcept {
    std::array<double, KERF_MAX_TISSUES> removed{};
    const BrickFractions fractions(*body_, cut, brick);
    for_each_sample([&](int sample, int, int, int) {
        const double fraction = fractions.lost(sample, fractions.bone(sample));
        if (fraction <= 0.0) return;
        LocatedPoint place;
        place.is_inside = true;
        place.brick = brick;
        place.offset = sample;
        double weight[KERF_MAX_TISSUES];
        material_weights(*body_, place, weight);
        for (std::size_t m = 0; m < KERF_MAX_TISSUES; ++m) removed[m] += fraction * weight[m];
    });
    std::array<float, KERF_MAX_TISSUES> result{};
    std::transform(removed.begin(), removed.end(), result.begin(), [](double v) { return static_cast<float>(v); });
    return result;
}

void RemovedVolume::update(const CutField& cut, std::span<const std::size_t> changed) {
    const double h = body_->grid().spacing, voxel_volume = h * h * h;
    for (const std::size_t b : changed) {
        const auto now = removed_voxels(cut, b);
        for (std::size_t m = 0; m < KERF_MAX_TISSUES; ++m)
            total_[m] += (static_cast<double>(now[m]) - static_cast<double>(per_brick_[b][m])) * voxel_volume;
        per_brick_[b] = now;
    }
}

void RemovedVolume::reset_baseline(const CutField& cut) {
    for (std::size_t b = 0; b < per_brick_.size(); ++b)
        if (cut.stored(b) != nullptr && !cut.is_removed(b)) per_brick_[b] = removed_voxels(cut, b);
}

double RemovedVolume::total() const noexcept {
    double sum = 0.0;
    for (const double v : total_) sum += v;
    return sum;
}

double bone_volume(const Body& body, const CutField& cut) noexcept {
    const Grid& g = body.grid();
    double voxels = 0.0;
    for (std::size_t b = 0; b < g.brick_count(); ++b) {
        if (body.surface.is_all_air(b) || cut.is_removed(b)) continue;
        const std::array<int, 3> at = g.brick_coordinates(b);
        const BrickFractions fractions(body, cut, b);
        for_each_sample([&](int sample, int x, int y, int z) {
            if (!body.region.contains(
                    g.sample_position(at[0] * brick_edge + x, at[1] * brick_edge + y, at[2] * brick_edge + z)))
                return;
            const double bone = fractions.bone(sample);
            voxels += bone - fractions.lost(sample, bone);
        });
    }
    return voxels * g.spacing * g.spacing * g.spacing;
}

}  // namespace kerf
