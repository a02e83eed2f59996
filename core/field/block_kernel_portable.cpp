// SPDX-License-Identifier: Apache-2.0
// The reference: stage by stage, in loops that a compiler takes for several points at a time.
#include <cmath>

#include "core/field/block_kernel.h"
#include "core/field/point_block.h"

namespace kerf {

namespace {

void transform(const Pose &a_from_b, std::size_t count, ConstCoordinates in_b, Coordinates in_a) noexcept {
    const Pose pose = a_from_b;
    const double *__restrict x = in_b.x, *__restrict y = in_b.y, *__restrict z = in_b.z;
    double *__restrict to_x = in_a.x, *__restrict to_y = in_a.y, *__restrict to_z = in_a.z;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 p = pose * Vec3{x[i], y[i], z[i]};
        to_x[i] = p.x;
        to_y[i] = p.y;
        to_z[i] = p.z;
    }
}

void locate(const LatticeShape &shape, std::size_t count, ConstCoordinates points, Places places) noexcept {
    const LatticeShape grid = shape;
    const double *__restrict px = points.x, *__restrict py = points.y, *__restrict pz = points.z;
    std::int32_t *__restrict bricks = places.brick, *__restrict offsets = places.offset;
    double *__restrict fx = places.fraction.x, *__restrict fy = places.fraction.y, *__restrict fz = places.fraction.z;
    const double per_metre = 1.0 / grid.spacing;
    const double nx = grid.samples[0], ny = grid.samples[1], nz = grid.samples[2];
    for (std::size_t n = 0; n < count; ++n) {
        const double gx = (px[n] - grid.origin[0]) * per_metre;
        const double gy = (py[n] - grid.origin[1]) * per_metre;
        const double gz = (pz[n] - grid.origin[2]) * per_metre;
        // Written so that NaN is outside; `&` because a jump would stop the others.
        const bool is_inside = (gx >= 0.0) & (gy >= 0.0) & (gz >= 0.0) & (gx < nx) & (gy < ny) & (gz < nz);
        const double x = is_inside ? gx : 0.0, y = is_inside ? gy : 0.0, z = is_inside ? gz : 0.0;
        const auto i = static_cast<std::int32_t>(x), j = static_cast<std::int32_t>(y), k = static_cast<std::int32_t>(z);
        const std::int32_t brick = (k / brick_edge * grid.column + j / brick_edge) * grid.row + i / brick_edge;
        bricks[n] = is_inside ? brick : PlaceBlock::outside;
        offsets[n] = ((k % brick_edge) * stored_edge + j % brick_edge) * stored_edge + i % brick_edge;
        fx[n] = x - i;
        fy[n] = y - j;
        fz[n] = z - k;
    }
}

/// The samples at the eight corners of each point's cell, x fastest.
template <class Sample, class Value>
void gather(const Sample* const* corner, std::size_t count, std::array<std::array<Value, block_capacity>, 8>& c) noexcept {
    constexpr int y = stored_edge, z = stored_edge * stored_edge;
    for (std::size_t i = 0; i < count; ++i) {
        const Sample* v = corner[i];
        c[0][i] = v[0];
        c[1][i] = v[1];
        c[2][i] = v[y];
        c[3][i] = v[y + 1];
        c[4][i] = v[z];
        c[5][i] = v[z + 1];
        c[6][i] = v[z + y];
        c[7][i] = v[z + y + 1];
    }
}

template <class Sample>
void interpolate(const Sample *const *corner, std::size_t count, ConstCoordinates fraction, double quantum,
                 double *values) noexcept {
    std::array<std::array<Sample, block_capacity>, 8> c;
    gather(corner, count, c);
    const auto lerp = [](double a, double b, double t) { return a + (b - a) * t; };
    const double *__restrict fx = fraction.x, *__restrict fy = fraction.y, *__restrict fz = fraction.z;
    double *__restrict to = values;
    for (std::size_t i = 0; i < count; ++i) {
        const double c00 = lerp(c[0][i], c[1][i], fx[i]), c10 = lerp(c[2][i], c[3][i], fx[i]);
        const double c01 = lerp(c[4][i], c[5][i], fx[i]), c11 = lerp(c[6][i], c[7][i], fx[i]);
        to[i] = quantum * lerp(lerp(c00, c10, fy[i]), lerp(c01, c11, fy[i]), fz[i]);
    }
}

void gradient(const std::int16_t* const* corner, std::size_t count, ConstCoordinates fraction, double quantum,
              double* values, Coordinates gradient) noexcept {
    std::array<std::array<double, block_capacity>, 8> c;
    gather(corner, count, c);
    const auto lerp = [](double a, double b, double t) { return a + (b - a) * t; };
    const double *__restrict fx = fraction.x, *__restrict fy = fraction.y, *__restrict fz = fraction.z;
    double *__restrict to = values, *__restrict gx = gradient.x, *__restrict gy = gradient.y, *__restrict gz = gradient.z;
    for (std::size_t i = 0; i < count; ++i) {
        const double x00 = c[1][i] - c[0][i], x10 = c[3][i] - c[2][i];
        const double x01 = c[5][i] - c[4][i], x11 = c[7][i] - c[6][i];
        const double c00 = c[0][i] + x00 * fx[i], c10 = c[2][i] + x10 * fx[i];
        const double c01 = c[4][i] + x01 * fx[i], c11 = c[6][i] + x11 * fx[i];
        const double y0 = c10 - c00, y1 = c11 - c01;
        const double c0 = c00 + y0 * fy[i], c1 = c01 + y1 * fy[i];
        gx[i] = lerp(lerp(x00, x10, fy[i]), lerp(x01, x11, fy[i]), fz[i]);
        gy[i] = lerp(y0, y1, fz[i]);
        gz[i] = c1 - c0;
        to[i] = quantum * (c0 + (c1 - c0) * fz[i]);
    }
}

void unit(const Quat& a_from_b, std::size_t count, ConstCoordinates in_b, Coordinates in_a) noexcept {
    const Quat q = a_from_b;
    const double *__restrict x = in_b.x, *__restrict y = in_b.y, *__restrict z = in_b.z;
    double *__restrict to_x = in_a.x, *__restrict to_y = in_a.y, *__restrict to_z = in_a.z;
    for (std::size_t i = 0; i < count; ++i) {
        const double l = std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
        const double nx = x[i] / l, ny = y[i] / l, nz = z[i] / l;
        const bool has_length = l > 0.0;
        const Vec3 n = rotate(q, {has_length ? nx : 0.0, has_length ? ny : 0.0, has_length ? nz : 0.0});
        to_x[i] = n.x;
        to_y[i] = n.y;
        to_z[i] = n.z;
    }
}

/// To the nearest point of the outline.
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
    const auto add_cap = [&](const kerf_profile_point &rim) {
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

/// A convex solid's: see RevolutionSolid::distance.
void convex_depths(const OutlineShape& outline, std::size_t count, const BlockValues& r, const double* __restrict z,
                   double* __restrict depths) noexcept {
    const auto front = outline.point[0], back = outline.point[outline.count - 1];
    for (std::size_t i = 0; i < count; ++i)
        depths[i] = z[i] - back.z < front.z - z[i] ? z[i] - back.z : front.z - z[i];
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

    BlockValues nearest2, is_beside;
    for (std::size_t i = 0; i < count; ++i) {
        const bool before = (front.z - z[i] == depths[i]) & (r[i] <= front.radius);
        const bool behind = (z[i] - back.z == depths[i]) & (r[i] <= back.radius);
        is_beside[i] = before | behind | !(depths[i] < 0.0) ? 1.0 : 0.0;
    }
    for (std::size_t n = 0; n + 1 < outline.count; ++n) {
        const auto a = outline.point[n];
        const OutlineSegment s = outline.segment[n];
        for (std::size_t i = 0; i < count; ++i) {
            const double to_face = s.offset - (s.normal_r * r[i] + s.normal_z * z[i]);
            const double along = ((r[i] - a.radius) * s.along_r + (z[i] - a.z) * s.along_z) * s.inverse_length2;
            is_beside[i] = (to_face == depths[i]) & (along >= 0.0) & (along <= 1.0) ? 1.0 : is_beside[i];
        }
    }
    squared_distances(outline, count, r, z, nearest2);
    for (std::size_t i = 0; i < count; ++i) {
        const double distance = std::sqrt(nearest2[i]);
        depths[i] = is_beside[i] > 0.0 ? depths[i] : -distance;
    }
}

void depths(const OutlineShape &outline, std::size_t count, ConstCoordinates in_tool,
            double *__restrict depths) noexcept {
    BlockValues r{}, nearest2, wall;
    const double *__restrict x = in_tool.x, *__restrict y = in_tool.y, *__restrict z = in_tool.z;
    const auto front = outline.point[0], back = outline.point[outline.count - 1];
    for (std::size_t i = 0; i < count; ++i) {
        r[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
        wall[i] = back.radius;
    }
    if (outline.is_convex) return convex_depths(outline, count, r, z, depths);
    squared_distances(outline, count, r, z, nearest2);

    // The outline's radius where the point stands, from the back so that the first segment that holds it stays.
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
}

void tangents(const OutlineShape& outline, std::size_t count, ConstCoordinates in_tool, double* __restrict depths,
              Coordinates gradients) noexcept {
    const auto front = outline.point[0], back = outline.point[outline.count - 1];
    const double *__restrict x = in_tool.x, *__restrict y = in_tool.y, *__restrict z = in_tool.z;
    double *__restrict gx = gradients.x, *__restrict gy = gradients.y, *__restrict gz = gradients.z;
    BlockValues r, normal_r;
    for (std::size_t i = 0; i < count; ++i) {
        r[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
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
    for (std::size_t i = 0; i < count; ++i) {  // towards the axis; on it any way will do
        const double inwards = -normal_r[i] / r[i];
        const bool is_off_axis = r[i] > 0.0;
        gx[i] = is_off_axis ? inwards * x[i] : normal_r[i];
        gy[i] = is_off_axis ? inwards * y[i] : 0.0;
    }
}

bool raise(const OutlineShape& outline, const SampleCell& cell, double band, double quantum, std::int16_t* samples,
           std::int16_t& lowest, std::int16_t& highest) noexcept {
    constexpr std::size_t rows = 9;
    const auto first = static_cast<std::size_t>(cell.first_x), width = static_cast<std::size_t>(cell.last_x) - first + 1;
    BlockValues x, y, z, depth;
    std::array<std::int16_t, block_capacity> value;
    const auto place = [&](std::size_t row) { return row / 3 * 9 + static_cast<std::size_t>(cell.first_y) + row % 3; };
    std::size_t count = 0;
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t n = first; n < first + width; ++n, ++count) {
            x[count] = cell.row.x[place(row)] + cell.along.x[n];
            y[count] = cell.row.y[place(row)] + cell.along.y[n];
            z[count] = cell.row.z[place(row)] + cell.along.z[n];
            value[count] = samples[place(row) * stored_edge + n];
        }
    depths(outline, count, {x.data(), y.data(), z.data()}, depth.data());
    // Without jumps: quanta kept within their range and rounded, half away from zero.
    const double per_quantum = 1.0 / quantum;
    int raised = 0;
    std::int16_t least = 32767, most = -32767;
    for (std::size_t i = 0; i < count; ++i) {
        const double q = depth[i] * per_quantum;
        const double kept = q >= 32767.0 ? 32767.0 : (q <= -32767.0 ? -32767.0 : q);
        const auto rounded = static_cast<std::int32_t>(kept + (q >= 0.0 ? 0.5 : -0.5));
        const auto cut = static_cast<std::int16_t>(-depth[i] > band ? -32767 : rounded);
        raised |= cut > value[i];
        value[i] = cut > value[i] ? cut : value[i];
        least = value[i] < least ? value[i] : least;
        most = value[i] > most ? value[i] : most;
    }
    lowest = least;
    highest = most;
    if (raised == 0) return false;
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t n = 0; n < width; ++n) samples[place(row) * stored_edge + first + n] = value[row * width + n];
    return true;
}

constexpr BlockKernel table{
    .name = "portable",
    .transform = transform,
    .locate = locate,
    .trilinear_int16 = interpolate<std::int16_t>,
    .trilinear_float = interpolate<float>,
    .gradient_int16 = gradient,
    .unit = unit,
    .depths = depths,
    .tangents = tangents,
    .raise = raise,
};

}  // namespace

const BlockKernel &portable_kernel() noexcept { return table; }

}  // namespace kerf
