// SPDX-License-Identifier: Apache-2.0
// The reference implementation, stage by stage, in loops that a compiler can vectorize over points.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/field/grid/kernel/block_kernel.h"
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

/// Writes the squared distances to the nearest point of the outline.
void squared_distances(const OutlineShape& outline, std::size_t count, const BlockValues& r, const double* __restrict z,
                       BlockValues& nearest2) noexcept {
    const auto front = outline.point[0], back = outline.point[outline.count - 1];
    for (std::size_t i = 0; i < count; ++i) nearest2[i] = 1e300;
    for (std::size_t n = 0; n + 1 < outline.count; ++n) {
        const auto a = outline.point[n];
        const OutlineSegment s = outline.segment[n];
        for (std::size_t i = 0; i < count; ++i) {
            const double dr = r[i] - a.radius, dz = z[i] - a.z;
            const double along = (dr * s.along_r + dz * s.along_z) * s.inverse_length2;
            const double t = along < 0.0 ? 0.0 : (1.0 < along ? 1.0 : along);
            const double off_r = dr - t * s.along_r, off_z = dz - t * s.along_z;
            const double d2 = off_r * off_r + off_z * off_z;
            nearest2[i] = d2 < nearest2[i] ? d2 : nearest2[i];
        }
    }
    const auto add_cap = [&](const kerf_profile_point& rim) {
        for (std::size_t i = 0; i < count; ++i) {
            const double beside = r[i] - rim.radius, dz = z[i] - rim.z;
            const double dr = 0.0 < beside ? beside : 0.0;
            const double d2 = dr * dr + dz * dz;
            nearest2[i] = d2 < nearest2[i] ? d2 : nearest2[i];
        }
    };
    if (front.radius > 0.0) add_cap(front);
    add_cap(back);
}

/// Writes the depths in a convex solid: see ToolSolid::distance.
void convex_depths(const OutlineShape& outline, std::size_t count, const BlockValues& r, const double* __restrict z,
                   double* __restrict depths) noexcept {
    const auto front = outline.point[0], back = outline.point[outline.count - 1];
    for (std::size_t i = 0; i < count; ++i) depths[i] = z[i] - back.z < front.z - z[i] ? z[i] - back.z : front.z - z[i];
    for (std::size_t n = 0; n + 1 < outline.count; ++n) {
        const OutlineSegment s = outline.segment[n];
        for (std::size_t i = 0; i < count; ++i) {
            const double to_face = s.offset - (s.normal_r * r[i] + s.normal_z * z[i]);
            depths[i] = to_face < depths[i] ? to_face : depths[i];
        }
    }
    int outside = 0;
    for (std::size_t i = 0; i < count; ++i) outside |= depths[i] < 0.0;
    if (outside == 0) return;

    BlockValues nearest2, is_next_to_face;
    for (std::size_t i = 0; i < count; ++i) {
        const bool before = (front.z - z[i] == depths[i]) & (r[i] <= front.radius);
        const bool behind = (z[i] - back.z == depths[i]) & (r[i] <= back.radius);
        is_next_to_face[i] = before | behind | !(depths[i] < 0.0) ? 1.0 : 0.0;
    }
    for (std::size_t n = 0; n + 1 < outline.count; ++n) {
        const auto a = outline.point[n];
        const OutlineSegment s = outline.segment[n];
        for (std::size_t i = 0; i < count; ++i) {
            const double to_face = s.offset - (s.normal_r * r[i] + s.normal_z * z[i]);
            const double along = ((r[i] - a.radius) * s.along_r + (z[i] - a.z) * s.along_z) * s.inverse_length2;
            is_next_to_face[i] = (to_face == depths[i]) & (along >= 0.0) & (along <= 1.0) ? 1.0 : is_next_to_face[i];
        }
    }
    squared_distances(outline, count, r, z, nearest2);
    for (std::size_t i = 0; i < count; ++i) {
        const double distance = std::sqrt(nearest2[i]);
        depths[i] = is_next_to_face[i] > 0.0 ? depths[i] : -distance;
    }
}

