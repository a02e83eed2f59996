// SPDX-License-Identifier: Apache-2.0
// Four points at a time, each with the operations of the portable kernel in its order. Compiled with -mavx2 and entered
// only where the processor has it; without fused multiply-add, which would round differently.
#include <immintrin.h>

#include <cstring>

#include "core/field/block_kernel.h"

namespace kerf {

extern const BlockKernel avx2_kernel_table;

namespace {

using Four = __m256d;
constexpr std::size_t lanes = 4;
constexpr int brick_bits = 3, stored = 9;  // of core/field/grid.h: 8 samples a brick and axis, 9 with the apron

inline Four all(double v) noexcept { return _mm256_set1_pd(v); }
/// a < b ? a : b, as the instruction has it for NaN too.
inline Four least(Four a, Four b) noexcept { return _mm256_min_pd(a, b); }
/// a > b ? a : b.
inline Four most(Four a, Four b) noexcept { return _mm256_max_pd(a, b); }
inline Four less(Four a, Four b) noexcept { return _mm256_cmp_pd(a, b, _CMP_LT_OQ); }
inline Four not_less(Four a, Four b) noexcept { return _mm256_cmp_pd(a, b, _CMP_GE_OQ); }

struct Four3 {
    Four x, y, z;
};
inline Four3 cross(const Four3& a, const Four3& b) noexcept {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

void transform(const kerf_pose& a_from_b, std::size_t count, ConstCoordinates in_b, Coordinates in_a) noexcept {
    const Four3 position{all(a_from_b.position.x), all(a_from_b.position.y), all(a_from_b.position.z)};
    const Four3 u{all(a_from_b.rotation.x), all(a_from_b.rotation.y), all(a_from_b.rotation.z)};
    const Four w = all(a_from_b.rotation.w), two = all(2.0);
    for (std::size_t i = 0; i < count; i += lanes) {
        const Four3 v{_mm256_loadu_pd(in_b.x + i), _mm256_loadu_pd(in_b.y + i), _mm256_loadu_pd(in_b.z + i)};
        Four3 t = cross(u, v);
        t = {two * t.x, two * t.y, two * t.z};
        const Four3 c = cross(u, t);
        _mm256_storeu_pd(in_a.x + i, position.x + (v.x + w * t.x + c.x));
        _mm256_storeu_pd(in_a.y + i, position.y + (v.y + w * t.y + c.y));
        _mm256_storeu_pd(in_a.z + i, position.z + (v.z + w * t.z + c.z));
    }
}

/// The four 64-bit masks as 32-bit ones.
inline __m128i narrow(Four mask) noexcept {
    const __m128 low = _mm_castpd_ps(_mm256_castpd256_pd128(mask));
    const __m128 high = _mm_castpd_ps(_mm256_extractf128_pd(mask, 1));
    return _mm_castps_si128(_mm_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0)));
}

void locate(const LatticeShape& grid, std::size_t count, ConstCoordinates points, Places places) noexcept {
    const Four zero = _mm256_setzero_pd(), per_metre = all(1.0 / grid.spacing);
    const Four3 origin{all(grid.origin[0]), all(grid.origin[1]), all(grid.origin[2])};
    const Four3 end{all(grid.samples[0]), all(grid.samples[1]), all(grid.samples[2])};
    const __m128i row = _mm_set1_epi32(grid.row), column = _mm_set1_epi32(grid.column);
    const __m128i within = _mm_set1_epi32((1 << brick_bits) - 1), edge = _mm_set1_epi32(stored);
    for (std::size_t n = 0; n < count; n += lanes) {
        const Four gx = (_mm256_loadu_pd(points.x + n) - origin.x) * per_metre;
        const Four gy = (_mm256_loadu_pd(points.y + n) - origin.y) * per_metre;
        const Four gz = (_mm256_loadu_pd(points.z + n) - origin.z) * per_metre;
        const Four is_low = _mm256_and_pd(not_less(gx, zero), _mm256_and_pd(not_less(gy, zero), not_less(gz, zero)));
        const Four is_high = _mm256_and_pd(less(gx, end.x), _mm256_and_pd(less(gy, end.y), less(gz, end.z)));
        const Four is_inside = _mm256_and_pd(is_low, is_high);
        const Four x = _mm256_and_pd(is_inside, gx), y = _mm256_and_pd(is_inside, gy), z = _mm256_and_pd(is_inside, gz);
        const __m128i i = _mm256_cvttpd_epi32(x), j = _mm256_cvttpd_epi32(y), k = _mm256_cvttpd_epi32(z);
        const __m128i bi = _mm_srli_epi32(i, brick_bits), bj = _mm_srli_epi32(j, brick_bits),
                      bk = _mm_srli_epi32(k, brick_bits);
        const __m128i brick = _mm_add_epi32(_mm_mullo_epi32(_mm_add_epi32(_mm_mullo_epi32(bk, column), bj), row), bi);
        const __m128i outside = _mm_andnot_si128(narrow(is_inside), _mm_set1_epi32(-1));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(places.brick + n), _mm_or_si128(brick, outside));
        const __m128i oi = _mm_and_si128(i, within), oj = _mm_and_si128(j, within), ok = _mm_and_si128(k, within);
        const __m128i offset = _mm_add_epi32(_mm_mullo_epi32(_mm_add_epi32(_mm_mullo_epi32(ok, edge), oj), edge), oi);
        _mm_storeu_si128(reinterpret_cast<__m128i*>(places.offset + n), offset);
        _mm256_storeu_pd(places.fraction.x + n, x - _mm256_cvtepi32_pd(i));
        _mm256_storeu_pd(places.fraction.y + n, y - _mm256_cvtepi32_pd(j));
        _mm256_storeu_pd(places.fraction.z + n, z - _mm256_cvtepi32_pd(k));
    }
}

