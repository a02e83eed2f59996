// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/block_kernel.h"
#include "core/field/grid.h"

/// Points asked about together. Coordinate by coordinate, so that the same step is taken for many of them at once.
///
/// Each stage does for every point what its scalar namesake does for one, operation by operation: the same bits.
namespace kerf {

inline constexpr std::size_t block_capacity = 64;
using BlockValues = std::array<double, block_capacity>;

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

/// `count` ≤ `block_capacity` points, taken from frame b to frame a.   [any] pure, nonblocking.
void transform(const Pose& a_from_b, const Vec3* points_in_b, std::size_t count, PointBlock& points_in_a) noexcept;
void transform(const Pose& a_from_b, const PointBlock& points_in_b, PointBlock& points_in_a) noexcept;

/// All points moved by the same vector.   [any] pure, nonblocking.
void shift(const PointBlock& points, Vec3 by, PointBlock& shifted) noexcept;

/// Every coordinate kept between `low` and `high`; NaN stays.   [any] pure, nonblocking.
void clamp(const PointBlock& points, Vec3 low, Vec3 high, PointBlock& clamped) noexcept;

/// As `BrickPlace`, for a block.
struct PlaceBlock {
    static constexpr std::int32_t outside = -1;
    std::size_t count = 0;
    std::array<std::int32_t, block_capacity> brick, offset;
    BlockValues fx, fy, fz;

    void add(const PlaceBlock& from, std::size_t i) noexcept {
        brick[count] = from.brick[i];
        offset[count] = from.offset[i];
        fx[count] = from.fx[i];
        fy[count] = from.fy[i];
        fz[count] = from.fz[i];
        ++count;
    }
};
/// As `locate` of one point.   [any] pure, nonblocking.
void locate(const Grid& grid, const PointBlock& points, PlaceBlock& places) noexcept;

/// Values of a field and their gradients [quanta per voxel], as the interpolation between eight samples has them.
struct SlopeBlock {
    BlockValues value, x, y, z;

    void set(std::size_t i, double v) noexcept {
        value[i] = v;
        x[i] = y[i] = z[i] = 0.0;
    }
};

/// The eight samples around those points of a block that lie in a stored brick; the others cost nothing more.
template <class Sample>
class CornerBlock {
public:
    explicit CornerBlock(const PlaceBlock& places) noexcept : places_(&places) {}

    /// `brick`: its 9³ samples. Points in ascending order.
    void add(const Sample* brick, std::size_t i) noexcept {
        corner_[count_] = brick + places_->offset[i];
        lane_[count_++] = static_cast<std::uint8_t>(i);
    }
    /// Trilinear values times `quantum`, each to where its point stood in the block.
    void interpolate(double quantum, BlockValues& values) const noexcept;
    /// The same with gradients.
    void interpolate(double quantum, SlopeBlock& slopes) const noexcept;
    [[nodiscard]] bool is_empty() const noexcept { return count_ == 0; }

private:
    const PlaceBlock* places_;
    std::size_t count_ = 0;
    std::array<const Sample*, block_capacity> corner_;
    std::array<std::uint8_t, block_capacity> lane_;
};

}  // namespace kerf
