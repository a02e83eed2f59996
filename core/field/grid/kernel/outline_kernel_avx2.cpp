// SPDX-License-Identifier: Apache-2.0
// Four points at a time, eight in single precision, each with the operations of the portable kernel in the same order.
// Compiled with -mavx2, and called only if the processor has AVX2. Compiled without fused multiply-add, which would
// round differently.
#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#include "core/field/grid/kernel/avx2_lanes.h"
#include "core/field/grid/kernel/block_kernel.h"
#include "core/field/grid/kernel/outline_kernel.h"

namespace kerf {

namespace {

/// Returns the squared distance to the flat disc inside a rim.
inline Four to_cap2(Four r, Four z, const kerf_profile_point& rim) noexcept {
    const Four dr = max_of(r - all(rim.radius), _mm256_setzero_pd()), dz = z - all(rim.z);
    return dr * dr + dz * dz;
}

/// Returns the outline's radius at each z.
inline Four wall_at(const OutlineShape& outline, Four z) noexcept {
    Four wall = all(outline.point[outline.count - 1].radius);
    for (std::size_t n = outline.count - 1; n > 0; --n) {
        const kerf_profile_point &a = outline.point[n - 1], &b = outline.point[n];
        const Four is_behind = less(z, all(b.z));
        const Four radius = all(a.radius) + all(outline.segment[n - 1].slope) * (all(a.z) - z);
        wall = _mm256_blendv_pd(radius, wall, is_behind);
    }
    return wall;
}

/// Returns the squared distance to the nearest point of the outline or of its flat ends.
inline Four squared_distance(const OutlineShape& outline, Four r, Four z) noexcept {
    const kerf_profile_point &front = outline.point[0], &back = outline.point[outline.count - 1];
    Four nearest2 = all(1e300);
    for (std::size_t n = 0; n + 1 < outline.count; ++n) {
        const kerf_profile_point& a = outline.point[n];
        const OutlineSegment& s = outline.segment[n];
        const Four along_r = all(s.along_r), along_z = all(s.along_z);
        const Four dr = r - all(a.radius), dz = z - all(a.z);
        const Four along = (dr * along_r + dz * along_z) * all(s.inverse_length2);
        const Four t = min_of(all(1.0), max_of(_mm256_setzero_pd(), along));
        const Four off_r = dr - t * along_r, off_z = dz - t * along_z;
        nearest2 = min_of(off_r * off_r + off_z * off_z, nearest2);
    }
    if (front.radius > 0.0) nearest2 = min_of(to_cap2(r, z, front), nearest2);
    return min_of(to_cap2(r, z, back), nearest2);
}

inline Four magnitude(Four a) noexcept { return _mm256_andnot_pd(all(-0.0), a); }
inline Four minus(Four a) noexcept { return _mm256_xor_pd(a, all(-0.0)); }

/// Returns `v` where `is_positive`, else −v. Pre: v ≥ 0.
inline Four with_sign(Four v, Four is_positive) noexcept {
    return _mm256_xor_pd(v, _mm256_andnot_pd(is_positive, all(-0.0)));
}

inline Four to_face(const OutlineSegment& s, Four r, Four z) noexcept {
    return all(s.offset) - (all(s.normal_r) * r + all(s.normal_z) * z);
}
/// Returns the depth below the nearest face's plane: in a convex solid an upper bound of the depth.
inline Four depth_of_planes(const OutlineShape& outline, Four r, Four z) noexcept {
    Four depth = min_of(z - all(outline.point[outline.count - 1].z), all(outline.point[0].z) - z);
    for (std::size_t n = 0; n + 1 < outline.count; ++n) depth = min_of(to_face(outline.segment[n], r, z), depth);
    return depth;
}
/// Returns the depth in a convex solid from `depth_of_planes`: equal inside and in front of the face, less beyond its
/// edges.
inline Four convex_depth(const OutlineShape& outline, Four r, Four z, Four depth) noexcept {
    const Four is_outside = less(depth, _mm256_setzero_pd());
    if (_mm256_movemask_pd(is_outside) == 0) return depth;
    const kerf_profile_point &front = outline.point[0], &back = outline.point[outline.count - 1];
    const auto same = [](Four a, Four b) { return _mm256_cmp_pd(a, b, _CMP_EQ_OQ); };
    Four is_beside = _mm256_or_pd(_mm256_and_pd(same(all(front.z) - z, depth), not_less(all(front.radius), r)),
                                  _mm256_and_pd(same(z - all(back.z), depth), not_less(all(back.radius), r)));
    for (std::size_t n = 0; n + 1 < outline.count; ++n) {
        const kerf_profile_point& a = outline.point[n];
        const OutlineSegment& s = outline.segment[n];
        const Four along =
            ((r - all(a.radius)) * all(s.along_r) + (z - all(a.z)) * all(s.along_z)) * all(s.inverse_length2);
        const Four is_within = _mm256_and_pd(not_less(along, _mm256_setzero_pd()), not_less(all(1.0), along));
        is_beside = _mm256_or_pd(is_beside, _mm256_and_pd(same(to_face(s, r, z), depth), is_within));
    }
    const Four is_beyond = _mm256_andnot_pd(is_beside, is_outside);
    if (_mm256_movemask_pd(is_beyond) == 0) return depth;
    const Four distance = _mm256_sqrt_pd(squared_distance(outline, r, z));
    return _mm256_blendv_pd(depth, _mm256_xor_pd(distance, all(-0.0)), is_beyond);
}
/// Returns the depth in any solid.
inline Four depth_in(const OutlineShape& outline, Four r, Four z) noexcept {
    if (outline.is_convex) return convex_depth(outline, r, z, depth_of_planes(outline, r, z));
    const Four is_between =
        _mm256_and_pd(less(z, all(outline.point[0].z)), less(all(outline.point[outline.count - 1].z), z));
    const Four is_inside = _mm256_and_pd(is_between, less(r, wall_at(outline, z)));
    const Four depth = with_sign(_mm256_sqrt_pd(squared_distance(outline, r, z)), is_inside);
    Four deep = outline.bore > 0.0 ? min_of(r - all(outline.bore), depth) : depth;
    for (std::size_t n = 0; n < outline.gaps; ++n)
        deep = min_of(magnitude(z - all(outline.gap[n].middle)) - all(outline.gap[n].half), deep);
    return deep;
}

/// Returns the depth in a prism: the depth in the plane of its outline, limited by two flat sides.
inline Four prism_depth(const OutlineShape& outline, Four x, Four y, Four z) noexcept {
    const Four zero = _mm256_setzero_pd(), r = magnitude(x), side = magnitude(y) - all(outline.half_thickness);
    const Four flat = convex_depth(outline, r, z, depth_of_planes(outline, r, z));
    const Four off = _mm256_and_pd(less(flat, zero), flat), beside = _mm256_and_pd(less(zero, side), side);
    const Four outside = minus(_mm256_sqrt_pd(off * off + beside * beside)), within = min_of(flat, minus(side));
    return _mm256_blendv_pd(within, outside, _mm256_or_pd(less(flat, zero), less(zero, side)));
}

}  // namespace

void avx2::depths(const OutlineShape& outline, std::size_t count, const ConstCoordinates& in_tool,
                  double* depths) noexcept {
    if (outline.half_thickness > 0.0) {
        for (std::size_t i = 0; i < count; i += lanes)
            _mm256_storeu_pd(depths + i, prism_depth(outline, _mm256_loadu_pd(in_tool.x + i),
                                                     _mm256_loadu_pd(in_tool.y + i), _mm256_loadu_pd(in_tool.z + i)));
        return;
    }
    for (std::size_t i = 0; i < count; i += lanes) {
        const Four x = _mm256_loadu_pd(in_tool.x + i), y = _mm256_loadu_pd(in_tool.y + i);
        _mm256_storeu_pd(depths + i, depth_in(outline, _mm256_sqrt_pd(x * x + y * y), _mm256_loadu_pd(in_tool.z + i)));
    }
}

void avx2::tangents(const OutlineShape& outline, std::size_t count, const ConstCoordinates& in_tool, double* depths,
                    const Coordinates& gradients) noexcept {
    const kerf_profile_point &front = outline.point[0], &back = outline.point[outline.count - 1];
    const bool is_prism = outline.half_thickness > 0.0;
    for (std::size_t i = 0; i < count; i += lanes) {
        const Four x = _mm256_loadu_pd(in_tool.x + i), y = _mm256_loadu_pd(in_tool.y + i),
                   z = _mm256_loadu_pd(in_tool.z + i);
        const Four r = is_prism ? magnitude(x) : _mm256_sqrt_pd(x * x + y * y);
        const Four to_front = all(front.z) - z, to_back = z - all(back.z), is_before = less(to_front, to_back);
        Four depth = _mm256_blendv_pd(to_back, to_front, is_before),
             gz = _mm256_blendv_pd(all(1.0), all(-1.0), is_before);
        Four normal_r = _mm256_setzero_pd();
        for (std::size_t n = 0; n + 1 < outline.count; ++n) {
            const OutlineSegment& s = outline.segment[n];
            const Four to_line = all(s.offset) - (all(s.normal_r) * r + all(s.normal_z) * z),
                       is_less = less(to_line, depth);
            depth = _mm256_blendv_pd(depth, to_line, is_less);
            normal_r = _mm256_blendv_pd(normal_r, all(s.normal_r), is_less);
            gz = _mm256_blendv_pd(gz, all(-s.normal_z), is_less);
        }
        if (is_prism) {
            const Four zero = _mm256_setzero_pd(), to_side = all(outline.half_thickness) - magnitude(y),
                       is_side = less(to_side, depth);
            _mm256_storeu_pd(depths + i, _mm256_blendv_pd(depth, to_side, is_side));
            _mm256_storeu_pd(gradients.x + i,
                             _mm256_andnot_pd(is_side, _mm256_blendv_pd(minus(normal_r), normal_r, less(x, zero))));
            _mm256_storeu_pd(gradients.y + i,
                             _mm256_and_pd(is_side, _mm256_blendv_pd(all(-1.0), all(1.0), less(y, zero))));
            _mm256_storeu_pd(gradients.z + i, _mm256_andnot_pd(is_side, gz));
            continue;
        }
        const Four inwards = _mm256_xor_pd(normal_r, all(-0.0)) / r, is_off_axis = less(_mm256_setzero_pd(), r);
        _mm256_storeu_pd(depths + i, depth);
        _mm256_storeu_pd(gradients.x + i, _mm256_blendv_pd(normal_r, inwards * x, is_off_axis));
        _mm256_storeu_pd(gradients.y + i, _mm256_and_pd(is_off_axis, inwards * y));
        _mm256_storeu_pd(gradients.z + i, gz);
    }
}

namespace {

inline Eight to_face(const OutlineFace& f, Eight r, Eight z) noexcept {
    return eight(f.offset) - (eight(f.normal_r) * r + eight(f.normal_z) * z);
}
inline Eight squared_distance(const SingleOutline& o, Eight r, Eight z) noexcept {
    const Eight zero = _mm256_setzero_ps();
    Eight nearest2 = eight(1e30f);
    for (std::size_t n = 0; n < o.count; ++n) {
        const OutlineFace& f = o.face[n];
        const Eight along_r = eight(f.along_r), along_z = eight(f.along_z), dr = r - eight(f.radius),
                    dz = z - eight(f.z);
        const Eight t = min_of(eight(1.0f), max_of(zero, (dr * along_r + dz * along_z) * eight(f.inverse_length2)));
        const Eight off_r = dr - t * along_r, off_z = dz - t * along_z;
        nearest2 = min_of(off_r * off_r + off_z * off_z, nearest2);
    }
    const auto to_cap2 = [&](float radius, float at) {
        const Eight dr = max_of(r - eight(radius), zero), dz = z - eight(at);
        return dr * dr + dz * dz;
    };
    if (o.front_radius > 0.0f) nearest2 = min_of(to_cap2(o.front_radius, o.front_z), nearest2);
    return min_of(to_cap2(o.back_radius, o.back_z), nearest2);
}
inline Eight depth_at_most(const SingleOutline& o, Eight r, Eight z) noexcept {
    if (o.is_convex) {
        Eight depth = min_of(z - eight(o.back_z), eight(o.front_z) - z);
        for (std::size_t n = 0; n < o.count; ++n) depth = min_of(to_face(o.face[n], r, z), depth);
        return depth;
    }
    Eight wall = eight(o.back_radius);
    for (std::size_t n = o.count; n > 0; --n) {
        const OutlineFace& f = o.face[n - 1];
        const Eight is_behind = less(z, eight(n < o.count ? o.face[n].z : o.back_z));
        wall = _mm256_blendv_ps(eight(f.radius) + eight(f.slope) * (eight(f.z) - z), wall, is_behind);
    }
    const Eight is_between = _mm256_and_ps(less(z, eight(o.front_z)), less(eight(o.back_z), z));
    const Eight distance = _mm256_sqrt_ps(squared_distance(o, r, z));
    const Eight depth = _mm256_blendv_ps(minus(distance), distance, _mm256_and_ps(is_between, less(r, wall)));
    Eight deep = o.bore > 0.0f ? min_of(r - eight(o.bore), depth) : depth;
    for (std::size_t n = 0; n < o.gaps; ++n)
        deep = min_of(magnitude(z - eight(o.gap[n].middle)) - eight(o.gap[n].half), deep);
    return deep;
}
/// Returns the depth in a convex solid from `depth_at_most`: equal inside and in front of the face, less beyond its
/// edges.
inline Eight depth_from(const SingleOutline& o, Eight r, Eight z, Eight depth) noexcept {
    const Eight zero = _mm256_setzero_ps(), is_outside = less(depth, zero);
    Eight is_beside = _mm256_or_ps(_mm256_and_ps(same(eight(o.front_z) - z, depth), not_less(eight(o.front_radius), r)),
                                   _mm256_and_ps(same(z - eight(o.back_z), depth), not_less(eight(o.back_radius), r)));
    for (std::size_t n = 0; n < o.count; ++n) {
        const OutlineFace& f = o.face[n];
        const Eight along =
            ((r - eight(f.radius)) * eight(f.along_r) + (z - eight(f.z)) * eight(f.along_z)) * eight(f.inverse_length2);
        const Eight is_within = _mm256_and_ps(not_less(along, zero), not_less(eight(1.0f), along));
        is_beside = _mm256_or_ps(is_beside, _mm256_and_ps(same(to_face(f, r, z), depth), is_within));
    }
    const Eight is_beyond = _mm256_andnot_ps(is_beside, is_outside);
    if (!any(is_beyond)) return depth;
    return _mm256_blendv_ps(depth, min_of(minus(_mm256_sqrt_ps(squared_distance(o, r, z))), depth), is_beyond);
}

struct EightPoints {
    Eight x, y, z;
};
inline Eight radius_of(const SingleOutline& o, const EightPoints& p) noexcept {
    return o.half_thickness > 0.0f ? magnitude(p.x) : _mm256_sqrt_ps(p.x * p.x + p.y * p.y);
}
/// Returns an upper bound of the depth in a solid of revolution or a prism. `r` is from `radius_of`, `y` is across a
/// prism.
inline Eight depth_at_most(const SingleOutline& o, Eight r, Eight y, Eight z) noexcept {
    const Eight flat = depth_at_most(o, r, z);
    return o.half_thickness > 0.0f ? min_of(eight(o.half_thickness) - magnitude(y), flat) : flat;
}
inline Eight depth_from(const SingleOutline& o, Eight r, Eight y, Eight z, Eight depth) noexcept {
    if (!(o.half_thickness > 0.0f)) return depth_from(o, r, z, depth);
    const Eight zero = _mm256_setzero_ps(), is_outside = less(depth, zero);
    if (!any(is_outside)) return depth;
    const Eight flat = depth_from(o, r, z, depth_at_most(o, r, z));
    const Eight off = min_of(flat, zero), beside = max_of(magnitude(y) - eight(o.half_thickness), zero);
    return _mm256_blendv_ps(depth, min_of(minus(_mm256_sqrt_ps(off * off + beside * beside)), depth), is_outside);
}
inline EightPoints moved(const SingleFrame& f, const EightPoints& p) noexcept {
    const auto along = [&](int n) {
        return ((eight(f.axis[0][n]) * p.x + eight(f.axis[1][n]) * p.y) + eight(f.axis[2][n]) * p.z) +
               eight(f.origin[n]);
    };
    return {along(0), along(1), along(2)};
}
inline EightPoints turned_back(const SingleFrame& f, const EightPoints& d) noexcept {
    const auto along = [&](int n) {
        return (eight(f.axis[n][0]) * d.x + eight(f.axis[n][1]) * d.y) + eight(f.axis[n][2]) * d.z;
    };
    return {along(0), along(1), along(2)};
}

inline EightPoints inward_direction(const SingleOutline& o, const EightPoints& p, Eight r) noexcept {
    const Eight to_back = p.z - eight(o.back_z), to_front = eight(o.front_z) - p.z;
    Eight depth = min_of(to_back, to_front), in_r = _mm256_setzero_ps();
    Eight in_z = _mm256_blendv_ps(eight(1.0f), eight(-1.0f), less(to_front, to_back));
    for (std::size_t n = 0; n < o.count; ++n) {
        const Eight here = to_face(o.face[n], r, p.z), is_less = less(here, depth);
        depth = _mm256_blendv_ps(depth, here, is_less);
        in_r = _mm256_blendv_ps(in_r, eight(o.face[n].normal_r), is_less);
        in_z = _mm256_blendv_ps(in_z, eight(-o.face[n].normal_z), is_less);
    }
    if (o.half_thickness > 0.0f) {
        const Eight zero = _mm256_setzero_ps(), is_side = less(eight(o.half_thickness) - magnitude(p.y), depth);
        return {_mm256_andnot_ps(is_side, _mm256_blendv_ps(minus(in_r), in_r, less(p.x, zero))),
                _mm256_and_ps(is_side, _mm256_blendv_ps(eight(-1.0f), eight(1.0f), less(p.y, zero))),
                _mm256_andnot_ps(is_side, in_z)};
    }
    if (o.bore > 0.0f) {  // away from the bore
        const Eight is_bore = less(r - eight(o.bore), depth);
        depth = _mm256_blendv_ps(depth, r - eight(o.bore), is_bore);
        in_r = _mm256_blendv_ps(in_r, eight(-1.0f), is_bore);
        in_z = _mm256_andnot_ps(is_bore, in_z);
    }
    for (std::size_t n = 0; n < o.gaps; ++n) {  // away from the gap
        const Eight off = p.z - eight(o.gap[n].middle), to_gap = magnitude(off) - eight(o.gap[n].half),
                    is_gap = less(to_gap, depth);
        depth = _mm256_blendv_ps(depth, to_gap, is_gap);
        in_r = _mm256_andnot_ps(is_gap, in_r);
        in_z =
            _mm256_blendv_ps(in_z, _mm256_blendv_ps(eight(1.0f), eight(-1.0f), less(off, _mm256_setzero_ps())), is_gap);
    }
    const Eight inwards = _mm256_and_ps(minus(in_r) / r, less(_mm256_setzero_ps(), r));
    return {inwards * p.x, inwards * p.y, in_z};
}

}  // namespace

void avx2::deepest(const SingleOutline& outline, const SingleFrame* solid_from_points, std::size_t solids,
                   std::size_t count, const kerf_vec3* points, const Walls& walls) noexcept {
    const Steps<wide> steps(points, count);
    for (std::size_t i = 0; i < count; i += wide) {
        const Four3 a = load_points(steps[i]), b = load_points(steps[i] + 3 * lanes);
        const auto single = [](Four low, Four high) {
            return _mm256_set_m128(_mm256_cvtpd_ps(high), _mm256_cvtpd_ps(low));
        };
        const EightPoints at{single(a.x, b.x), single(a.y, b.y), single(a.z, b.z)};
        Eight best = _mm256_loadu_ps(walls.depth + i),
              which = _mm256_loadu_ps(reinterpret_cast<const float*>(walls.which + i));
        EightPoints way{_mm256_loadu_ps(walls.x + i), _mm256_loadu_ps(walls.y + i), _mm256_loadu_ps(walls.z + i)};
        for (std::size_t n = 0; n < solids; ++n) {
            const SingleFrame& frame = solid_from_points[n];
            const EightPoints p = moved(frame, at);
            const Eight r = radius_of(outline, p);
            Eight depth = depth_at_most(outline, r, p.y, p.z);
            Eight is_deeper = less(best, depth);
            if (!any(is_deeper)) continue;
            if (outline.is_convex && any(_mm256_and_ps(is_deeper, less(depth, _mm256_setzero_ps()))))
                depth = depth_from(outline, r, p.y, p.z, depth);
            is_deeper = less(best, depth);
            if (!any(is_deeper)) continue;
            const EightPoints way_here = turned_back(frame, inward_direction(outline, p, r));
            best = _mm256_blendv_ps(best, depth, is_deeper);
            which = _mm256_blendv_ps(which, _mm256_castsi256_ps(all_ints(static_cast<std::int32_t>(n))), is_deeper);
            way = {_mm256_blendv_ps(way.x, way_here.x, is_deeper), _mm256_blendv_ps(way.y, way_here.y, is_deeper),
                   _mm256_blendv_ps(way.z, way_here.z, is_deeper)};
        }
        _mm256_storeu_ps(walls.depth + i, best);
        _mm256_storeu_ps(reinterpret_cast<float*>(walls.which + i), which);
        _mm256_storeu_ps(walls.x + i, way.x);
        _mm256_storeu_ps(walls.y + i, way.y);
        _mm256_storeu_ps(walls.z + i, way.z);
    }
}

namespace {

/// Returns a depth in quanta: rounded to the nearest, ties to even, and clamped to ± 32767.
inline EightInts quantised(Eight depth, Eight per_quantum) noexcept {
    const Eight q = depth * per_quantum;
    return _mm256_cvtps_epi32(max_of(min_of(q, eight(32767.0f)), eight(-32767.0f)));
}

// The 27 samples of a cell's layer are contiguous. Four steps of eight process them; the last one repeats five samples.
constexpr int steps_of_layer = 4, step_start[steps_of_layer] = {0, 8, 16, 19};
struct LanePlaces {
    float x[steps_of_layer][wide], y[steps_of_layer][wide];

