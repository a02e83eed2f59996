// SPDX-License-Identifier: Apache-2.0
#include "core/field/pieces/bridge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/field/grid/growing_distance.h"

namespace kerf {

namespace {

/// Returns the signed distance to a piece [m], negative inside, within ± the clamp of its fields.
double distance_to(const CutBone& piece, Vec3 p) {
    const LocatedPoint place = locate(*piece.bone, p);
    if (!place.is_inside) return piece.bone->grid().clamp();
    return std::max(piece.bone->surface.at(place), piece.cut->at(place));
}

/// Distances to a piece [m] at a grid's samples. Below 1.5 voxels they are the stored ones. Farther out, stored
/// distances are clamped, or too small as near an edge of a cut. There `grow_distances` computes them.
class FarDistances {
public:
    /// `near(point)` returns the stored distance [m]; the point is in the frame of the grid.
    template <class Near>
    FarDistances(const Grid& grid, const Near& near) : grid_(grid) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            count_[axis] = grid.samples(axis) + 1;  // with the aprons of the last bricks
        std::vector<std::uint8_t> is_fixed;
        for (int k = 0; k < count_[2]; ++k)
            for (int j = 0; j < count_[1]; ++j)
                for (int i = 0; i < count_[0]; ++i) {
                    const double d = near(grid.sample_position(i, j, k));
                    is_fixed.push_back(d < 1.5 * grid.spacing);
                    distance_.push_back(is_fixed.back() != 0 ? d : HUGE_VAL);
                }
        grow_distances(count_, {grid.spacing, grid.spacing, grid.spacing}, is_fixed, HUGE_VAL, distance_);
    }
    [[nodiscard]] std::size_t count() const { return distance_.size(); }
    [[nodiscard]] double operator[](std::size_t n) const { return distance_[n]; }
    [[nodiscard]] double at(Vec3 sample) const {
        const Vec3 place = (1.0 / grid_.spacing) * (sample - grid_.origin);
        const auto i = std::lround(place.x), j = std::lround(place.y), k = std::lround(place.z);
        return distance_[static_cast<std::size_t>((k * count_[1] + j) * count_[0] + i)];
    }

private:
    Grid grid_;
    std::array<int, 3> count_{};
    std::vector<double> distance_;
};

}  // namespace

std::optional<Bridge> bridge_between(const CutBone& a, const CutBone& b, const Pose& b_from_a) {
    const Grid& grid = a.bone->grid();
    const double h = grid.spacing;
    const auto to_a = [&](Vec3 p) { return distance_to(a, p); };
    const auto to_b = [&](Vec3 p) { return distance_to(b, b_from_a * p); };

    // Find the box around the samples outside both pieces at which both distances are below their clamps.
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high = -low;
    for (int k = 0; k < grid.bricks[2] * brick_edge; ++k)
        for (int j = 0; j < grid.bricks[1] * brick_edge; ++j)
            for (int i = 0; i < grid.bricks[0] * brick_edge; ++i) {
                const Vec3 p = grid.sample_position(i, j, k);
                const double of_a = to_a(p);
                if (of_a < 0.0 || of_a >= grid.clamp()) continue;
                const double of_b = to_b(p);
                if (of_b < 0.0 || of_b >= b.bone->grid().clamp()) continue;
                low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
            }
    if (!(low.x <= high.x)) return std::nullopt;

    // Find the smallest sum of both distances in this box and a margin.
    const double margin = 6.0 * h;
    const Vec3 around{margin, margin, margin};
    const Grid own = Grid::covering(low - around, high + around, h);
    const FarDistances from_a(own, to_a), from_b(own, to_b);
    double minimum = HUGE_VAL;
    for (std::size_t n = 0; n < from_a.count(); ++n)
        if (from_a[n] >= 0.0 && from_b[n] >= 0.0) minimum = std::min(minimum, from_a[n] + from_b[n]);
    const double width = 1.05 * minimum + 0.5 * h;
    Body bridge;
    bridge.id = "bridge";
    bridge.surface = LevelSet::build(own, [&](Vec3 p) {
        const double of_a = from_a.at(p), of_b = from_b.at(p);
        return std::max({0.5 * (of_a + of_b - width), -of_a, -of_b});
    });
    for (const Material& material : a.bone->materials)
        bridge.materials.push_back(
            {material.id, material.density, LevelSet::build(own, [&](Vec3) { return own.clamp(); })});
    return Bridge{std::move(bridge), minimum};
}

}  // namespace kerf
