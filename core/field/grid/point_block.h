// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/field/grid/frame.h"
#include "core/field/grid/grid.h"
#include "core/field/grid/kernel/block_kernel.h"
#include "core/field/grid/region.h"

/// Points that are queried together. Each coordinate has its own array, so that each step processes many points at
/// once.
///
/// A block function does for every point the operations of the scalar function of the same name, and gives the same
/// bits.
namespace kerf {

inline constexpr std::size_t block_capacity = 256;
using BlockValues = std::array<double, block_capacity>;
using FloatBlock = std::array<float, block_capacity>;

/// At most `block_capacity` points. The frame is that of the function that takes them. Coordinates may be NaN.
struct PointBlock {
    std::size_t count = 0;
    BlockValues x, y, z;

    void add(Vec3 p) noexcept {
        x[count] = p.x;
        y[count] = p.y;
        z[count] = p.z;
        ++count;
    }
    [[nodiscard]] Vec3 operator[](std::size_t i) const noexcept { return {x[i], y[i], z[i]}; }
    [[nodiscard]] ConstCoordinates coordinates() const noexcept { return {x.data(), y.data(), z.data()}; }
    [[nodiscard]] Coordinates writable() noexcept { return {x.data(), y.data(), z.data()}; }
};

/// Unit directions of points that are queried together: one for all points, or one for each. Refers to the caller's
/// array.
class Directions {
public:
    [[nodiscard]] static Directions one(const Vec3& direction) noexcept { return {&direction, true}; }
    [[nodiscard]] static Directions each(const Vec3* directions) noexcept { return {directions, false}; }
    /// Returns the directions of a plugin's query of `points` points. With `count` = `points` each point has its own;
    /// else the first is for all. Without any, it is the tool's axis.
    [[nodiscard]] static Directions given(const Vec3* directions, std::uint32_t count, std::uint32_t points) noexcept {
        static constexpr Vec3 along_the_shaft{0, 0, 1};
        return count == 0 ? one(along_the_shaft) : count == points ? each(directions) : one(*directions);
    }
    [[nodiscard]] bool is_one() const noexcept { return is_one_; }
    [[nodiscard]] Vec3 operator[](std::size_t i) const noexcept { return direction_[is_one_ ? 0 : i]; }
    /// Returns the directions of the points from `first` on.
    [[nodiscard]] Directions from(std::size_t first) const noexcept {
        return is_one_ ? *this : each(direction_ + first);
    }

private:
    Directions(const Vec3* directions, bool is_one) noexcept : direction_(directions), is_one_(is_one) {}
    const Vec3* direction_;
    bool is_one_;
};

/// Transforms points from frame b to frame a.   [any] pure, nonblocking.
void transform(const Pose& a_from_b, const PointBlock& points_in_b, PointBlock& points_in_a) noexcept;
/// Transforms `count` ≤ `block_capacity` points.
void transform(const Frame& a_from_b, const Vec3* points_in_b, std::size_t count, PointBlock& points_in_a) noexcept;

/// As `LocatedPoint`, for a block. Behind the last point, its copies fill the arrays up to a multiple of eight.
struct LocatedBlock {
    std::size_t count = 0;
    /// Outside the grid `brick` is Grid::brick_count(), and no other member is valid.
    alignas(32) std::array<std::int32_t, block_capacity> brick, offset;
    alignas(32) FloatBlock fx, fy, fz;

    [[nodiscard]] ConstLocatedArrays places() const noexcept {
        return {brick.data(), offset.data(), fx.data(), fy.data(), fz.data()};
    }
};
/// Transforms points of a frame to cells of a grid. Made once for all points of a query.
class GridFrame {
public:
    GridFrame(const Grid& grid, const Region& region, const Frame& body_from_points) noexcept;

    /// Writes the cells of `count` ≤ `block_capacity` points. A point outside the region gets the cell of the region's
    /// nearest point.   [any] pure, nonblocking.
    void locate(const Vec3* points, std::size_t count, LocatedBlock& places) const noexcept {
        place(points, count, places, nullptr);
    }
    /// Writes the cells as `locate`. Returns the bounding box of the points in their own frame.
    [[nodiscard]] PointBox locate_box(const Vec3* points, std::size_t count, LocatedBlock& places) const noexcept {
        PointBox box;
        place(points, count, places, &box);
        return box;
    }
    /// Returns a point's coordinates from the first sample, in voxels times 2^bits, also outside the region.
    [[nodiscard]] Vec3 operator*(Vec3 point) const noexcept { return fixed_from_points_ * point; }
    [[nodiscard]] const Lattice& lattice() const noexcept { return lattice_; }

private:
    void place(const Vec3* points, std::size_t count, LocatedBlock& places, PointBox* box) const noexcept;

    Frame fixed_from_points_;
    Lattice lattice_;
};

/// Values of a field [quanta] and their gradients [quanta per voxel], from trilinear interpolation.
struct SlopeBlock {
    alignas(32) FloatBlock value, x, y, z;

    [[nodiscard]] Slopes writable() noexcept { return {value.data(), x.data(), y.data(), z.data()}; }
    [[nodiscard]] ConstSlopes slopes() const noexcept { return {value.data(), x.data(), y.data(), z.data()}; }
};

}  // namespace kerf