    constexpr LanePlaces() noexcept : x{}, y{} {
        for (int n = 0; n < steps_of_layer; ++n)
            for (int lane = 0; lane < static_cast<int>(wide); ++lane) {
                const int place = step_start[n] + lane, row = place / stored;
                x[n][lane] = static_cast<float>(place % stored);
                y[n][lane] = static_cast<float>(row);
            }
    }
};
alignas(32) constexpr LanePlaces lane_places;

/// A cell's 81 samples in steps of eight. Each function processes all steps: a branch at every step on whether a sample
/// rises would be mispredicted too often.
struct CellSteps {
    static constexpr int count = 3 * steps_of_layer;
    Eight radius[count], across[count], height[count], depth[count];
    EightInts before[count], value[count];

    [[gnu::always_inline]] static __m128i* at(std::int16_t* samples, int n) noexcept {
        const int layer = n / steps_of_layer;
        return reinterpret_cast<__m128i*>(samples + layer * stored * stored + step_start[n % steps_of_layer]);
    }

    /// Sets `radius`, `across` and `height` to the samples' r, y and z in the tool frame [m].
    [[gnu::always_inline]] void place(const SingleOutline& outline, const SampleCell& cell) noexcept {
        const auto& along = cell.along;
        EightPoints up[3];
        for (int layer = 0; layer < 3; ++layer) {
            const Eight k = eight(cell.first[2] + static_cast<float>(layer));
            up[layer] = {k * eight(along[2][0]), k * eight(along[2][1]), k * eight(along[2][2])};
        }
        for (int n = 0; n < steps_of_layer; ++n) {
            const Eight i = eight(cell.first[0]) + _mm256_loadu_ps(lane_places.x[n]),
                        j = eight(cell.first[1]) + _mm256_loadu_ps(lane_places.y[n]);
            const auto row = [&](int axis) {
                return (eight(cell.origin[axis]) + i * eight(along[0][axis])) + j * eight(along[1][axis]);
            };
            const EightPoints start{row(0), row(1), row(2)};
            for (int layer = 0; layer < 3; ++layer) {
                const int step = layer * steps_of_layer + n;
                const Eight x = start.x + up[layer].x, y = start.y + up[layer].y, z = start.z + up[layer].z;
                radius[step] = radius_of(outline, {x, y, z});
                across[step] = y;
                height[step] = z;
            }
        }
    }