/// Two neighbours along x, for each of four points. Plain loads: a gather took 1.6 times as long where it was measured.
struct Pairs {
    Four low, high;
};
inline Pairs load(const std::int16_t* const (&corner)[lanes], int at) noexcept {
    std::int32_t pair[lanes];
    for (std::size_t i = 0; i < lanes; ++i) std::memcpy(&pair[i], corner[i] + at, sizeof pair[i]);
    const __m128i both = _mm_setr_epi32(pair[0], pair[1], pair[2], pair[3]);
    return {_mm256_cvtepi32_pd(_mm_srai_epi32(_mm_slli_epi32(both, 16), 16)),
            _mm256_cvtepi32_pd(_mm_srai_epi32(both, 16))};
}
inline Pairs load(const float* const (&corner)[lanes], int at) noexcept {
    double pair[lanes];
    for (std::size_t i = 0; i < lanes; ++i) std::memcpy(&pair[i], corner[i] + at, sizeof pair[i]);
    const __m128 first = _mm_castpd_ps(_mm_setr_pd(pair[0], pair[1]));
    const __m128 second = _mm_castpd_ps(_mm_setr_pd(pair[2], pair[3]));
    return {_mm256_cvtps_pd(_mm_shuffle_ps(first, second, _MM_SHUFFLE(2, 0, 2, 0))),
            _mm256_cvtps_pd(_mm_shuffle_ps(first, second, _MM_SHUFFLE(3, 1, 3, 1)))};
}

inline Four lerp(Four a, Four b, Four t) noexcept { return a + (b - a) * t; }

