// SPDX-License-Identifier: Apache-2.0
// The reference implementation, stage by stage, in loops that a compiler can vectorize over points.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/field/grid/kernel/block_kernel.h"
#include "core/field/grid/kernel/outline_kernel.h"
#include "core/field/grid/kernel/surface_kernel.h"
#include "core/field/grid/point_block.h"

namespace kerf {

namespace {

void transform(const Pose& a_from_b, std::size_t count, const ConstCoordinates& in_b,
               const Coordinates& in_a) noexcept {
    const Pose pose = a_from_b;
    const double* __restrict x = in_b.x, * __restrict y = in_b.y, * __restrict z = in_b.z;
    double* __restrict to_x = in_a.x, * __restrict to_y = in_a.y, * __restrict to_z = in_a.z;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 p = pose * Vec3{x[i], y[i], z[i]};
        to_x[i] = p.x;
        to_y[i] = p.y;
        to_z[i] = p.z;
    }
}

void move(const Frame& a_from_b, std::size_t count, const Vec3* in_b, const Coordinates& in_a) noexcept {
    const Frame frame = a_from_b;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 p = frame * in_b[i];
        in_a.x[i] = p.x;
        in_a.y[i] = p.y;
        in_a.z[i] = p.z;
    }
}

void place(const Frame& fixed_from_points, const Lattice& grid, std::size_t count, const Vec3* points,
           const LocatedArrays& places, PointBox* box) noexcept {
    const Frame frame = fixed_from_points;
    const double one = static_cast<double>(std::int64_t{1} << grid.bits);
    const auto kept = [](double v, double from, double to) { return v < from ? from : (to < v ? to : v); };
    const std::int32_t behind = (1 << grid.bits) - 1;
    const float unit = static_cast<float>(1.0 / one);
    for (std::size_t n = 0; n < count; ++n) {
        Vec3 g = frame * points[n];
        if (grid.is_bounded) {
            g = {kept(g.x, grid.low[0], grid.high[0]), kept(g.y, grid.low[1], grid.high[1]),
                 kept(g.z, grid.low[2], grid.high[2])};
        }
        // NaN compares false: outside.
        const bool is_inside = (g.x > -1.0) & (g.y > -1.0) & (g.z > -1.0) & (g.x < grid.end[0]) & (g.y < grid.end[1]) &
                               (g.z < grid.end[2]);
        const auto x = static_cast<std::int32_t>(is_inside ? g.x : 0.0),
                   y = static_cast<std::int32_t>(is_inside ? g.y : 0.0),
                   z = static_cast<std::int32_t>(is_inside ? g.z : 0.0);
        const std::int32_t i = x >> grid.bits, j = y >> grid.bits, k = z >> grid.bits;
        const std::int32_t brick = k / brick_edge * grid.layer + j / brick_edge * grid.row + i / brick_edge;
        places.brick[n] = is_inside ? brick : grid.brick_count;
        places.offset[n] = ((k % brick_edge) * stored_edge + j % brick_edge) * stored_edge + i % brick_edge;
        places.x[n] = static_cast<float>(x & behind) * unit;
        places.y[n] = static_cast<float>(y & behind) * unit;
        places.z[n] = static_cast<float>(z & behind) * unit;
    }
    if (box == nullptr) return;
    constexpr double far = std::numeric_limits<double>::infinity();
    *box = {{far, far, far}, {-far, -far, -far}};
    for (std::size_t n = 0; n < count; ++n) {
        const double p[3] = {points[n].x, points[n].y, points[n].z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box->low[axis] = p[axis] < box->low[axis] ? p[axis] : box->low[axis];
            box->high[axis] = p[axis] > box->high[axis] ? p[axis] : box->high[axis];
        }
    }
}

