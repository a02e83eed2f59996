// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/field/grid/frame.h"
#include "core/field/grid/grid.h"
#include "core/field/grid/kernel/block_kernel.h"
#include "core/field/grid/region.h"

/// Points asked about together. Coordinate by coordinate, so that the same step is taken for many of them at once.
///
/// Each stage does for every point what its scalar namesake does for one, operation by operation: the same bits.
namespace kerf {

inline constexpr std::size_t block_capacity = 256;
using BlockValues = std::array<double, block_capacity>;
using FloatBlock = std::array<float, block_capacity>;

/// At most `block_capacity` points. Frame: as the function that takes it says; any double, also NaN.
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

/// Unit directions of points that are asked about together: one for all of them, or one each.
class Directions {
public:
    [[nodiscard]] static Directions one(const Vec3& direction) noexcept { return {&direction, true}; }
    [[nodiscard]] static Directions each(const Vec3* directions) noexcept { return {directions, false}; }
    /// As a plugin gives them for `points` points: one each where there are as many, else the first of them for all.
    [[nodiscard]] static Directions given(const Vec3* directions, std::uint32_t count, std::uint32_t points) noexcept {
        static constexpr Vec3 along_the_shaft{0, 0, 1};
        return count == 0 ? one(along_the_shaft) : count == points ? each(directions) : one(*directions);
    }
    [[nodiscard]] bool is_one() const noexcept { return is_one_; }
    [[nodiscard]] Vec3 operator[](std::size_t i) const noexcept { return direction_[is_one_ ? 0 : i]; }
    /// Of the points from `first` on.
    [[nodiscard]] Directions from(std::size_t first) const noexcept {
        return is_one_ ? *this : each(direction_ + first);
    }

private:
    Directions(const Vec3* directions, bool is_one) noexcept : direction_(directions), is_one_(is_one) {}
    const Vec3* direction_;
    bool is_one_;
};

/// Taken from frame b to frame a.   [any] pure, nonblocking.
void transform(const Pose& a_from_b, const PointBlock& points_in_b, PointBlock& points_in_a) noexcept;
/// The same of `count` ≤ `block_capacity` points.
void transform(const Frame& a_from_b, const Vec3* points_in_b, std::size_t count, PointBlock& points_in_a) noexcept;

/// As `BrickPlace`, for a block. Behind the last point the last once more, up to a multiple of eight.
struct PlaceBlock {
    std::size_t count = 0;
    alignas(32) std::array<std::int32_t, block_capacity> brick,
        offset;  ///< outside the grid: Grid::brick_count(), and then nothing else counts
    alignas(32) FloatBlock fx, fy, fz;

    [[nodiscard]] ConstPlaces places() const noexcept {
        return {brick.data(), offset.data(), fx.data(), fy.data(), fz.data()};
    }
};
/// From points of a frame to places in a grid: made once for all points asked about.
class GridFrame {
public:
    GridFrame(const Grid& grid, const Region& region, const Frame& body_from_points) noexcept;

    /// `count` ≤ `block_capacity`. Beyond the region, where it ends.   [any] pure, nonblocking.
    void locate(const Vec3* points, std::size_t count, PlaceBlock& places) const noexcept {
        place(points, count, places, nullptr);
    }
    /// The same, and the box the points lie in.
    [[nodiscard]] PointBox locate_box(const Vec3* points, std::size_t count, PlaceBlock& places) const noexcept {
        PointBox box;
        place(points, count, places, &box);
        return box;
    }
    /// In voxels times 2^bits, not taken to the region.
    [[nodiscard]] Vec3 operator*(Vec3 point) const noexcept { return fixed_from_points_ * point; }
    [[nodiscard]] const Lattice& lattice() const noexcept { return lattice_; }

private:
    void place(const Vec3* points, std::size_t count, PlaceBlock& places, PointBox* box) const noexcept;

    Frame fixed_from_points_;
    Lattice lattice_;
};

/// Values of a field and their gradients [quanta per voxel], as the interpolation between eight samples has them.
struct SlopeBlock {
    alignas(32) FloatBlock value, x, y, z;

    [[nodiscard]] Slopes writable() noexcept { return {value.data(), x.data(), y.data(), z.data()}; }
    [[nodiscard]] ConstSlopes slopes() const noexcept { return {value.data(), x.data(), y.data(), z.data()}; }
};

}  // namespace kerf
