// SPDX-License-Identifier: Apache-2.0
// Four points at a time, eight in single precision, each with the operations of the portable kernel in the same order.
// Compiled with -mavx2 and called only where the processor has AVX2. Without fused multiply-add, which would round
// differently.
#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/field/grid/kernel/block_kernel.h"
#include "core/field/grid/kernel/surface_kernel.h"

namespace kerf {

extern const BlockKernel avx2_kernel_table;

namespace {

using Four = __m256d;
constexpr std::size_t lanes = 4;
constexpr int brick_bits = 3, stored = 9;  // of core/field/grid/grid.h: 8 samples a brick and axis, 9 with the apron

inline Four all(double v) noexcept { return _mm256_set1_pd(v); }
/// a < b ? a : b, also for NaN, as the instruction defines it.
inline Four min_of(Four a, Four b) noexcept { return _mm256_min_pd(a, b); }
/// a > b ? a : b.
inline Four max_of(Four a, Four b) noexcept { return _mm256_max_pd(a, b); }
inline Four less(Four a, Four b) noexcept { return _mm256_cmp_pd(a, b, _CMP_LT_OQ); }
inline Four not_less(Four a, Four b) noexcept { return _mm256_cmp_pd(a, b, _CMP_GE_OQ); }

struct Four3 {
    Four x, y, z;
};
inline Four3 all(const kerf_vec3& v) noexcept { return {all(v.x), all(v.y), all(v.z)}; }
inline Four3 cross(const Four3& a, const Four3& b) noexcept {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

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

/// Loads x, y and z of four consecutive points.
inline Four3 load_points(const double* p) noexcept {
    const auto two = [p](int low, int high) {
        return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(p + low)), _mm_loadu_pd(p + high), 1);
    };
    const Four a = two(0, 6), b = two(2, 8), c = two(4, 10);
    return {_mm256_shuffle_pd(a, b, 0b1010), _mm256_shuffle_pd(a, c, 0b0101), _mm256_shuffle_pd(b, c, 0b1010)};
}

/// The factors of a frame, each for four points.
struct FourFrame {
    Four3 x, y, z, origin;