/// The samples at the eight corners of each point's cell, x fastest.
class Corners {
public:
    /// `first(i)` returns the low corner of point i.
    template <class First>
    Corners(std::size_t count, const First& first) noexcept {
        constexpr int y = stored_edge, z = stored_edge * stored_edge;
        for (std::size_t i = 0; i < count; ++i) {
            const auto* v = first(i);
            at_[0][i] = static_cast<float>(v[0]);
            at_[1][i] = static_cast<float>(v[1]);
            at_[2][i] = static_cast<float>(v[y]);
            at_[3][i] = static_cast<float>(v[y + 1]);
            at_[4][i] = static_cast<float>(v[z]);
            at_[5][i] = static_cast<float>(v[z + 1]);
            at_[6][i] = static_cast<float>(v[z + y]);
            at_[7][i] = static_cast<float>(v[z + y + 1]);
        }
    }
    const FloatBlock& operator[](std::size_t n) const noexcept { return at_[n]; }

private:
    std::array<FloatBlock, 8> at_;
};
Corners corners_in(const FieldShape& field, std::size_t count, const ConstLocatedArrays& places) noexcept {
    return Corners(count,
                   [&](std::size_t i) { return field.samples + field.start[places.brick[i]] + places.offset[i]; });
}

/// In bricks without samples, the corners come from the first stored brick.
Corners corners_in(const std::int32_t* start, const float* samples, std::size_t count,
                   const ConstLocatedArrays& places) noexcept {
    return Corners(count,
                   [&](std::size_t i) { return samples + std::max(start[places.brick[i]], 0) + places.offset[i]; });
}

inline float lerp(float a, float b, float t) noexcept { return a + (b - a) * t; }

void interpolate(const Corners& c, std::size_t count, const ConstLocatedArrays& places,
                 float* __restrict values) noexcept {
    const float* __restrict fx = places.x, * __restrict fy = places.y, * __restrict fz = places.z;
    for (std::size_t i = 0; i < count; ++i) {
        const float c00 = lerp(c[0][i], c[1][i], fx[i]), c10 = lerp(c[2][i], c[3][i], fx[i]);
        const float c01 = lerp(c[4][i], c[5][i], fx[i]), c11 = lerp(c[6][i], c[7][i], fx[i]);
        values[i] = lerp(lerp(c00, c10, fy[i]), lerp(c01, c11, fy[i]), fz[i]);
    }
}

void values(const FieldShape& field, std::size_t count, const ConstLocatedArrays& places, float* values) noexcept {
    interpolate(corners_in(field, count, places), count, places, values);
}

/// Converts [quanta] to [m]; exact at both ends of the range.
inline double metres_of(float value, double quantum, double clamp) noexcept {
    return value >= 32767.0f ? clamp : (value <= -32767.0f ? -clamp : quantum * static_cast<double>(value));
}

void metres(const FieldShape& field, std::size_t count, const ConstLocatedArrays& places, double quantum, double clamp,
            double* __restrict values) noexcept {
    FloatBlock quanta;
    kerf::portable_kernel().values(field, count, places, quanta.data());
    for (std::size_t i = 0; i < count; ++i) values[i] = metres_of(quanta[i], quantum, clamp);
}

void densities(const std::int32_t* start, const float* samples, std::size_t count, const ConstLocatedArrays& places,
               float elsewhere, float* values) noexcept {
    interpolate(corners_in(start, samples, count, places), count, places, values);
    for (std::size_t i = 0; i < count; ++i) values[i] = start[places.brick[i]] < 0 ? elsewhere : values[i];
}

void slopes_of(const FieldShape& field, std::size_t count, const ConstLocatedArrays& places,
               SlopeBlock& slopes) noexcept {
    const Corners c = corners_in(field, count, places);
    const float* __restrict fx = places.x, * __restrict fy = places.y, * __restrict fz = places.z;
    for (std::size_t i = 0; i < count; ++i) {
        const float x00 = c[1][i] - c[0][i], x10 = c[3][i] - c[2][i];
        const float x01 = c[5][i] - c[4][i], x11 = c[7][i] - c[6][i];
        const float c00 = c[0][i] + x00 * fx[i], c10 = c[2][i] + x10 * fx[i];
        const float c01 = c[4][i] + x01 * fx[i], c11 = c[6][i] + x11 * fx[i];
        const float y0 = c10 - c00, y1 = c11 - c01;
        const float c0 = c00 + y0 * fy[i], c1 = c01 + y1 * fy[i];
        slopes.x[i] = lerp(lerp(x00, x10, fy[i]), lerp(x01, x11, fy[i]), fz[i]);
        slopes.y[i] = lerp(y0, y1, fz[i]);
        slopes.z[i] = c1 - c0;
        slopes.value[i] = c0 + (c1 - c0) * fz[i];
    }
}

