// SPDX-License-Identifier: Apache-2.0
#include "core/field/bridge.h"

#include <algorithm>
#include <cmath>

namespace kerf {

namespace {

/// Present distance [m], positive in air; as far as it is known.
double distance_to(const CutBone& piece, Vec3 p) {
    const BrickPlace place = locate(*piece.bone, p);
    if (!place.is_inside) return piece.bone->grid().clamp();
    return std::max(piece.bone->surface.at(place), piece.cut->at(place));
}

}  // namespace

std::optional<Bridge> bridge_between(const CutBone& a, const CutBone& b, const Pose& b_from_a) {
    const Grid& grid = a.bone->grid();
    const double far = grid.clamp() + b.bone->grid().clamp(), h = grid.spacing;
    struct Facing {
        double of_a, of_b;
    };
    const auto facing = [&](Vec3 p) { return Facing{distance_to(a, p), distance_to(b, b_from_a * p)}; };

    // Where both are known at once, and how near they come to each other.
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high = -low;
    double least = far;
    for (int k = 0; k < grid.bricks[2] * brick_edge; ++k)
        for (int j = 0; j < grid.bricks[1] * brick_edge; ++j)
            for (int i = 0; i < grid.bricks[0] * brick_edge; ++i) {
                const Vec3 p = grid.sample_position(i, j, k);
                const Facing at = facing(p);
                if (at.of_a < 0.0 || at.of_b < 0.0 || at.of_a >= grid.clamp() || at.of_b >= b.bone->grid().clamp()) continue;
                least = std::min(least, at.of_a + at.of_b);
                low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
            }
    if (!(least < far)) return std::nullopt;

    const double width = 1.05 * least + 0.5 * h, margin = 6.0 * h;
    const Vec3 around{margin, margin, margin};
    const Grid own = Grid::covering(low - around, high + around, h);
    Body bridge;
    bridge.id = "bridge";
    bridge.surface = LevelSet::build(own, [&](Vec3 p) {
        const Facing at = facing(p);
        return std::max({0.5 * (at.of_a + at.of_b - width), -at.of_a, -at.of_b});
    });
    for (const Material& material : a.bone->materials)
        bridge.materials.push_back({material.id, material.density, LevelSet::build(own, [&](Vec3) { return own.clamp(); })});
    return Bridge{std::move(bridge), least};
}

}  // namespace kerf