/// Writes the depths in a prism: the depth in the plane of its outline, limited by two flat sides.
void prism_depths(const OutlineShape& outline, std::size_t count, const ConstCoordinates& in_tool,
                  double* __restrict depths) noexcept {
    BlockValues r{};
    const double* __restrict x = in_tool.x, * __restrict y = in_tool.y;
    for (std::size_t i = 0; i < count; ++i) r[i] = std::abs(x[i]);
    convex_depths(outline, count, r, in_tool.z, depths);
    for (std::size_t i = 0; i < count; ++i) {
        const double side = std::abs(y[i]) - outline.half_thickness, flat = depths[i];
        const double off = 0.0 > flat ? flat : 0.0, beside = side > 0.0 ? side : 0.0,
                     within = flat < -side ? flat : -side;
        depths[i] = (flat < 0.0) | (side > 0.0) ? -std::sqrt(off * off + beside * beside) : within;
    }
}

void depths(const OutlineShape& outline, std::size_t count, const ConstCoordinates& in_tool,
            double* __restrict depths) noexcept {
    if (outline.half_thickness > 0.0) return prism_depths(outline, count, in_tool, depths);
    BlockValues r{}, nearest2, wall;
    const double* __restrict x = in_tool.x, * __restrict y = in_tool.y, * __restrict z = in_tool.z;
    const auto front = outline.point[0], back = outline.point[outline.count - 1];
    for (std::size_t i = 0; i < count; ++i) {
        r[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
        wall[i] = back.radius;
    }
    if (outline.is_convex) return convex_depths(outline, count, r, z, depths);
    squared_distances(outline, count, r, z, nearest2);

    // The outline's radius at the point's z. From the back, so that the first segment that contains it wins.
    for (std::size_t n = outline.count - 1; n > 0; --n) {
        const auto a = outline.point[n - 1], b = outline.point[n];
        if (a.radius == b.radius) {  // a cylinder: nothing to divide
            for (std::size_t i = 0; i < count; ++i) wall[i] = z[i] < b.z ? wall[i] : a.radius;
            continue;
        }
        for (std::size_t i = 0; i < count; ++i) {
            const double radius = a.radius + outline.segment[n - 1].slope * (a.z - z[i]);
            wall[i] = z[i] < b.z ? wall[i] : radius;
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        const double distance = std::sqrt(nearest2[i]);
        const bool is_inside = (z[i] < front.z) & (z[i] > back.z) & (r[i] < wall[i]);
        depths[i] = is_inside ? distance : -distance;
    }
    if (outline.bore > 0.0)
        for (std::size_t i = 0; i < count; ++i) {
            const double to_bore = r[i] - outline.bore;
            depths[i] = to_bore < depths[i] ? to_bore : depths[i];
        }
    for (std::size_t n = 0; n < outline.gaps; ++n)
        for (std::size_t i = 0; i < count; ++i) {
            const double to_gap = std::abs(z[i] - outline.gap[n].middle) - outline.gap[n].half;
            depths[i] = to_gap < depths[i] ? to_gap : depths[i];
        }
}

void tangents(const OutlineShape& outline, std::size_t count, const ConstCoordinates& in_tool,
              double* __restrict depths, const Coordinates& gradients) noexcept {
    const auto front = outline.point[0], back = outline.point[outline.count - 1];
    const double* __restrict x = in_tool.x, * __restrict y = in_tool.y, * __restrict z = in_tool.z;
    double* __restrict gx = gradients.x, * __restrict gy = gradients.y, * __restrict gz = gradients.z;
    const bool is_prism = outline.half_thickness > 0.0;
    BlockValues r, normal_r;
    for (std::size_t i = 0; i < count; ++i) {
        r[i] = is_prism ? std::abs(x[i]) : std::sqrt(x[i] * x[i] + y[i] * y[i]);
        const bool is_before = front.z - z[i] < z[i] - back.z;
        depths[i] = is_before ? front.z - z[i] : z[i] - back.z;
        gz[i] = is_before ? -1.0 : 1.0;
        normal_r[i] = 0.0;
    }
    for (std::size_t n = 0; n + 1 < outline.count; ++n) {
        const OutlineSegment s = outline.segment[n];
        for (std::size_t i = 0; i < count; ++i) {
            const double depth = s.offset - (s.normal_r * r[i] + s.normal_z * z[i]);
            const bool is_less = depth < depths[i];
            depths[i] = is_less ? depth : depths[i];
            normal_r[i] = is_less ? s.normal_r : normal_r[i];
            gz[i] = is_less ? -s.normal_z : gz[i];
        }
    }
    if (is_prism) {
        for (std::size_t i = 0; i < count; ++i) {
            const double to_side = outline.half_thickness - std::abs(y[i]);
            const bool is_side = to_side < depths[i];
            depths[i] = is_side ? to_side : depths[i];
            gx[i] = is_side ? 0.0 : (x[i] < 0.0 ? normal_r[i] : -normal_r[i]);
            gy[i] = is_side ? (y[i] < 0.0 ? 1.0 : -1.0) : 0.0;
            gz[i] = is_side ? 0.0 : gz[i];
        }
        return;
    }
    for (std::size_t i = 0; i < count; ++i) {  // towards the axis; arbitrary on the axis
        const double inwards = -normal_r[i] / r[i];
        const bool is_off_axis = r[i] > 0.0;
        gx[i] = is_off_axis ? inwards * x[i] : normal_r[i];
        gy[i] = is_off_axis ? inwards * y[i] : 0.0;
    }
}

inline float smaller(float a, float b) noexcept { return a < b ? a : b; }
inline float larger(float a, float b) noexcept { return a > b ? a : b; }
inline float to_face(const OutlineFace& f, float r, float z) noexcept {
    return f.offset - (f.normal_r * r + f.normal_z * z);
}

/// Returns the squared distance to the nearest point of the outline.
float squared_distance(const SingleOutline& o, float r, float z) noexcept {
    float nearest2 = 1e30f;
    for (std::size_t n = 0; n < o.count; ++n) {
        const OutlineFace& f = o.face[n];
        const float dr = r - f.radius, dz = z - f.z;
        const float t = smaller(1.0f, larger(0.0f, (dr * f.along_r + dz * f.along_z) * f.inverse_length2));
        const float off_r = dr - t * f.along_r, off_z = dz - t * f.along_z;
        nearest2 = smaller(off_r * off_r + off_z * off_z, nearest2);
    }
    const auto to_cap2 = [&](float radius, float at) {
        const float dr = larger(r - radius, 0.0f), dz = z - at;
        return dr * dr + dz * dz;
    };
    if (o.front_radius > 0.0f) nearest2 = smaller(to_cap2(o.front_radius, o.front_z), nearest2);
    return smaller(to_cap2(o.back_radius, o.back_z), nearest2);
}
/// Returns the depth to the plane of the nearest face in a convex solid; the depth itself in any other.
float depth_at_most(const SingleOutline& o, float r, float z) noexcept {
    if (o.is_convex) {
        float depth = smaller(z - o.back_z, o.front_z - z);
        for (std::size_t n = 0; n < o.count; ++n) depth = smaller(to_face(o.face[n], r, z), depth);
        return depth;
    }
    float wall = o.back_radius;
    for (std::size_t n = o.count; n > 0; --n) {
        const OutlineFace& f = o.face[n - 1];
        wall = z < (n < o.count ? o.face[n].z : o.back_z) ? wall : f.radius + f.slope * (f.z - z);
    }
    const float distance = std::sqrt(squared_distance(o, r, z));
    float depth = z < o.front_z && o.back_z < z && r < wall ? distance : -distance;
    if (o.bore > 0.0f) depth = smaller(r - o.bore, depth);
    for (std::size_t n = 0; n < o.gaps; ++n) depth = smaller(std::abs(z - o.gap[n].middle) - o.gap[n].half, depth);
    return depth;
}
/// Returns the depth, given that plane depth: in a convex solid it is less outside, beyond the edges of the nearest
/// face.
float depth_from(const SingleOutline& o, float r, float z, float depth) noexcept {
    if (!o.is_convex || !(depth < 0.0f)) return depth;
    bool is_next_to_face =
        (o.front_z - z == depth && o.front_radius >= r) || (z - o.back_z == depth && o.back_radius >= r);
    for (std::size_t n = 0; n < o.count; ++n) {
        const OutlineFace& f = o.face[n];
        const float along = ((r - f.radius) * f.along_r + (z - f.z) * f.along_z) * f.inverse_length2;
        is_next_to_face = is_next_to_face || (to_face(f, r, z) == depth && along >= 0.0f && 1.0f >= along);
    }
    return is_next_to_face ? depth : smaller(-std::sqrt(squared_distance(o, r, z)), depth);
}

struct SinglePoint {
    float x, y, z;
};
inline float radius_of(const SingleOutline& o, SinglePoint p) noexcept {
    return o.half_thickness > 0.0f ? std::abs(p.x) : std::sqrt(p.x * p.x + p.y * p.y);
}
/// Returns the bound for a solid of revolution or a prism, with `r` from `radius_of`.
float depth_at_most(const SingleOutline& o, SinglePoint p, float r) noexcept {
    const float flat = depth_at_most(o, r, p.z);
    return o.half_thickness > 0.0f ? smaller(o.half_thickness - std::abs(p.y), flat) : flat;
}
float depth_from(const SingleOutline& o, SinglePoint p, float r, float depth) noexcept {
    if (!(o.half_thickness > 0.0f)) return depth_from(o, r, p.z, depth);
    if (!(depth < 0.0f)) return depth;
    const float flat = depth_from(o, r, p.z, depth_at_most(o, r, p.z));
    const float off = smaller(flat, 0.0f), beside = larger(std::abs(p.y) - o.half_thickness, 0.0f);
    return smaller(-std::sqrt(off * off + beside * beside), depth);
}
SinglePoint moved(const SingleFrame& f, SinglePoint p) noexcept {
    const auto along = [&](int n) {
        return ((f.axis[0][n] * p.x + f.axis[1][n] * p.y) + f.axis[2][n] * p.z) + f.origin[n];
    };
    return {along(0), along(1), along(2)};
}
/// Returns a direction of the solid in the frame of the points. Pre: a rotation.
SinglePoint turned_back(const SingleFrame& f, SinglePoint d) noexcept {
    const auto along = [&](int n) { return (f.axis[n][0] * d.x + f.axis[n][1] * d.y) + f.axis[n][2] * d.z; };
    return {along(0), along(1), along(2)};
}

/// Returns the inward direction at a point inside, in the frame of the solid.
SinglePoint inward_direction(const SingleOutline& o, SinglePoint p, float r) noexcept {
    float depth = smaller(p.z - o.back_z, o.front_z - p.z), in_r = 0.0f,
          in_z = o.front_z - p.z < p.z - o.back_z ? -1.0f : 1.0f;
    for (std::size_t n = 0; n < o.count; ++n) {
        const float here = to_face(o.face[n], r, p.z);
        const bool is_less = here < depth;
        depth = is_less ? here : depth;
        in_r = is_less ? o.face[n].normal_r : in_r;
        in_z = is_less ? -o.face[n].normal_z : in_z;
    }
    if (o.half_thickness > 0.0f) {
        if (o.half_thickness - std::abs(p.y) < depth) return {0.0f, p.y < 0.0f ? 1.0f : -1.0f, 0.0f};
        return {p.x < 0.0f ? in_r : -in_r, 0.0f, in_z};
    }
    if (o.bore > 0.0f && r - o.bore < depth) {  // away from the bore
        depth = r - o.bore;
        in_r = -1.0f;
        in_z = 0.0f;
    }
    for (std::size_t n = 0; n < o.gaps; ++n) {  // away from the gap
        const float off = p.z - o.gap[n].middle, to_gap = std::abs(off) - o.gap[n].half;
        if (!(to_gap < depth)) continue;
        depth = to_gap;
        in_r = 0.0f;
        in_z = off < 0.0f ? -1.0f : 1.0f;
    }
    const float inwards = r > 0.0f ? -in_r / r : 0.0f;
    return {inwards * p.x, inwards * p.y, in_z};
}

void deepest(const SingleOutline& outline, const SingleFrame* solid_from_points, std::size_t solids, std::size_t count,
             const Vec3* points, const Walls& walls) noexcept {
    for (std::size_t n = 0; n < solids; ++n) {
        const SingleFrame& frame = solid_from_points[n];
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 point = points[i];
            const SinglePoint p =
                moved(frame, {static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z)});
            const float r = radius_of(outline, p);
            float depth = depth_at_most(outline, p, r);
            if (!(depth > walls.depth[i])) continue;
            depth = depth_from(outline, p, r, depth);
            if (!(depth > walls.depth[i])) continue;
            const SinglePoint inward = turned_back(frame, inward_direction(outline, p, r));
            walls.depth[i] = depth;
            walls.which[i] = static_cast<std::int32_t>(n);
            walls.x[i] = inward.x;
            walls.y[i] = inward.y;
            walls.z[i] = inward.z;
        }
    }
}