float slopes(const FieldShape& bone, const FieldShape& cut, std::size_t count, const ConstLocatedArrays& places,
             const Slopes& larger) noexcept {
    SlopeBlock a, b;
    slopes_of(bone, count, places, a);
    slopes_of(cut, count, places, b);
    float minimum = 32767.0f;
    for (std::size_t i = 0; i < count; ++i) {
        const bool is_cut = a.value[i] < b.value[i];
        larger.value[i] = is_cut ? b.value[i] : a.value[i];
        larger.x[i] = is_cut ? b.x[i] : a.x[i];
        larger.y[i] = is_cut ? b.y[i] : a.y[i];
        larger.z[i] = is_cut ? b.z[i] : a.z[i];
        minimum = larger.value[i] < minimum ? larger.value[i] : minimum;
    }
    return minimum;
}

void answer(const Surface& surface, std::size_t count, const ConstSlopes& slopes,
            kerf_surface_point* answers) noexcept {
    const auto& in_tool = surface.in_tool;
    for (std::size_t i = 0; i < count; ++i) {
        const float v = slopes.value[i], x = slopes.x[i], y = slopes.y[i], z = slopes.z[i];
        const float length = std::sqrt((x * x + y * y) + z * z), per_length = length > 0.0f ? 1.0f / length : 0.0f;
        const bool is_near = v < 32767.0f && v > -32767.0f;
        const float to_unit = is_near ? per_length : 0.0f;
        const float nx = x * to_unit, ny = y * to_unit, nz = z * to_unit;
        kerf_surface_point& a = answers[i];
        a.distance = metres_of(v, surface.quantum, surface.clamp);
        a.normal = {static_cast<double>((in_tool[0][0] * nx + in_tool[1][0] * ny) + in_tool[2][0] * nz),
                    static_cast<double>((in_tool[0][1] * nx + in_tool[1][1] * ny) + in_tool[2][1] * nz),
                    static_cast<double>((in_tool[0][2] * nx + in_tool[1][2] * ny) + in_tool[2][2] * nz)};
        a.body = is_near ? 0 : -1;
        a.reserved = 0;
    }
}

void rows(const SampleColumns& columns, std::size_t count, kerf_bone_sample* samples) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        kerf_bone_sample& s = samples[i];
        s.engagement = static_cast<double>(columns.engagement[i]);
        s.gap = columns.gap[i];
        for (std::size_t m = 0; m < KERF_MAX_TISSUES; ++m) {
            s.weight[m] = m < columns.tissues ? static_cast<double>(columns.weight[m * columns.stride + i]) : 0.0;
            s.density[m] = m < columns.tissues ? static_cast<double>(columns.density[m * columns.stride + i]) : 0.0;
        }
        s.body = columns.body;
        s.reserved = 0;
    }
}

constexpr BlockKernel table{
    .name = "portable",
    .transform = transform,
    .move = move,
    .place = place,
    .values = values,
    .metres = metres,
    .densities = densities,
    .slopes = slopes,
    .answer = answer,
    .rows = rows,
    .depths = portable::depths,
    .tangents = portable::tangents,
    .deepest = portable::deepest,
    .raise = portable::raise,
    .find = portable::find,
    .larger_rows = portable::larger_rows,
    .larger_border = portable::larger_border,
    .crossings = portable::crossings,
};

}  // namespace

const BlockKernel& portable_kernel() noexcept { return table; }

}  // namespace kerf
