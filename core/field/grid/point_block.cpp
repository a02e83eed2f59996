// SPDX-License-Identifier: Apache-2.0
#include "core/field/grid/point_block.h"

#include <cstddef>
#include <cstdint>

namespace kerf {

void transform(const Pose& a_from_b, const PointBlock& points_in_b, PointBlock& points_in_a) noexcept {
    points_in_a.count = points_in_b.count;
    block_kernel().transform(a_from_b, points_in_b.count, points_in_b.coordinates(), points_in_a.writable());
}

void transform(const Frame& a_from_b, const Vec3* points_in_b, std::size_t count, PointBlock& points_in_a) noexcept {
    points_in_a.count = count;
    block_kernel().move(a_from_b, count, points_in_b, points_in_a.writable());
}

GridFrame::GridFrame(const Grid& grid, const Region& region, const Frame& body_from_points) noexcept {
    const int bits = fraction_bits(grid);
    const double one = static_cast<double>(std::int64_t{1} << bits), scale = one / grid.spacing;
    fixed_from_points_ = scaled_from(body_from_points, grid.origin, scale);
    const Vec3 low = scale * (region.low - grid.origin), high = scale * (region.high - grid.origin);
    lattice_ = {{low.x, low.y, low.z},
                {high.x, high.y, high.z},
                {},
                bits,
                !region.is_everywhere(),
                grid.bricks[0],
                grid.bricks[0] * grid.bricks[1],
                static_cast<std::int32_t>(grid.brick_count())};
    for (std::size_t axis = 0; axis < 3; ++axis)
        lattice_.end[axis] = static_cast<std::uint32_t>(grid.samples(axis)) << bits;
}

void GridFrame::place(const Vec3* points, std::size_t count, LocatedBlock& places, PointBox* box) const noexcept {
    places.count = count;
    block_kernel().place(
        fixed_from_points_, lattice_, count, points,
        {places.brick.data(), places.offset.data(), places.fx.data(), places.fy.data(), places.fz.data()}, box);
}

}  // namespace kerf