template <class Sample>
inline void interpolate(const Sample* const* corner, std::size_t count, ConstCoordinates fraction, double quantum,
                        double* values) noexcept {
    constexpr int y = stored, z = stored * stored;
    const Four scale = all(quantum);
    for (std::size_t i = 0; i < count; i += lanes) {
        const Sample* four[lanes];  // behind the last point, the last once more: nothing else may be read there
        for (std::size_t n = 0; n < lanes; ++n) four[n] = corner[i + n < count ? i + n : count - 1];
        const Four fx = _mm256_loadu_pd(fraction.x + i), fy = _mm256_loadu_pd(fraction.y + i),
                   fz = _mm256_loadu_pd(fraction.z + i);
        const Pairs v00 = load(four, 0), v10 = load(four, y), v01 = load(four, z), v11 = load(four, z + y);
        const Four c00 = lerp(v00.low, v00.high, fx), c10 = lerp(v10.low, v10.high, fx);
        const Four c01 = lerp(v01.low, v01.high, fx), c11 = lerp(v11.low, v11.high, fx);
        _mm256_storeu_pd(values + i, scale * lerp(lerp(c00, c10, fy), lerp(c01, c11, fy), fz));
    }
}

void trilinear_int16(const std::int16_t* const* corner, std::size_t count, ConstCoordinates fraction, double quantum,
                     double* values) noexcept {
    interpolate(corner, count, fraction, quantum, values);
}
void trilinear_float(const float* const* corner, std::size_t count, ConstCoordinates fraction, double quantum,
                     double* values) noexcept {
    interpolate(corner, count, fraction, quantum, values);
}

void gradient_int16(const std::int16_t* const* corner, std::size_t count, ConstCoordinates fraction, double quantum,
                    double* values, Coordinates gradient) noexcept {
    constexpr int y = stored, z = stored * stored;
    const Four scale = all(quantum);
    for (std::size_t i = 0; i < count; i += lanes) {
        const std::int16_t* four[lanes];
        for (std::size_t n = 0; n < lanes; ++n) four[n] = corner[i + n < count ? i + n : count - 1];
        const Four fx = _mm256_loadu_pd(fraction.x + i), fy = _mm256_loadu_pd(fraction.y + i),
                   fz = _mm256_loadu_pd(fraction.z + i);
        const Pairs v00 = load(four, 0), v10 = load(four, y), v01 = load(four, z), v11 = load(four, z + y);
        const Four x00 = v00.high - v00.low, x10 = v10.high - v10.low, x01 = v01.high - v01.low, x11 = v11.high - v11.low;
        const Four c00 = v00.low + x00 * fx, c10 = v10.low + x10 * fx, c01 = v01.low + x01 * fx, c11 = v11.low + x11 * fx;
        const Four y0 = c10 - c00, y1 = c11 - c01;
        const Four c0 = c00 + y0 * fy, c1 = c01 + y1 * fy;
        _mm256_storeu_pd(gradient.x + i, lerp(lerp(x00, x10, fy), lerp(x01, x11, fy), fz));
        _mm256_storeu_pd(gradient.y + i, lerp(y0, y1, fz));
        _mm256_storeu_pd(gradient.z + i, c1 - c0);
        _mm256_storeu_pd(values + i, scale * (c0 + (c1 - c0) * fz));
    }
}

void unit(const kerf_quat& a_from_b, std::size_t count, ConstCoordinates in_b, Coordinates in_a) noexcept {
    const Four3 u{all(a_from_b.x), all(a_from_b.y), all(a_from_b.z)};
    const Four w = all(a_from_b.w), two = all(2.0);
    for (std::size_t i = 0; i < count; i += lanes) {
        const Four x = _mm256_loadu_pd(in_b.x + i), y = _mm256_loadu_pd(in_b.y + i), z = _mm256_loadu_pd(in_b.z + i);
        const Four l = _mm256_sqrt_pd(x * x + y * y + z * z);
        const Four has_length = less(_mm256_setzero_pd(), l);
        const Four3 v{_mm256_and_pd(has_length, x / l), _mm256_and_pd(has_length, y / l), _mm256_and_pd(has_length, z / l)};
        Four3 t = cross(u, v);
        t = {two * t.x, two * t.y, two * t.z};
        const Four3 c = cross(u, t);
        _mm256_storeu_pd(in_a.x + i, v.x + w * t.x + c.x);
        _mm256_storeu_pd(in_a.y + i, v.y + w * t.y + c.y);
        _mm256_storeu_pd(in_a.z + i, v.z + w * t.z + c.z);
    }
}

