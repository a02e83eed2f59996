// SPDX-License-Identifier: Apache-2.0
// Four points at a time, eight in single precision, each with the operations of the portable kernel in the same order.
// Compiled with -mavx2, and called only if the processor has AVX2. Compiled without fused multiply-add, which would
// round differently.
#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/field/grid/kernel/avx2_lanes.h"
#include "core/field/grid/kernel/block_kernel.h"
#include "core/field/grid/kernel/outline_kernel.h"
#include "core/field/grid/kernel/surface_kernel.h"

namespace kerf {

extern const BlockKernel avx2_kernel_table;

namespace {

void transform(const kerf_pose& a_from_b, std::size_t count, const ConstCoordinates& in_b,
               const Coordinates& in_a) noexcept {
    const Four3 position = all(a_from_b.position);
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

void move(const Frame& a_from_b, std::size_t count, const kerf_vec3* in_b, const Coordinates& in_a) noexcept {
    const FourFrame frame(a_from_b);
    const Steps<lanes> points(in_b, count);
    for (std::size_t i = 0; i < count; i += lanes) {
        const Four3 p = frame * load_points(points[i]);
        _mm256_storeu_pd(in_a.x + i, p.x);
        _mm256_storeu_pd(in_a.y + i, p.y);
        _mm256_storeu_pd(in_a.z + i, p.z);
    }
}

template <bool is_bounded, bool is_turned, bool wants_box>
void place_in(const Frame& fixed_from_points, const Lattice& grid, std::size_t count, const kerf_vec3* points,
              const LocatedArrays& to, PointBox* box) noexcept {
    const LocatedArrays places = to;
    const FourFrame frame(fixed_from_points);
    const Four3 low{all(grid.low[0]), all(grid.low[1]), all(grid.low[2])},
        high{all(grid.high[0]), all(grid.high[1]), all(grid.high[2])};
    // As unsigned numbers, NaN, negative and too large coordinates all exceed the last one inside.
    const auto last = [&](int axis) { return all_ints(static_cast<std::int32_t>(grid.end[axis] - 1)); };
    const EightInts last_x = last(0), last_y = last(1), last_z = last(2);
    const EightInts behind = all_ints((1 << grid.bits) - 1), row = all_ints(grid.row), layer = all_ints(grid.layer),
                    outside = all_ints(grid.brick_count);
    const __m128i bits = _mm_cvtsi32_si128(grid.bits), brick_of = _mm_cvtsi32_si128(grid.bits + brick_bits);
    const EightInts within = all_ints((1 << brick_bits) - 1), rows = all_ints(stored * stored | stored << 16);
    const Eight unit = _mm256_set1_ps(1.0f / static_cast<float>(1 << grid.bits));
    constexpr double far = std::numeric_limits<double>::infinity();
    Four3 min_point{all(far), all(far), all(far)}, max_point{all(-far), all(-far), all(-far)};

    struct Fixed {
        __m128i x, y, z;
    };
    const auto fixed = [&](const double* from) -> Fixed {
        const Four3 p = load_points(from);
        if constexpr (wants_box) {
            min_point = {min_of(p.x, min_point.x), min_of(p.y, min_point.y), min_of(p.z, min_point.z)};
            max_point = {max_of(p.x, max_point.x), max_of(p.y, max_point.y), max_of(p.z, max_point.z)};
        }
        Four3 g;
        if constexpr (is_turned)
            g = frame * p;
        else  // the products with zero change nothing
            g = {frame.x.x * p.x + frame.origin.x, frame.y.y * p.y + frame.origin.y, frame.z.z * p.z + frame.origin.z};
        if constexpr (is_bounded)
            g = {min_of(high.x, max_of(low.x, g.x)), min_of(high.y, max_of(low.y, g.y)),
                 min_of(high.z, max_of(low.z, g.z))};
        return {_mm256_cvttpd_epi32(g.x), _mm256_cvttpd_epi32(g.y), _mm256_cvttpd_epi32(g.z)};
    };
    const Steps<wide> steps(points, count);
    for (std::size_t n = 0; n < count; n += wide) {
        const double* from = steps[n];
        const Fixed a = fixed(from), b = fixed(from + 3 * lanes);
        EightInts x = together(a.x, b.x), y = together(a.y, b.y), z = together(a.z, b.z);
        const auto is_within = [](EightInts v, EightInts max_of) {
            return _mm256_cmpeq_epi32(_mm256_min_epu32(v, max_of), v);
        };
        const EightInts is_inside =
            _mm256_and_si256(is_within(x, last_x), _mm256_and_si256(is_within(y, last_y), is_within(z, last_z)));
        const EightInts bi = _mm256_srl_epi32(x, brick_of), bj = _mm256_srl_epi32(y, brick_of),
                        bk = _mm256_srl_epi32(z, brick_of);
        const EightInts brick =
            _mm256_add_epi32(_mm256_add_epi32(_mm256_mullo_epi32(bk, layer), _mm256_mullo_epi32(bj, row)), bi);
        _mm256_storeu_si256(reinterpret_cast<EightInts*>(places.brick + n),
                            _mm256_blendv_epi8(outside, brick, is_inside));
        const EightInts oi = _mm256_and_si256(_mm256_srl_epi32(x, bits), within),
                        oj = _mm256_and_si256(_mm256_srl_epi32(y, bits), within),
                        ok = _mm256_and_si256(_mm256_srl_epi32(z, bits), within);
        // (k · 9 + j) · 9 + i: products and sum in one instruction
        const EightInts kj = _mm256_or_si256(ok, _mm256_slli_epi32(oj, 16));
        _mm256_storeu_si256(reinterpret_cast<EightInts*>(places.offset + n),
                            _mm256_add_epi32(_mm256_madd_epi16(kj, rows), oi));
        const auto fraction = [&](EightInts v) { return _mm256_cvtepi32_ps(_mm256_and_si256(v, behind)) * unit; };
        _mm256_storeu_ps(places.x + n, fraction(x));
        _mm256_storeu_ps(places.y + n, fraction(y));
        _mm256_storeu_ps(places.z + n, fraction(z));
    }

    if constexpr (!wants_box) return;
    const auto across = [](Four v, auto better) {
        double each[lanes];
        _mm256_storeu_pd(each, v);
        return better(better(each[0], each[1]), better(each[2], each[3]));
    };
    const auto smaller = [](double a, double b) { return a < b ? a : b; };
    const auto larger = [](double a, double b) { return a > b ? a : b; };
    *box = {{across(min_point.x, smaller), across(min_point.y, smaller), across(min_point.z, smaller)},
            {across(max_point.x, larger), across(max_point.y, larger), across(max_point.z, larger)}};
}

void place(const Frame& fixed_from_points, const Lattice& grid, std::size_t count, const kerf_vec3* points,
           const LocatedArrays& places, PointBox* box) noexcept {
    const Frame& f = fixed_from_points;
    const bool is_turned = f.x.y != 0.0 || f.x.z != 0.0 || f.y.x != 0.0 || f.y.z != 0.0 || f.z.x != 0.0 || f.z.y != 0.0;
    const auto place_there = [&]<bool wants_box>() {
        // Clamping to the region makes an infinite coordinate finite: then the products with zero matter.
        const auto there = grid.is_bounded ? place_in<true, true, wants_box>
                           : is_turned     ? place_in<false, true, wants_box>
                                           : place_in<false, false, wants_box>;
        there(f, grid, count, points, places, box);
    };
    if (box != nullptr)
        place_there.template operator()<true>();
    else
        place_there.template operator()<false>();
}

/// The first samples of the bricks of eight points. `are_uniform` and `are_all` first test the first brick alone, as it
/// usually decides.
struct Starts {
    std::int32_t of[wide];

    [[gnu::always_inline]] Starts(const std::int32_t* start, const ConstLocatedArrays& places, std::size_t i) noexcept {
        for (std::size_t n = 0; n < wide; ++n) of[n] = start[places.brick[i + n]];
    }
    /// Returns whether all of them begin before `first_stored`: all bricks are uniform.
    [[nodiscard, gnu::always_inline]] bool are_uniform(std::int32_t first_stored) const noexcept {
        return of[0] < first_stored && any() < first_stored;
    }
    [[nodiscard, gnu::always_inline]] bool are_all(std::int32_t start) const noexcept {
        return of[0] == start && any() == start && common() == start;
    }
    [[nodiscard]] bool is_any_missing() const noexcept { return any() < 0; }
    [[nodiscard]] bool are_all_missing() const noexcept { return common() < 0; }

private:
    /// Returns the bitwise or of all first samples, or their bitwise and.
    [[nodiscard, gnu::always_inline]] std::int32_t any() const noexcept {
        std::int32_t bits = 0;
        for (const std::int32_t each : of) bits |= each;
        return bits;
    }
    [[nodiscard, gnu::always_inline]] std::int32_t common() const noexcept {
        std::int32_t bits = -1;
        for (const std::int32_t each : of) bits &= each;
        return bits;
    }
};

/// The low corners of eight cells. Samples at corners are loaded cell by cell: gathers of eight take longer.
template <class Sample>
class Cells {
public:
    [[gnu::always_inline]] Cells(const Sample* samples, const Starts& starts, const ConstLocatedArrays& places,
                                 std::size_t i) noexcept {
        for (std::size_t n = 0; n < wide; ++n)
            corner_[n] = samples + static_cast<std::uint32_t>(starts.of[n] + places.offset[i + n]);
    }
    [[nodiscard]] const Sample* operator[](std::size_t n) const noexcept { return corner_[n]; }

private:
    const Sample* corner_[wide];
};

/// Two samples next to each other along x, for each of eight points: the lower one, and the upper one minus the lower.
struct Pairs {
    Eight low, rise;
};
/// The two rows of each cell along y.
struct Rows {
    Pairs first, second;
};
/// Converts two samples per lane. Their difference is exact both as integer and as float.
inline Pairs pairs_of(EightInts both) noexcept {
    const EightInts lower = all_ints(1), difference = all_ints(0x1ffff);  // (1, 0) and (−1, 1)
    return {_mm256_cvtepi32_ps(_mm256_madd_epi16(both, lower)),
            _mm256_cvtepi32_ps(_mm256_madd_epi16(both, difference))};
}
/// Loads both rows of each cell with one load of sixteen samples: one row begins at the first sample of the low half,
/// the other, nine samples later, at the second of the high half.
[[gnu::always_inline]] inline Rows load_rows(const Cells<std::int16_t>& cells, int offset) noexcept {
    const EightInts to_pairs = _mm256_setr_epi8(0, 1, 4, 5, 2, 3, 6, 7, -1, -1, -1, -1, -1, -1, -1, -1,  //
                                                4, 5, 8, 9, 6, 7, 10, 11, -1, -1, -1, -1, -1, -1, -1, -1);
    const auto load = [&](std::size_t n) {
        return _mm256_loadu_si256(reinterpret_cast<const EightInts*>(cells[n] + offset));
    };
    const auto two = [&](std::size_t n) {
        return _mm256_shuffle_epi8(_mm256_unpacklo_epi16(load(n), load(n + 1)), to_pairs);
    };
    const EightInts low = _mm256_unpacklo_epi64(two(0), two(2)), high = _mm256_unpacklo_epi64(two(4), two(6));
    return {pairs_of(_mm256_permute2x128_si256(low, high, 0x20)), pairs_of(_mm256_permute2x128_si256(low, high, 0x31))};
}
[[gnu::always_inline]] inline Pairs load_pairs(const Cells<float>& cells, int offset) noexcept {
    const auto pair = [&](std::size_t n) { return reinterpret_cast<const __m64*>(cells[n] + offset); };
    const auto two = [&](std::size_t n) { return _mm_loadh_pi(_mm_loadl_pi(_mm_setzero_ps(), pair(n)), pair(n + 1)); };
    const Eight a = _mm256_set_m128(two(lanes), two(0)), b = _mm256_set_m128(two(lanes + 2), two(2));
    const Eight low = _mm256_shuffle_ps(a, b, _MM_SHUFFLE(2, 0, 2, 0));
    return {low, _mm256_shuffle_ps(a, b, _MM_SHUFFLE(3, 1, 3, 1)) - low};
}
[[gnu::always_inline]] inline Rows load_rows(const Cells<float>& cells, int offset) noexcept {
    return {load_pairs(cells, offset), load_pairs(cells, offset + stored)};
}

inline Eight lerp(Eight a, Eight b, Eight t) noexcept { return a + (b - a) * t; }

struct EightFractions {
    Eight x, y, z;

    EightFractions(const ConstLocatedArrays& places, std::size_t i) noexcept
        : x(_mm256_loadu_ps(places.x + i)), y(_mm256_loadu_ps(places.y + i)), z(_mm256_loadu_ps(places.z + i)) {}
};
template <class Sample>
[[gnu::always_inline]] inline Eight interpolated(const Cells<Sample>& cells, const EightFractions& f) noexcept {
    const Rows below = load_rows(cells, 0), above = load_rows(cells, stored * stored);
    const auto along_x = [&](const Pairs& p) { return p.low + p.rise * f.x; };
    return lerp(lerp(along_x(below.first), along_x(below.second), f.y),
                lerp(along_x(above.first), along_x(above.second), f.y), f.z);
}

/// Returns the value of each point's uniform brick, which is usually the same brick for all points. Not inlined, so
/// that none of its work is scheduled before the branch is known.
[[gnu::noinline]] Eight uniform_values(const FieldShape& field, const ConstLocatedArrays& places,
                                       std::size_t i) noexcept {
    const Starts starts(field.start, places, i);
    const auto first = [&](std::size_t n) { return static_cast<float>(field.samples[starts.of[n]]); };
    if (starts.are_all(starts.of[0])) return eight(first(0));
    return _mm256_setr_ps(first(0), first(1), first(2), first(3), first(4), first(5), first(6), first(7));
}

[[gnu::always_inline]] inline Eight values_of(const FieldShape& field, const ConstLocatedArrays& places,
                                              std::size_t i) noexcept {
    const Starts starts(field.start, places, i);
    if (starts.are_uniform(field.first_stored)) return uniform_values(field, places, i);
    return interpolated(Cells(field.samples, starts, places, i), EightFractions(places, i));
}

void values(const FieldShape& shape, std::size_t count, const ConstLocatedArrays& places, float* values) noexcept {
    const FieldShape field = shape;  // a copy: stores through `values` cannot change it
    for (std::size_t i = 0; i < count; i += wide) _mm256_storeu_ps(values + i, values_of(field, places, i));
}

/// Converts [quanta] to [m]; exact at both ends of the range.
struct Metres {
    Four low, high;

    Metres(Eight quanta, Four quantum, Four clamp) noexcept
        : low(quantum * _mm256_cvtps_pd(_mm256_castps256_ps128(quanta))),
          high(quantum * _mm256_cvtps_pd(_mm256_extractf128_ps(quanta, 1))) {
        if (!any(not_less(magnitude(quanta), _mm256_set1_ps(32767.0f)))) return;
        low = with_ends(low, _mm256_castps256_ps128(quanta), clamp);
        high = with_ends(high, _mm256_extractf128_ps(quanta, 1), clamp);
    }

private:
    static Four with_ends(Four metres, __m128 quanta, Four clamp) noexcept {
        const Four q = _mm256_cvtps_pd(quanta), sign = _mm256_and_pd(q, all(-0.0));
        const Four is_end = not_less(_mm256_andnot_pd(all(-0.0), q), all(32767.0));
        return _mm256_blendv_pd(metres, _mm256_or_pd(clamp, sign), is_end);
    }
};

void metres(const FieldShape& shape, std::size_t count, const ConstLocatedArrays& places, double quantum, double clamp,
            double* values) noexcept {
    const FieldShape field = shape;
    // First all values, then their conversion to metres: a single pass takes slightly longer.
    constexpr std::size_t stretch = 64;
    alignas(32) float quanta[stretch];
    for (std::size_t first = 0; first < count; first += stretch) {
        const std::size_t n = count - first < stretch ? count - first : stretch;
        for (std::size_t i = 0; i < n; i += wide) _mm256_store_ps(quanta + i, values_of(field, places, first + i));
        for (std::size_t i = 0; i < n; i += wide) {
            const Metres m(_mm256_load_ps(quanta + i), all(quantum), all(clamp));
            _mm256_storeu_pd(values + first + i, m.low);
            _mm256_storeu_pd(values + first + i + lanes, m.high);
        }
    }
}

void densities(const std::int32_t* start, const float* samples, std::size_t count, const ConstLocatedArrays& places,
               float elsewhere, float* values) noexcept {
    for (std::size_t i = 0; i < count; i += wide) {
        Starts starts(start, places, i);
        if (starts.are_all_missing()) {
            _mm256_storeu_ps(values + i, eight(elsewhere));
            continue;
        }
        const bool is_any_missing = starts.is_any_missing();
        if (is_any_missing)
            for (std::int32_t& from : starts.of) from = from < 0 ? 0 : from;
        _mm256_storeu_ps(values + i, interpolated(Cells(samples, starts, places, i), EightFractions(places, i)));
        if (!is_any_missing) continue;
        for (std::size_t n = i; n < i + wide; ++n) values[n] = start[places.brick[n]] < 0 ? elsewhere : values[n];
    }
}

struct EightSlopes {
    Eight value, x, y, z;
};
[[gnu::always_inline]] inline EightSlopes slopes_of(const FieldShape& field, const ConstLocatedArrays& places,
                                                    std::size_t i, const EightFractions& f) noexcept {
    const Starts starts(field.start, places, i);
    if (starts.are_uniform(field.first_stored)) {
        const Eight zero = _mm256_setzero_ps();
        return {uniform_values(field, places, i), zero, zero, zero};
    }
    const Cells cells(field.samples, starts, places, i);
    const auto [v00, v10] = load_rows(cells, 0);
    const auto [v01, v11] = load_rows(cells, stored * stored);
    const Eight c00 = v00.low + v00.rise * f.x, c10 = v10.low + v10.rise * f.x, c01 = v01.low + v01.rise * f.x,
                c11 = v11.low + v11.rise * f.x;
    const Eight y0 = c10 - c00, y1 = c11 - c01;
    const Eight c0 = c00 + y0 * f.y, c1 = c01 + y1 * f.y;
    return {c0 + (c1 - c0) * f.z, lerp(lerp(v00.rise, v10.rise, f.y), lerp(v01.rise, v11.rise, f.y), f.z),
            lerp(y0, y1, f.z), c1 - c0};
}

float slopes(const FieldShape& bone_shape, const FieldShape& cut_shape, std::size_t count,
             const ConstLocatedArrays& places, const Slopes& larger) noexcept {
    const FieldShape bone = bone_shape, cut = cut_shape;
    Eight min_of = _mm256_set1_ps(32767.0f);
    for (std::size_t i = 0; i < count; i += wide) {
        const EightFractions f(places, i);
        const bool is_deep = Starts(bone.start, places, i).are_all(bone.lowest);
        EightSlopes found = slopes_of(cut, places, i, f);
        if (is_deep) {  // bone is −32767 and level: as the code below, without reading it
            const Eight is_cut = less(eight(-32767.0f), found.value);
            found = {found.value, _mm256_and_ps(found.x, is_cut), _mm256_and_ps(found.y, is_cut),
                     _mm256_and_ps(found.z, is_cut)};
        } else {
            const EightSlopes a = slopes_of(bone, places, i, f);
            const Eight is_cut = less(a.value, found.value);
            found = {_mm256_blendv_ps(a.value, found.value, is_cut), _mm256_blendv_ps(a.x, found.x, is_cut),
                     _mm256_blendv_ps(a.y, found.y, is_cut), _mm256_blendv_ps(a.z, found.z, is_cut)};
        }
        _mm256_storeu_ps(larger.value + i, found.value);
        _mm256_storeu_ps(larger.x + i, found.x);
        _mm256_storeu_ps(larger.y + i, found.y);
        _mm256_storeu_ps(larger.z + i, found.z);
        min_of = _mm256_min_ps(found.value, min_of);
    }
    float each[wide], min_of_all = 32767.0f;
    _mm256_storeu_ps(each, min_of);
    for (const float v : each) min_of_all = v < min_of_all ? v : min_of_all;
    return min_of_all;
}

/// Transposes four columns of four into rows.
struct FourRows {
    Four row[lanes];

    FourRows(Four a, Four b, Four c, Four d) noexcept {
        const Four ab = _mm256_unpacklo_pd(a, b), ab_next = _mm256_unpackhi_pd(a, b), cd = _mm256_unpacklo_pd(c, d),
                   cd_next = _mm256_unpackhi_pd(c, d);
        row[0] = _mm256_permute2f128_pd(ab, cd, 0x20);
        row[1] = _mm256_permute2f128_pd(ab_next, cd_next, 0x20);
        row[2] = _mm256_permute2f128_pd(ab, cd, 0x31);
        row[3] = _mm256_permute2f128_pd(ab_next, cd_next, 0x31);
    }
};

/// Stores four answers from their distances, normals and bodies; each coordinate has all four answers.
inline void put_answers(Four distance, __m128 x, __m128 y, __m128 z, Four is_near, kerf_surface_point* to) noexcept {
    static_assert(sizeof(kerf_surface_point) == 5 * sizeof(double) &&
                  offsetof(kerf_surface_point, body) == 4 * sizeof(double));
    const FourRows by_point(distance, _mm256_cvtps_pd(x), _mm256_cvtps_pd(y), _mm256_cvtps_pd(z));
    // Body −1, followed by a zero.
    const __m256i body = _mm256_andnot_si256(_mm256_castpd_si256(is_near), _mm256_set1_epi64x(0xffffffff));
    double* at = &to->distance;
    for (std::size_t n = 0; n < lanes; ++n) _mm256_storeu_pd(at + 5 * n, by_point.row[n]);
    const __m128d first = _mm_castsi128_pd(_mm256_castsi256_si128(body)),
                  second = _mm_castsi128_pd(_mm256_extracti128_si256(body, 1));
    _mm_storel_pd(at + 4, first);
    _mm_storeh_pd(at + 9, first);
    _mm_storel_pd(at + 14, second);
    _mm_storeh_pd(at + 19, second);
}

void answer(const Surface& surface, std::size_t count, const ConstSlopes& slopes,
            kerf_surface_point* answers) noexcept {
    Eight in_tool[3][3];
    for (int axis = 0; axis < 3; ++axis)
        for (int n = 0; n < 3; ++n) in_tool[axis][n] = _mm256_set1_ps(surface.in_tool[axis][n]);
    const Four quantum = all(surface.quantum), clamp = all(surface.clamp);
    const Eight zero = _mm256_setzero_ps(), one = _mm256_set1_ps(1.0f), end = _mm256_set1_ps(32767.0f);
    for (std::size_t i = 0; i < count; i += wide) {
        const Eight v = _mm256_loadu_ps(slopes.value + i), x = _mm256_loadu_ps(slopes.x + i),
                    y = _mm256_loadu_ps(slopes.y + i), z = _mm256_loadu_ps(slopes.z + i);
        const Eight length = _mm256_sqrt_ps((x * x + y * y) + z * z);
        const Eight is_near =
            _mm256_and_ps(_mm256_cmp_ps(v, end, _CMP_LT_OQ), _mm256_cmp_ps(v, zero - end, _CMP_GT_OQ));
        const Eight has_normal = _mm256_and_ps(is_near, _mm256_cmp_ps(length, zero, _CMP_GT_OQ));
        const Eight to_unit = _mm256_and_ps(one / length, has_normal);
        const Eight nx = x * to_unit, ny = y * to_unit, nz = z * to_unit;
        const auto along = [&](int n) { return (in_tool[0][n] * nx + in_tool[1][n] * ny) + in_tool[2][n] * nz; };
        const Eight tx = along(0), ty = along(1), tz = along(2);
        const Metres distance(v, quantum, clamp);
        const __m256i near = _mm256_castps_si256(is_near);
        const Four near_low = _mm256_castsi256_pd(_mm256_cvtepi32_epi64(_mm256_castsi256_si128(near)));
        const Four near_high = _mm256_castsi256_pd(_mm256_cvtepi32_epi64(_mm256_extracti128_si256(near, 1)));
        const auto low = [](Eight e) { return _mm256_castps256_ps128(e); };
        const auto high = [](Eight e) { return _mm256_extractf128_ps(e, 1); };
        kerf_surface_point last[wide];
        const bool fits = i + wide <= count;
        kerf_surface_point* to = fits ? answers + i : last;
        put_answers(distance.low, low(tx), low(ty), low(tz), near_low, to);
        put_answers(distance.high, high(tx), high(ty), high(tz), near_high, to + lanes);
        if (!fits) std::memcpy(answers + i, last, (count - i) * sizeof last[0]);
    }
}

/// Stores four rows from element `i` of the columns on.
inline void put_rows(const SampleColumns& from, std::size_t i, kerf_bone_sample* to) noexcept {
    static_assert(KERF_MAX_TISSUES == 4 && sizeof(kerf_bone_sample) == 11 * sizeof(double) &&
                  offsetof(kerf_bone_sample, body) == 10 * sizeof(double));
    const auto column = [&](const float* values, std::size_t tissue) {
        return tissue < from.tissues ? _mm256_cvtps_pd(_mm_loadu_ps(values + tissue * from.stride + i))
                                     : _mm256_setzero_pd();
    };
    const FourRows first(_mm256_cvtps_pd(_mm_loadu_ps(from.engagement + i)), _mm256_loadu_pd(from.gap + i),
                         column(from.weight, 0), column(from.weight, 1));
    const FourRows second(column(from.weight, 2), column(from.weight, 3), column(from.density, 0),
                          column(from.density, 1));
    const Four d2 = column(from.density, 2), d3 = column(from.density, 3), even = _mm256_unpacklo_pd(d2, d3),
               odd = _mm256_unpackhi_pd(d2, d3);
    const __m128d third[lanes] = {_mm256_castpd256_pd128(even), _mm256_castpd256_pd128(odd),
                                  _mm256_extractf128_pd(even, 1), _mm256_extractf128_pd(odd, 1)};
    for (std::size_t n = 0; n < lanes; ++n) {
        double* at = &to[n].engagement;
        _mm256_storeu_pd(at, first.row[n]);
        _mm256_storeu_pd(at + 4, second.row[n]);
        _mm_storeu_pd(at + 8, third[n]);
        to[n].body = from.body;
        to[n].reserved = 0;
    }
}

void rows(const SampleColumns& columns, std::size_t count, kerf_bone_sample* samples) noexcept {
    const SampleColumns from = columns;
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) put_rows(from, i, samples + i);
    if (i == count) return;
    kerf_bone_sample last[lanes];
    put_rows(from, i, last);
    std::memcpy(samples + i, last, (count - i) * sizeof last[0]);
}

}  // namespace

constinit const BlockKernel avx2_kernel_table{
    .name = "avx2",
    .transform = transform,
    .move = move,
    .place = place,
    .values = values,
    .metres = metres,
    .densities = densities,
    .slopes = slopes,
    .answer = answer,
    .rows = rows,
    .depths = avx2::depths,
    .tangents = avx2::tangents,
    .deepest = avx2::deepest,
    .raise = avx2::raise,
    .find = avx2::find,
    .larger_rows = avx2::larger_rows,
    .larger_border = avx2::larger_border,
    .crossings = avx2::crossings,
};

}  // namespace kerf