    [[gnu::always_inline]] Eight rises(int n, Eight farthest) const noexcept {
        return _mm256_and_ps(_mm256_castsi256_ps(_mm256_cmpgt_epi32(value[n], before[n])),
                             not_less(depth[n], farthest));
    }

    /// Returns the smallest max(sample, end of the band) − value [quanta] of all samples below 32767; at least 0.
    [[gnu::always_inline]] std::int16_t spare(float band, float per_quantum) const noexcept {
        const EightInts full = all_ints(32767), end_of_band = all_ints(static_cast<std::int32_t>(-band * per_quantum));
        EightInts min_spare = full;
        for (int n = 0; n < count; ++n) {
            const EightInts here = _mm256_sub_epi32(_mm256_max_epi32(before[n], end_of_band), value[n]);
            min_spare =
                _mm256_min_epi32(min_spare, _mm256_blendv_epi8(here, full, _mm256_cmpeq_epi32(before[n], full)));
        }
        std::int32_t each[wide];
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(each), min_spare);
        std::int32_t least = 32767;
        for (const std::int32_t one : each) least = one < least ? one : least;
        return static_cast<std::int16_t>(least < 0 ? 0 : least);
    }

    /// Stores the samples that rise and the range of all samples. Returns whether any rises.
    [[gnu::always_inline]] bool store(Eight farthest, std::int16_t* samples, std::int16_t& lowest,
                                      std::int16_t& highest) const noexcept {
        __m128i min_value = _mm_set1_epi16(32767), max_value = _mm_set1_epi16(-32767);
        Eight is_raised = _mm256_setzero_ps();
        for (int n = 0; n < count; ++n) {
            const Eight rises_here = rises(n, farthest);
            is_raised = _mm256_or_ps(is_raised, rises_here);
            const EightInts raised = _mm256_blendv_epi8(before[n], value[n], _mm256_castps_si256(rises_here));
            const __m128i after = _mm_packs_epi32(_mm256_castsi256_si128(raised), _mm256_extracti128_si256(raised, 1));
            _mm_storeu_si128(at(samples, n), after);
            min_value = _mm_min_epi16(min_value, after);
            max_value = _mm_max_epi16(max_value, after);
        }
        std::int16_t each[2][wide];
        _mm_storeu_si128(reinterpret_cast<__m128i*>(each[0]), min_value);
        _mm_storeu_si128(reinterpret_cast<__m128i*>(each[1]), max_value);
        lowest = each[0][0];
        highest = each[1][0];
        for (std::size_t lane = 1; lane < wide; ++lane) {
            lowest = each[0][lane] < lowest ? each[0][lane] : lowest;
            highest = each[1][lane] > highest ? each[1][lane] : highest;
        }
        return any(is_raised);
    }
};

}  // namespace