/// Squared distance to the flat disc of a rim.
inline Four to_cap2(Four r, Four z, const kerf_profile_point& rim) noexcept {
    const Four dr = most(r - all(rim.radius), _mm256_setzero_pd()), dz = z - all(rim.z);
    return dr * dr + dz * dz;
}

/// The outline's radius where the points stand.
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

/// To the nearest point of the outline.
inline Four squared_distance(const OutlineShape& outline, Four r, Four z) noexcept {
    const kerf_profile_point &front = outline.point[0], &back = outline.point[outline.count - 1];
    Four nearest2 = all(1e300);
    for (std::size_t n = 0; n + 1 < outline.count; ++n) {
        const kerf_profile_point& a = outline.point[n];
        const OutlineSegment& s = outline.segment[n];
        const Four along_r = all(s.along_r), along_z = all(s.along_z);
        const Four dr = r - all(a.radius), dz = z - all(a.z);
        const Four along = (dr * along_r + dz * along_z) * all(s.inverse_length2);
        const Four t = least(all(1.0), most(_mm256_setzero_pd(), along));
        const Four off_r = dr - t * along_r, off_z = dz - t * along_z;
        nearest2 = least(off_r * off_r + off_z * off_z, nearest2);
    }
    if (front.radius > 0.0) nearest2 = least(to_cap2(r, z, front), nearest2);
    return least(to_cap2(r, z, back), nearest2);
}

/// `v` where `is_positive`, else −v. Pre: v ≥ 0.
inline Four with_sign(Four v, Four is_positive) noexcept {
    return _mm256_xor_pd(v, _mm256_andnot_pd(is_positive, all(-0.0)));
}

inline Four to_face(const OutlineSegment& s, Four r, Four z) noexcept {
    return all(s.offset) - (all(s.normal_r) * r + all(s.normal_z) * z);
}
/// To the plane of the nearest face; no less than the depth in a convex solid.
inline Four depth_of_planes(const OutlineShape& outline, Four r, Four z) noexcept {
    Four depth = least(z - all(outline.point[outline.count - 1].z), all(outline.point[0].z) - z);
    for (std::size_t n = 0; n + 1 < outline.count; ++n) depth = least(to_face(outline.segment[n], r, z), depth);
    return depth;
}
/// The depth in a convex solid from that: the same inside and beside the face, less beyond its edges.
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
        const Four along = ((r - all(a.radius)) * all(s.along_r) + (z - all(a.z)) * all(s.along_z)) * all(s.inverse_length2);
        const Four is_within = _mm256_and_pd(not_less(along, _mm256_setzero_pd()), not_less(all(1.0), along));
        is_beside = _mm256_or_pd(is_beside, _mm256_and_pd(same(to_face(s, r, z), depth), is_within));
    }
    const Four is_beyond = _mm256_andnot_pd(is_beside, is_outside);
    if (_mm256_movemask_pd(is_beyond) == 0) return depth;
    const Four distance = _mm256_sqrt_pd(squared_distance(outline, r, z));
    return _mm256_blendv_pd(depth, _mm256_xor_pd(distance, all(-0.0)), is_beyond);
}
/// The depth in any solid.
inline Four depth_in(const OutlineShape& outline, Four r, Four z) noexcept {
    if (outline.is_convex) return convex_depth(outline, r, z, depth_of_planes(outline, r, z));
    const Four is_between = _mm256_and_pd(less(z, all(outline.point[0].z)), less(all(outline.point[outline.count - 1].z), z));
    const Four is_inside = _mm256_and_pd(is_between, less(r, wall_at(outline, z)));
    return with_sign(_mm256_sqrt_pd(squared_distance(outline, r, z)), is_inside);
}

