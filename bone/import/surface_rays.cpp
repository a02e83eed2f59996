// SPDX-License-Identifier: Apache-2.0
#include "bone/import/surface_rays.h"

#include <algorithm>
#include <cmath>

namespace kerf::bone {
namespace {

constexpr double min_step = 0.05e-3;  // [m] may miss thinner bone

/// The stretch of a ray in a box [m]; empty if `low` is above `high`.
struct Stretch {
    double low = 0.0, high = 0.0;
};
Stretch within(const Box& box, Vec3 centre, Vec3 direction, double far) noexcept {
    Stretch stretch{0.0, far};
    const auto clip = [&](double at, double along, double low, double high) {
        if (along == 0.0) {
            if (at < low || at > high) stretch.high = -1.0;
            return;
        }
        const double a = (low - at) / along, b = (high - at) / along;
        stretch.low = std::max(stretch.low, std::min(a, b));
        stretch.high = std::min(stretch.high, std::max(a, b));
    };
    clip(centre.x, direction.x, box.low.x, box.high.x);
    clip(centre.y, direction.y, box.low.y, box.high.y);
    clip(centre.z, direction.z, box.low.z, box.high.z);
    return stretch;
}

}  // namespace

RayHit surface_inwards(const BoneShape& bone, Vec3 centre, Vec3 direction, double far) {
    const auto distance_at = [&](double radius) { return bone.distance(centre + radius * direction); };
    const Stretch known = within(bone.known, centre, direction, far);
    if (known.low > known.high) return {};
    double outer = known.high, at_outer = distance_at(outer);
    if (at_outer <= 0.0) return {RayHit::Kind::starts_in_bone, far};
    while (outer > known.low) {
        double inner = std::max(known.low, outer - std::max(at_outer, min_step)), at_inner = distance_at(inner);
        if (at_inner > 0.0) {
            outer = inner;
            at_outer = at_inner;
            continue;
        }
        while (outer - inner > min_step) {
            const double middle = 0.5 * (outer + inner), at_middle = distance_at(middle);
            (at_middle > 0.0 ? outer : inner) = middle;
            (at_middle > 0.0 ? at_outer : at_inner) = at_middle;
        }
        // One step of the secant: the distance is nearly linear over 0.05 mm.
        return {RayHit::Kind::surface, outer - (outer - inner) * at_outer / (at_outer - at_inner)};
    }
    return {};
}

std::vector<Vec3> even_directions(int count) {
    constexpr double cos_golden = -0.73736887807831990, sin_golden = 0.67549029426152364;
    std::vector<Vec3> directions;
    double c = 1.0, s = 0.0;
    for (int i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / count, r = std::sqrt(1.0 - z * z);
        directions.push_back({r * c, r * s, z});
        const double next = c * cos_golden - s * sin_golden;
        s = s * cos_golden + c * sin_golden;
        c = next;
    }
    return directions;
}

std::vector<Vec3> directions_across(Vec3 axis) {
    constexpr int count = 64;
    constexpr double cos_step = 0.99518472667219693, sin_step = 0.098017140329560604;  // of 2π / 64
    const Vec3 other = std::abs(axis.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 right = normalized(cross(other, axis)), up = cross(axis, right);
    std::vector<Vec3> directions;
    double c = 1.0, s = 0.0;
    for (int i = 0; i < count; ++i) {
        directions.push_back(c * right + s * up);
        const double next = c * cos_step - s * sin_step;
        s = s * cos_step + c * sin_step;
        c = next;
    }
    return directions;
}

}  // namespace kerf::bone