bool avx2::raise(const SingleOutline& outline, const SampleCell& cell, float band, float per_quantum,
                 std::int16_t* samples, std::int16_t& lowest, std::int16_t& highest, std::int16_t* spare) noexcept {
    const Eight farthest = eight(-band), scale = eight(per_quantum), zero = _mm256_setzero_ps();
    CellSteps steps;
    steps.place(outline, cell);
    Eight may_rise = zero, may_rise_outside = zero;
    for (int n = 0; n < CellSteps::count; ++n) {
        steps.before[n] = _mm256_cvtepi16_epi32(_mm_loadu_si128(CellSteps::at(samples, n)));
        steps.depth[n] = depth_at_most(outline, steps.radius[n], steps.across[n], steps.height[n]);
        steps.value[n] = quantised(steps.depth[n], scale);
        const Eight rises_here = steps.rises(n, farthest);
        may_rise = _mm256_or_ps(may_rise, rises_here);
        may_rise_outside = _mm256_or_ps(may_rise_outside, _mm256_and_ps(rises_here, less(steps.depth[n], zero)));
    }
    if (!any(may_rise)) {
        if (spare != nullptr) *spare = steps.spare(band, per_quantum);
        return false;
    }
    if (outline.is_convex && cell.has_edges && any(may_rise_outside))
        for (int n = 0; n < CellSteps::count; ++n) {
            // The depth below planes is an upper bound, and exact inside: correct it only for samples outside that it
            // would raise.
            if (!any(_mm256_and_ps(steps.rises(n, farthest), less(steps.depth[n], zero)))) continue;
            steps.depth[n] = depth_from(outline, steps.radius[n], steps.across[n], steps.height[n], steps.depth[n]);
            steps.value[n] = quantised(steps.depth[n], scale);
        }
    const bool is_raised = steps.store(farthest, samples, lowest, highest);
    if (spare != nullptr) *spare = is_raised ? std::int16_t{0} : steps.spare(band, per_quantum);
    return is_raised;
}

void avx2::find(const std::int16_t* samples, std::int16_t low, std::int16_t high, std::uint32_t (&found)[3]) noexcept {
    const __m256i below = _mm256_set1_epi16(low), above = _mm256_set1_epi16(high);
    const auto outside = [&](const std::int16_t* at) {
        const __m256i v = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(at));
        return _mm256_or_si256(_mm256_cmpgt_epi16(below, v), _mm256_cmpgt_epi16(v, above));
    };
    for (int layer = 0; layer < 3; ++layer) {
        const std::int16_t* at = samples + layer * stored * stored;
        // Samples 0 … 15 of the 27, and samples 11 … 26.
        const __m256i both = _mm256_packs_epi16(outside(at), outside(at + 11));
        const auto bits =
            static_cast<std::uint32_t>(~_mm256_movemask_epi8(_mm256_permute4x64_epi64(both, _MM_SHUFFLE(3, 1, 2, 0))));
        found[layer] = (bits & 0xffffu) | (bits >> 16) << 11;
    }
}

}  // namespace kerf