void depths(const OutlineShape& outline, std::size_t count, ConstCoordinates in_tool, double* depths) noexcept {
    for (std::size_t i = 0; i < count; i += lanes) {
        const Four x = _mm256_loadu_pd(in_tool.x + i), y = _mm256_loadu_pd(in_tool.y + i);
        _mm256_storeu_pd(depths + i, depth_in(outline, _mm256_sqrt_pd(x * x + y * y), _mm256_loadu_pd(in_tool.z + i)));
    }
}

void tangents(const OutlineShape& outline, std::size_t count, ConstCoordinates in_tool, double* depths,
              Coordinates gradients) noexcept {
    const kerf_profile_point &front = outline.point[0], &back = outline.point[outline.count - 1];
    for (std::size_t i = 0; i < count; i += lanes) {
        const Four x = _mm256_loadu_pd(in_tool.x + i), y = _mm256_loadu_pd(in_tool.y + i), z = _mm256_loadu_pd(in_tool.z + i);
        const Four r = _mm256_sqrt_pd(x * x + y * y);
        const Four to_front = all(front.z) - z, to_back = z - all(back.z), is_before = less(to_front, to_back);
        Four depth = _mm256_blendv_pd(to_back, to_front, is_before), gz = _mm256_blendv_pd(all(1.0), all(-1.0), is_before);
        Four normal_r = _mm256_setzero_pd();
        for (std::size_t n = 0; n + 1 < outline.count; ++n) {
            const OutlineSegment& s = outline.segment[n];
            const Four to_line = all(s.offset) - (all(s.normal_r) * r + all(s.normal_z) * z), is_less = less(to_line, depth);
            depth = _mm256_blendv_pd(depth, to_line, is_less);
            normal_r = _mm256_blendv_pd(normal_r, all(s.normal_r), is_less);
            gz = _mm256_blendv_pd(gz, all(-s.normal_z), is_less);
        }
        const Four inwards = _mm256_xor_pd(normal_r, all(-0.0)) / r, is_off_axis = less(_mm256_setzero_pd(), r);
        _mm256_storeu_pd(depths + i, depth);
        _mm256_storeu_pd(gradients.x + i, _mm256_blendv_pd(normal_r, inwards * x, is_off_axis));
        _mm256_storeu_pd(gradients.y + i, _mm256_and_pd(is_off_axis, inwards * y));
        _mm256_storeu_pd(gradients.z + i, gz);
    }
}

/// To the nearest quantum, kept within ± 32767.
inline __m128i quantised(Four depth, Four per_quantum) noexcept {
    const Four q = depth * per_quantum;
    const Four kept = most(least(q, all(32767.0)), all(-32767.0));
    const Four half = _mm256_blendv_pd(all(-0.5), all(0.5), not_less(q, _mm256_setzero_pd()));
    return _mm256_cvttpd_epi32(kept + half);
}

