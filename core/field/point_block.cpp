// SPDX-License-Identifier: Apache-2.0
#include "core/field/point_block.h"

namespace kerf {

void transform(const Pose& a_from_b, const Vec3* points_in_b, std::size_t count, PointBlock& points_in_a) noexcept {
    points_in_a.count = count;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 p = a_from_b * points_in_b[i];
        points_in_a.x[i] = p.x;
        points_in_a.y[i] = p.y;
        points_in_a.z[i] = p.z;
    }
}

void shift(const PointBlock& points, Vec3 by, PointBlock& shifted) noexcept {
    shifted.count = points.count;
    for (std::size_t i = 0; i < points.count; ++i) {
        shifted.x[i] = points.x[i] + by.x;
        shifted.y[i] = points.y[i] + by.y;
        shifted.z[i] = points.z[i] + by.z;
    }
}

void clamp(const PointBlock& points, Vec3 low, Vec3 high, PointBlock& clamped) noexcept {
    const auto kept = [](double v, double from, double to) { return v < from ? from : (to < v ? to : v); };
    clamped.count = points.count;
    for (std::size_t i = 0; i < points.count; ++i) {
        clamped.x[i] = kept(points.x[i], low.x, high.x);
        clamped.y[i] = kept(points.y[i], low.y, high.y);
        clamped.z[i] = kept(points.z[i], low.z, high.z);
    }
}

void locate(const Grid& grid, const PointBlock& points, PlaceBlock& places) noexcept {
    const double nx = grid.samples(0), ny = grid.samples(1), nz = grid.samples(2);
    const std::int32_t row = grid.bricks[0], column = grid.bricks[1];
    const std::size_t count = points.count;
    places.count = count;
    for (std::size_t n = 0; n < count; ++n) {
        const double gx = (points.x[n] - grid.origin.x) / grid.spacing;
        const double gy = (points.y[n] - grid.origin.y) / grid.spacing;
        const double gz = (points.z[n] - grid.origin.z) / grid.spacing;
        // Written so that NaN is outside; `&` because a jump would stop the others.
        const bool is_inside = (gx >= 0.0) & (gy >= 0.0) & (gz >= 0.0) & (gx < nx) & (gy < ny) & (gz < nz);
        const double x = is_inside ? gx : 0.0, y = is_inside ? gy : 0.0, z = is_inside ? gz : 0.0;
        const auto i = static_cast<std::int32_t>(x), j = static_cast<std::int32_t>(y), k = static_cast<std::int32_t>(z);
        const std::int32_t brick = (k / brick_edge * column + j / brick_edge) * row + i / brick_edge;
        places.brick[n] = is_inside ? brick : PlaceBlock::outside;
        places.offset[n] = ((k % brick_edge) * stored_edge + j % brick_edge) * stored_edge + i % brick_edge;
        places.fx[n] = x - i;
        places.fy[n] = y - j;
        places.fz[n] = z - k;
    }
}

template <class Sample>
void CornerBlock<Sample>::interpolate(double quantum, BlockValues& values) const noexcept {
    const auto lerp = [](double a, double b, double t) { return a + (b - a) * t; };
    const auto& c = corner_;
    BlockValues result;
    for (std::size_t i = 0; i < count_; ++i) {
        const double c00 = lerp(c[0][i], c[1][i], fx_[i]), c10 = lerp(c[2][i], c[3][i], fx_[i]);
        const double c01 = lerp(c[4][i], c[5][i], fx_[i]), c11 = lerp(c[6][i], c[7][i], fx_[i]);
        result[i] = quantum * lerp(lerp(c00, c10, fy_[i]), lerp(c01, c11, fy_[i]), fz_[i]);
    }
    for (std::size_t i = 0; i < count_; ++i) values[lane_[i]] = result[i];
}

template class CornerBlock<std::int16_t>;
template class CornerBlock<float>;

}  // namespace kerf
