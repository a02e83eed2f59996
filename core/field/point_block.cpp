// SPDX-License-Identifier: Apache-2.0
#include "core/field/point_block.h"

namespace kerf {

void transform(const Pose& a_from_b, const Vec3* points_in_b, std::size_t count, PointBlock& points_in_a) noexcept {
    PointBlock points;
    points.count = count;
    for (std::size_t i = 0; i < count; ++i) {
        points.x[i] = points_in_b[i].x;
        points.y[i] = points_in_b[i].y;
        points.z[i] = points_in_b[i].z;
    }
    transform(a_from_b, points, points_in_a);
}

void transform(const Pose& a_from_b, const PointBlock& points_in_b, PointBlock& points_in_a) noexcept {
    points_in_a.count = points_in_b.count;
    block_kernel().transform(a_from_b, points_in_b.count, points_in_b.coordinates(), points_in_a.writable());
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
    const LatticeShape shape{{grid.origin.x, grid.origin.y, grid.origin.z},
                             grid.spacing,
                             {static_cast<double>(grid.samples(0)), static_cast<double>(grid.samples(1)),
                              static_cast<double>(grid.samples(2))},
                             grid.bricks[0],
                             grid.bricks[1]};
    places.count = points.count;
    block_kernel().locate(
        shape, points.count, points.coordinates(),
        {places.brick.data(), places.offset.data(), {places.fx.data(), places.fy.data(), places.fz.data()}});
}

namespace {
void trilinear(const std::int16_t* const* corner, std::size_t count, ConstCoordinates fraction, double quantum,
               BlockValues& values) noexcept {
    block_kernel().trilinear_int16(corner, count, fraction, quantum, values.data());
}
void trilinear(const float* const* corner, std::size_t count, ConstCoordinates fraction, double quantum,
               BlockValues& values) noexcept {
    block_kernel().trilinear_float(corner, count, fraction, quantum, values.data());
}
}  // namespace

template <class Sample>
void CornerBlock<Sample>::interpolate(double quantum, BlockValues& values) const noexcept {
    if (count_ == 0) return;
    if (count_ == places_->count) {  // nobody left out: nothing to gather
        trilinear(corner_.data(), count_, {places_->fx.data(), places_->fy.data(), places_->fz.data()}, quantum, values);
        return;
    }
    BlockValues fx, fy, fz, result;
    for (std::size_t i = 0; i < count_; ++i) {
        fx[i] = places_->fx[lane_[i]];
        fy[i] = places_->fy[lane_[i]];
        fz[i] = places_->fz[lane_[i]];
    }
    trilinear(corner_.data(), count_, {fx.data(), fy.data(), fz.data()}, quantum, result);
    for (std::size_t i = 0; i < count_; ++i) values[lane_[i]] = result[i];
}

template <>
void CornerBlock<std::int16_t>::interpolate(double quantum, SlopeBlock& slopes) const noexcept {
    if (count_ == 0) return;
    const auto differentiate = [&](ConstCoordinates fraction, SlopeBlock& to) {
        block_kernel().gradient_int16(corner_.data(), count_, fraction, quantum, to.value.data(),
                                      {to.x.data(), to.y.data(), to.z.data()});
    };
    if (count_ == places_->count) {
        differentiate({places_->fx.data(), places_->fy.data(), places_->fz.data()}, slopes);
        return;
    }
    BlockValues fx, fy, fz;
    SlopeBlock result;
    for (std::size_t i = 0; i < count_; ++i) {
        fx[i] = places_->fx[lane_[i]];
        fy[i] = places_->fy[lane_[i]];
        fz[i] = places_->fz[lane_[i]];
    }
    differentiate({fx.data(), fy.data(), fz.data()}, result);
    for (std::size_t i = 0; i < count_; ++i) {
        slopes.value[lane_[i]] = result.value[i];
        slopes.x[lane_[i]] = result.x[i];
        slopes.y[lane_[i]] = result.y[i];
        slopes.z[lane_[i]] = result.z[i];
    }
}

template class CornerBlock<std::int16_t>;
template class CornerBlock<float>;

}  // namespace kerf