bool raise(const OutlineShape& outline, const SampleCell& cell, double band, double quantum, std::int16_t* samples,
           std::int16_t& lowest, std::int16_t& highest) noexcept {
    const Four per_quantum = all(1.0 / quantum), farthest = all(-band);
    const __m128 lowest_kept = _mm_set1_ps(static_cast<float>(-band / quantum) - 2.0f);
    const ConstCoordinates start = cell.row, along = cell.along;
    __m128i least_value = _mm_set1_epi32(32767), most_value = _mm_set1_epi32(-32767), raised = _mm_setzero_si128();
    /// What four samples become; `at` makes their places, if one of them can rise.
    const auto raise_four = [&](__m128i before, __m128 ceiling, const auto& at) {
        const __m128 is_below = _mm_and_ps(_mm_cmplt_ps(_mm_cvtepi32_ps(before), ceiling), _mm_cmplt_ps(lowest_kept, ceiling));
        __m128i after = before;
        if (_mm_movemask_ps(is_below) != 0) {
            const Four3 p = at();
            const Four depth = depth_in(outline, _mm256_sqrt_pd(p.x * p.x + p.y * p.y), p.z);
            const __m128i is_near = narrow(not_less(depth, farthest));
            const __m128i cut = _mm_blendv_epi8(_mm_set1_epi32(-32767), quantised(depth, per_quantum), is_near);
            after = _mm_max_epi32(before, cut);
        }
        raised = _mm_or_si128(raised, _mm_cmpgt_epi32(after, before));
        least_value = _mm_min_epi32(least_value, after);
        most_value = _mm_max_epi32(most_value, after);
        return after;
    };
    const auto ceiling_at = [&](int x, int y, int layer) {
        return cell.base + static_cast<float>(x) * cell.per_x + static_cast<float>(y) * cell.per_y +
               static_cast<float>(layer) * cell.per_layer + 2.0f;
    };
    const __m128 along_x = _mm_mul_ps(_mm_set1_ps(cell.per_x), _mm_setr_ps(0.0f, 1.0f, 2.0f, 3.0f));
    const __m128 along_y = _mm_mul_ps(_mm_set1_ps(cell.per_y), _mm_setr_ps(0.0f, 1.0f, 2.0f, 2.0f));
    for (int layer = 0; layer < 3; ++layer) {
        for (int y = cell.first_y; y < cell.first_y + 3; ++y) {
            const int row = layer * stored + y, x = cell.first_x;
            std::int16_t* four = samples + row * stored + x;
            const __m128i before = _mm_cvtepi16_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(four)));
            const __m128i after = raise_four(before, _mm_add_ps(_mm_set1_ps(ceiling_at(x, y, layer)), along_x), [&] {
                return Four3{all(start.x[row]) + _mm256_loadu_pd(along.x + x), all(start.y[row]) + _mm256_loadu_pd(along.y + x),
                             all(start.z[row]) + _mm256_loadu_pd(along.z + x)};
            });
            _mm_storel_epi64(reinterpret_cast<__m128i*>(four), _mm_packs_epi32(after, after));
        }
        if (cell.last_x - cell.first_x < static_cast<int>(lanes)) continue;
        // The fifth of each row, three rows at a time and the last of them twice.
        const int row = layer * stored + cell.first_y, x = cell.last_x;
        std::int16_t *a = samples + row * stored + x, *b = a + stored, *c = b + stored;
        const __m128i after = raise_four(_mm_setr_epi32(*a, *b, *c, *c),
                                         _mm_add_ps(_mm_set1_ps(ceiling_at(x, cell.first_y, layer)), along_y), [&] {
            const auto rows = [&](const double* of) { return _mm256_setr_pd(of[row], of[row + 1], of[row + 2], of[row + 2]); };
            return Four3{rows(start.x) + all(along.x[x]), rows(start.y) + all(along.y[x]), rows(start.z) + all(along.z[x])};
        });
        *a = static_cast<std::int16_t>(_mm_extract_epi32(after, 0));
        *b = static_cast<std::int16_t>(_mm_extract_epi32(after, 1));
        *c = static_cast<std::int16_t>(_mm_extract_epi32(after, 2));
    }
    const auto across = [](__m128i four, auto better) {
        four = better(four, _mm_shuffle_epi32(four, _MM_SHUFFLE(1, 0, 3, 2)));
        return static_cast<std::int16_t>(_mm_cvtsi128_si32(better(four, _mm_shuffle_epi32(four, _MM_SHUFFLE(2, 3, 0, 1)))));
    };
    lowest = across(least_value, [](__m128i a, __m128i b) { return _mm_min_epi32(a, b); });
    highest = across(most_value, [](__m128i a, __m128i b) { return _mm_max_epi32(a, b); });
    return _mm_movemask_epi8(raised) != 0;
}

}  // namespace

constinit const BlockKernel avx2_kernel_table{
    .name = "avx2",
    .transform = transform,
    .locate = locate,
    .trilinear_int16 = trilinear_int16,
    .trilinear_float = trilinear_float,
    .gradient_int16 = gradient_int16,
    .unit = unit,
    .depths = depths,
    .tangents = tangents,
    .raise = raise,
};

}  // namespace kerf
