// SPDX-License-Identifier: Apache-2.0
// The reference implementation, in loops that a compiler can vectorize over points.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/field/grid/kernel/block_kernel.h"
#include "core/field/grid/kernel/outline_kernel.h"
#include "core/field/grid/point_block.h"

namespace kerf {

namespace {

/// Writes the squared distances to the nearest point of the outline or of its flat ends.
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

}  // namespace

void portable::depths(const OutlineShape& outline, std::size_t count, const ConstCoordinates& in_tool,
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

    // The outline's radius at each point's z. From the back, so that the first segment that contains z overrides the
    // others.
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

void portable::tangents(const OutlineShape& outline, std::size_t count, const ConstCoordinates& in_tool,
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

namespace {

inline float smaller(float a, float b) noexcept { return a < b ? a : b; }
inline float larger(float a, float b) noexcept { return a > b ? a : b; }
inline float to_face(const OutlineFace& f, float r, float z) noexcept {
    return f.offset - (f.normal_r * r + f.normal_z * z);
}

/// Returns the squared distance to the nearest point of the outline or of its flat ends.
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
/// Returns an upper bound of the depth. In a convex solid it is the depth below the nearest face's plane, in any other
/// the depth itself.
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
/// Returns the depth, given `depth` from `depth_at_most`. It is less only outside a convex solid, beyond the edges of
/// the nearest face.
float depth_from(const SingleOutline& o, float r, float z, float depth) noexcept {
    if (!o.is_convex || !(depth < 0.0f)) return depth;
    bool is_beside = (o.front_z - z == depth && o.front_radius >= r) || (z - o.back_z == depth && o.back_radius >= r);
    for (std::size_t n = 0; n < o.count; ++n) {
        const OutlineFace& f = o.face[n];
        const float along = ((r - f.radius) * f.along_r + (z - f.z) * f.along_z) * f.inverse_length2;
        is_beside = is_beside || (to_face(f, r, z) == depth && along >= 0.0f && 1.0f >= along);
    }
    return is_beside ? depth : smaller(-std::sqrt(squared_distance(o, r, z)), depth);
}

struct SinglePoint {
    float x, y, z;
};
inline float radius_of(const SingleOutline& o, SinglePoint p) noexcept {
    return o.half_thickness > 0.0f ? std::abs(p.x) : std::sqrt(p.x * p.x + p.y * p.y);
}
/// Returns an upper bound of the depth in a solid of revolution or a prism. `r` is from `radius_of`.
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
/// Rotates a direction from the solid's frame to that of the points. Pre: `f` does not scale.
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

}  // namespace

void portable::deepest(const SingleOutline& outline, const SingleFrame* solid_from_points, std::size_t solids,
                       std::size_t count, const Vec3* points, const Walls& walls) noexcept {
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
            const SinglePoint way = turned_back(frame, inward_direction(outline, p, r));
            walls.depth[i] = depth;
            walls.which[i] = static_cast<std::int32_t>(n);
            walls.x[i] = way.x;
            walls.y[i] = way.y;
            walls.z[i] = way.z;
        }
    }
}

namespace {

/// Returns a depth in quanta: rounded to the nearest, ties to even, and clamped to ± 32767.
std::int32_t quantised(float depth, float per_quantum) noexcept {
    return static_cast<std::int32_t>(std::lrint(larger(smaller(depth * per_quantum, 32767.0f), -32767.0f)));
}

}  // namespace

bool portable::raise(const SingleOutline& outline, const SampleCell& cell, float band, float per_quantum,
                     std::int16_t* samples, std::int16_t& lowest, std::int16_t& highest, std::int16_t* spare) noexcept {
    const auto& at = cell.along;
    bool is_raised = false;
    std::int32_t least = 32767, most = -32767, min_spare = 32767;
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
                least = std::min<std::int32_t>(least, sample);
                most = std::max<std::int32_t>(most, sample);
            }
    if (spare != nullptr)
        *spare = is_raised ? std::int16_t{0} : static_cast<std::int16_t>(std::clamp(min_spare, 0, 32767));
    if (!is_raised) return false;
    lowest = static_cast<std::int16_t>(least);
    highest = static_cast<std::int16_t>(most);
    return true;
}

void portable::find(const std::int16_t* samples, std::int16_t low, std::int16_t high,
                    std::uint32_t (&found)[3]) noexcept {
    for (int layer = 0; layer < 3; ++layer) {
        found[layer] = 0;
        for (int n = 0; n < 3 * stored_edge; ++n) {
            const std::int16_t v = samples[layer * stored_edge * stored_edge + n];
            found[layer] |= static_cast<std::uint32_t>(v >= low && v <= high) << n;
        }
    }
}

}  // namespace kerf
