// SPDX-License-Identifier: Apache-2.0
#include "hole_before.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kerf::implant {

namespace {

constexpr double ahead = 0.3e-3;    // [m] ahead of the tip, which its own cut has not reached
constexpr double radial = 0.7;      // [–] smallest radial part of a normal of the hole's wall
constexpr double withdrawn = 1e-3;  // [m] from the tip to the hole, beyond which it has left the hole [judgement]
constexpr std::size_t directions = 4;

}  // namespace

int HoleBefore::index_of(double depth) noexcept {
    return std::clamp(static_cast<int>(std::floor(depth / step)), 0, max_entries - 1);
}

void HoleBefore::measure(const ScrewThread& thread, const BoneQuery& bone, double along) noexcept {
    if (known_ > 0) depth_ += along;
    if (depth_ < -withdrawn) *this = {};
    const int index = index_of(depth_);
    if (index < known_) return;
    const double probed = thread.mean_radius(0.0);
    const std::array<Vec3, directions> at{Vec3{probed, 0, ahead}, Vec3{0, probed, ahead}, Vec3{-probed, 0, ahead},
                                          Vec3{0, -probed, ahead}};
    std::array<kerf_surface_point, directions> wall;
    bone.nearest(at, wall);
    double sum = 0.0;
    int found = 0;
    for (std::size_t i = 0; i < directions; ++i) {
        const auto& [distance, normal, body, reserved] = wall[i];
        const double across = std::abs(normal.x * at[i].x + normal.y * at[i].y) / probed;
        const bool is_deep = distance <= -0.99 * bone.reach();
        if (!is_deep && across < radial) continue;
        sum += std::max(0.0, probed + distance);
        ++found;
    }
    if (found == 0) return;
    for (; known_ <= index; ++known_) radius_[static_cast<std::size_t>(known_)] = static_cast<float>(sum / found);
}

double HoleBefore::radius_at(double z) const noexcept {
    if (known_ == 0) return 0.0;
    const int index = std::min(index_of(depth_ + z - ahead), known_ - 1);
    return static_cast<double>(radius_[static_cast<std::size_t>(index)]);
}

}  // namespace kerf::implant