    explicit FourFrame(const Frame& f) noexcept : x(all(f.x)), y(all(f.y)), z(all(f.z)), origin(all(f.origin)) {}
    Four3 operator*(const Four3& p) const noexcept {
        return {((x.x * p.x + y.x * p.y) + z.x * p.z) + origin.x, ((x.y * p.x + y.y * p.y) + z.y * p.z) + origin.y,
                ((x.z * p.x + y.z * p.y) + z.z * p.z) + origin.z};
    }
};

/// The points of a query, `step` at a time; the last step is filled up with copies of the last point.
template <std::size_t step>
class Steps {
public:
    Steps(const kerf_vec3* points, std::size_t count) noexcept : points_(points), whole_(count / step * step) {
        for (std::size_t n = 0; whole_ < count && n < step; ++n)
            tail_[n] = points[whole_ + n < count ? whole_ + n : count - 1];
    }
    const double* operator[](std::size_t i) const noexcept { return i < whole_ ? &points_[i].x : &tail_[0].x; }

private:
    const kerf_vec3* points_;
    std::size_t whole_;
    kerf_vec3 tail_[step];
};

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

using Eight = __m256;
using EightInts = __m256i;
constexpr std::size_t wide = 8;

inline Eight eight(float v) noexcept { return _mm256_set1_ps(v); }
inline Eight min_of(Eight a, Eight b) noexcept { return _mm256_min_ps(a, b); }
inline Eight max_of(Eight a, Eight b) noexcept { return _mm256_max_ps(a, b); }
inline Eight less(Eight a, Eight b) noexcept { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
inline Eight not_less(Eight a, Eight b) noexcept { return _mm256_cmp_ps(a, b, _CMP_GE_OQ); }
inline Eight same(Eight a, Eight b) noexcept { return _mm256_cmp_ps(a, b, _CMP_EQ_OQ); }
inline Eight minus(Eight a) noexcept { return _mm256_xor_ps(a, eight(-0.0f)); }
inline Eight magnitude(Eight a) noexcept { return _mm256_andnot_ps(eight(-0.0f), a); }
inline bool any(Eight mask) noexcept { return _mm256_movemask_ps(mask) != 0; }

inline EightInts together(__m128i low, __m128i high) noexcept {
    return _mm256_inserti128_si256(_mm256_castsi128_si256(low), high, 1);
}
inline EightInts all_ints(std::int32_t v) noexcept { return _mm256_set1_epi32(v); }

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

/// The first samples of the bricks of eight points. `are_uniform` and `are_all` test the first brick alone before all
/// of them: usually it fails already.
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

/// Two neighbours along x, for each of eight points: the lower one, and the difference to the upper one.
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

/// Returns the first sample of each brick, which usually is the same brick for all. Not inlined, so that none of its
/// work is scheduled before the branch is known.
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
    // First all values, then their conversion to metres: one pass took slightly longer.
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
        if (is_deep) {  // the result of the code below where the cut is never larger and is level
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

/// Returns the squared distance to the flat disc of a rim.
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

/// Returns the squared distance to the nearest point of the outline.
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
/// Returns the depth to the plane of the nearest face; in a convex solid an upper bound of the depth.
inline Four depth_of_planes(const OutlineShape& outline, Four r, Four z) noexcept {
    Four depth = min_of(z - all(outline.point[outline.count - 1].z), all(outline.point[0].z) - z);
    for (std::size_t n = 0; n + 1 < outline.count; ++n) depth = min_of(to_face(outline.segment[n], r, z), depth);
    return depth;
}
/// Returns the depth in a convex solid from that: equal inside and next to the face, less beyond its edges.
inline Four convex_depth(const OutlineShape& outline, Four r, Four z, Four depth) noexcept {
    const Four is_outside = less(depth, _mm256_setzero_pd());
    if (_mm256_movemask_pd(is_outside) == 0) return depth;
    const kerf_profile_point &front = outline.point[0], &back = outline.point[outline.count - 1];
    const auto same = [](Four a, Four b) { return _mm256_cmp_pd(a, b, _CMP_EQ_OQ); };
    Four is_next_to_face = _mm256_or_pd(_mm256_and_pd(same(all(front.z) - z, depth), not_less(all(front.radius), r)),
                                        _mm256_and_pd(same(z - all(back.z), depth), not_less(all(back.radius), r)));
    for (std::size_t n = 0; n + 1 < outline.count; ++n) {
        const kerf_profile_point& a = outline.point[n];
        const OutlineSegment& s = outline.segment[n];
        const Four along =
            ((r - all(a.radius)) * all(s.along_r) + (z - all(a.z)) * all(s.along_z)) * all(s.inverse_length2);
        const Four is_within = _mm256_and_pd(not_less(along, _mm256_setzero_pd()), not_less(all(1.0), along));
        is_next_to_face = _mm256_or_pd(is_next_to_face, _mm256_and_pd(same(to_face(s, r, z), depth), is_within));
    }
    const Four is_beyond = _mm256_andnot_pd(is_next_to_face, is_outside);
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

void depths(const OutlineShape& outline, std::size_t count, const ConstCoordinates& in_tool, double* depths) noexcept {
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

void tangents(const OutlineShape& outline, std::size_t count, const ConstCoordinates& in_tool, double* depths,
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
/// Returns the depth in a convex solid from the depth to the nearest plane.
inline Eight depth_from(const SingleOutline& o, Eight r, Eight z, Eight depth) noexcept {
    const Eight zero = _mm256_setzero_ps(), is_outside = less(depth, zero);
    Eight is_next_to_face =
        _mm256_or_ps(_mm256_and_ps(same(eight(o.front_z) - z, depth), not_less(eight(o.front_radius), r)),
                     _mm256_and_ps(same(z - eight(o.back_z), depth), not_less(eight(o.back_radius), r)));
    for (std::size_t n = 0; n < o.count; ++n) {
        const OutlineFace& f = o.face[n];
        const Eight along =
            ((r - eight(f.radius)) * eight(f.along_r) + (z - eight(f.z)) * eight(f.along_z)) * eight(f.inverse_length2);
        const Eight is_within = _mm256_and_ps(not_less(along, zero), not_less(eight(1.0f), along));
        is_next_to_face = _mm256_or_ps(is_next_to_face, _mm256_and_ps(same(to_face(f, r, z), depth), is_within));
    }
    const Eight is_beyond = _mm256_andnot_ps(is_next_to_face, is_outside);
    if (!any(is_beyond)) return depth;
    return _mm256_blendv_ps(depth, min_of(minus(_mm256_sqrt_ps(squared_distance(o, r, z))), depth), is_beyond);
}

struct EightPoints {
    Eight x, y, z;
};
inline Eight radius_of(const SingleOutline& o, const EightPoints& p) noexcept {
    return o.half_thickness > 0.0f ? magnitude(p.x) : _mm256_sqrt_ps(p.x * p.x + p.y * p.y);
}
/// Returns the bound for a solid of revolution or a prism, with `r` from `radius_of` and `y` across a prism.
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

void deepest(const SingleOutline& outline, const SingleFrame* solid_from_points, std::size_t solids, std::size_t count,
             const kerf_vec3* points, const Walls& walls) noexcept {
    const Steps<wide> steps(points, count);
    for (std::size_t i = 0; i < count; i += wide) {
        const Four3 a = load_points(steps[i]), b = load_points(steps[i] + 3 * lanes);
        const auto single = [](Four low, Four high) {
            return _mm256_set_m128(_mm256_cvtpd_ps(high), _mm256_cvtpd_ps(low));
        };
        const EightPoints at{single(a.x, b.x), single(a.y, b.y), single(a.z, b.z)};
        Eight best = _mm256_loadu_ps(walls.depth + i),
              which = _mm256_loadu_ps(reinterpret_cast<const float*>(walls.which + i));
        EightPoints inward{_mm256_loadu_ps(walls.x + i), _mm256_loadu_ps(walls.y + i), _mm256_loadu_ps(walls.z + i)};
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
            const EightPoints inward_here = turned_back(frame, inward_direction(outline, p, r));
            best = _mm256_blendv_ps(best, depth, is_deeper);
            which = _mm256_blendv_ps(which, _mm256_castsi256_ps(all_ints(static_cast<std::int32_t>(n))), is_deeper);
            inward = {_mm256_blendv_ps(inward.x, inward_here.x, is_deeper),
                      _mm256_blendv_ps(inward.y, inward_here.y, is_deeper),
                      _mm256_blendv_ps(inward.z, inward_here.z, is_deeper)};
        }
        _mm256_storeu_ps(walls.depth + i, best);
        _mm256_storeu_ps(reinterpret_cast<float*>(walls.which + i), which);
        _mm256_storeu_ps(walls.x + i, inward.x);
        _mm256_storeu_ps(walls.y + i, inward.y);
        _mm256_storeu_ps(walls.z + i, inward.z);
    }
}

/// Returns the nearest quantum, the even one of two, clamped to ± 32767.
inline EightInts quantised(Eight depth, Eight per_quantum) noexcept {
    const Eight q = depth * per_quantum;
    return _mm256_cvtps_epi32(max_of(min_of(q, eight(32767.0f)), eight(-32767.0f)));
}

// The 27 samples of a cell's layer are contiguous: four steps, of which the last repeats five samples.
constexpr int steps_of_layer = 4, step_start[steps_of_layer] = {0, 8, 16, 19};
struct LaneOffsets {
    float x[steps_of_layer][wide], y[steps_of_layer][wide];

    constexpr LaneOffsets() noexcept : x{}, y{} {
        for (int n = 0; n < steps_of_layer; ++n)
            for (int lane = 0; lane < static_cast<int>(wide); ++lane) {
                x[n][lane] = static_cast<float>((step_start[n] + lane) % stored);
                y[n][lane] = static_cast<float>((step_start[n] + lane) / stored);
            }
    }
};
alignas(32) constexpr LaneOffsets lane_offsets;

bool raise(const SingleOutline& outline, const SampleCell& cell, float band, float per_quantum, std::int16_t* samples,
           std::int16_t& lowest, std::int16_t& highest, std::int16_t* spare) noexcept {
    // In passes over the whole cell: a branch at each step, on whether any sample rises, would be mispredicted too
    // often.
    constexpr int steps = 3 * steps_of_layer;
    const Eight farthest = eight(-band), scale = eight(per_quantum), zero = _mm256_setzero_ps();
    const auto& along = cell.along;
    const auto step_at = [&](int n) {
        return reinterpret_cast<__m128i*>(samples + n / steps_of_layer * stored * stored +
                                          step_start[n % steps_of_layer]);
    };
    Eight radius[steps], across[steps], height[steps], depth[steps], may_rise = zero, may_rise_outside = zero;
    EightInts before[steps], value[steps];
    EightPoints up[3];
    for (int layer = 0; layer < 3; ++layer) {
        const Eight k = eight(cell.first[2] + static_cast<float>(layer));
        up[layer] = {k * eight(along[2][0]), k * eight(along[2][1]), k * eight(along[2][2])};
    }
    for (int n = 0; n < steps_of_layer; ++n) {
        const Eight i = eight(cell.first[0]) + _mm256_loadu_ps(lane_offsets.x[n]),
                    j = eight(cell.first[1]) + _mm256_loadu_ps(lane_offsets.y[n]);
        const auto row = [&](int axis) {
            return (eight(cell.origin[axis]) + i * eight(along[0][axis])) + j * eight(along[1][axis]);
        };
        const EightPoints start{row(0), row(1), row(2)};
        for (int layer = 0; layer < 3; ++layer) {
            const int at = layer * steps_of_layer + n;
            const Eight x = start.x + up[layer].x, y = start.y + up[layer].y, z = start.z + up[layer].z;
            radius[at] = radius_of(outline, {x, y, z});
            across[at] = y;
            height[at] = z;
        }
    }
    const auto rises = [&](int n) {
        return _mm256_and_ps(_mm256_castsi256_ps(_mm256_cmpgt_epi32(value[n], before[n])),
                             not_less(depth[n], farthest));
    };
    for (int n = 0; n < steps; ++n) {
        before[n] = _mm256_cvtepi16_epi32(_mm_loadu_si128(step_at(n)));
        depth[n] = depth_at_most(outline, radius[n], across[n], height[n]);
        value[n] = quantised(depth[n], scale);
        const Eight rises_here = rises(n);
        may_rise = _mm256_or_ps(may_rise, rises_here);
        may_rise_outside = _mm256_or_ps(may_rise_outside, _mm256_and_ps(rises_here, less(depth[n], zero)));
    }
    const auto find_spare = [&] {
        if (spare == nullptr) return;
        const EightInts full = all_ints(32767), end_of_band = all_ints(static_cast<std::int32_t>(-band * per_quantum));
        EightInts min_spare = full;
        for (int n = 0; n < steps; ++n) {
            const EightInts here = _mm256_sub_epi32(_mm256_max_epi32(before[n], end_of_band), value[n]);
            min_spare =
                _mm256_min_epi32(min_spare, _mm256_blendv_epi8(here, full, _mm256_cmpeq_epi32(before[n], full)));
        }
        std::int32_t each[wide];
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(each), min_spare);
        std::int32_t min_of = 32767;
        for (const std::int32_t one : each) min_of = one < min_of ? one : min_of;
        *spare = static_cast<std::int16_t>(min_of < 0 ? 0 : min_of);
    };
    if (!any(may_rise)) {
        find_spare();
        return false;
    }
    if (outline.is_convex && cell.has_edges && any(may_rise_outside))
        for (int n = 0; n < steps; ++n) {
            // A sample that the planes do not raise does not rise, and inside there is nothing to correct.
            if (!any(_mm256_and_ps(rises(n), less(depth[n], zero)))) continue;
            depth[n] = depth_from(outline, radius[n], across[n], height[n], depth[n]);
            value[n] = quantised(depth[n], scale);
        }
    __m128i min_value = _mm_set1_epi16(32767), max_value = _mm_set1_epi16(-32767);
    Eight is_raised = zero;
    for (int n = 0; n < steps; ++n) {
        const Eight rises_here = rises(n);
        is_raised = _mm256_or_ps(is_raised, rises_here);
        const EightInts raised = _mm256_blendv_epi8(before[n], value[n], _mm256_castps_si256(rises_here));
        const __m128i after = _mm_packs_epi32(_mm256_castsi256_si128(raised), _mm256_extracti128_si256(raised, 1));
        _mm_storeu_si128(step_at(n), after);
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
    if (!any(is_raised)) {
        find_spare();
        return false;
    }
    if (spare != nullptr) *spare = 0;
    return true;
}

void find(const std::int16_t* samples, std::int16_t low, std::int16_t high, std::uint32_t (&found)[3]) noexcept {
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
    .depths = depths,
    .tangents = tangents,
    .deepest = deepest,
    .raise = raise,
    .find = find,
    .larger_rows = avx2::larger_rows,
    .larger_border = avx2::larger_border,
    .crossings = avx2::crossings,
};

}  // namespace kerf