/// Returns the nearest quantum, the even one of two, clamped to ± 32767.
std::int32_t quantised(float depth, float per_quantum) noexcept {
    return static_cast<std::int32_t>(std::lrint(larger(smaller(depth * per_quantum, 32767.0f), -32767.0f)));
}

bool raise(const SingleOutline& outline, const SampleCell& cell, float band, float per_quantum, std::int16_t* samples,
           std::int16_t& lowest, std::int16_t& highest, std::int16_t* spare) noexcept {
    const auto& at = cell.along;
    bool is_raised = false;
    std::int32_t minimum = 32767, maximum = -32767, min_spare = 32767;
    const auto end_of_band = static_cast<std::int32_t>(-band * per_quantum);
    for (int z = 0; z < 3; ++z)
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < stored_edge; ++x) {
                const float i = cell.first[0] + static_cast<float>(x), j = cell.first[1] + static_cast<float>(y),
                            k = cell.first[2] + static_cast<float>(z);
                const auto place = [&](int n) {
                    return ((cell.origin[n] + i * at[0][n]) + j * at[1][n]) + k * at[2][n];
                };
                const SinglePoint p{place(0), place(1), place(2)};
                const float r = radius_of(outline, p);
                std::int16_t& sample = samples[(z * stored_edge + y) * stored_edge + x];
                const float at_most = depth_at_most(outline, p, r);
                if (sample < 32767)
                    min_spare = std::min(min_spare,
                                         std::max<std::int32_t>(sample, end_of_band) - quantised(at_most, per_quantum));
                if (at_most >= -band && quantised(at_most, per_quantum) > sample) {
                    const float depth = depth_from(outline, p, r, at_most);
                    const std::int32_t value = quantised(depth, per_quantum);
                    if (depth >= -band && value > sample) {
                        sample = static_cast<std::int16_t>(value);
                        is_raised = true;
                    }
                }
                minimum = std::min<std::int32_t>(minimum, sample);
                maximum = std::max<std::int32_t>(maximum, sample);
            }
    if (spare != nullptr)
        *spare = is_raised ? std::int16_t{0} : static_cast<std::int16_t>(std::clamp(min_spare, 0, 32767));
    if (!is_raised) return false;
    lowest = static_cast<std::int16_t>(minimum);
    highest = static_cast<std::int16_t>(maximum);
    return true;
}

void find(const std::int16_t* samples, std::int16_t low, std::int16_t high, std::uint32_t (&found)[3]) noexcept {
    for (int layer = 0; layer < 3; ++layer) {
        found[layer] = 0;
        for (int n = 0; n < 3 * stored_edge; ++n) {
            const std::int16_t v = samples[layer * stored_edge * stored_edge + n];
            found[layer] |= static_cast<std::uint32_t>(v >= low && v <= high) << n;
        }
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
    .depths = depths,
    .tangents = tangents,
    .deepest = deepest,
    .raise = raise,
    .find = find,
    .larger_rows = portable::larger_rows,
    .larger_border = portable::larger_border,
    .crossings = portable::crossings,
};

}  // namespace

const BlockKernel& portable_kernel() noexcept { return table; }

}  // namespace kerf
