// SPDX-License-Identifier: Apache-2.0
// One row of a brick or eight vertices at a time, with the operations of the portable stages in the same order.
// Compiled and called as block_kernel_avx2.cpp.
#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#include "core/field/grid/kernel/surface_kernel.h"

namespace kerf::avx2 {

namespace {

constexpr int stored_row = 9, stored_layer = 81;  // of core/field/grid/grid.h

constexpr int slot_of(int x, int y, int z) noexcept { return (z + 1) * slot_layer + (y + 1) * slot_row + (x + 1); }

inline std::int16_t larger(std::int16_t a, std::int16_t b) noexcept { return a > b ? a : b; }
inline __m128i larger_of_eight(const std::int16_t* a, const std::int16_t* b) noexcept {
    return _mm_max_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(a)),
                         _mm_loadu_si128(reinterpret_cast<const __m128i*>(b)));
}
inline void store(std::int16_t* to, __m128i eight) noexcept { _mm_storeu_si128(reinterpret_cast<__m128i*>(to), eight); }

using Eight = __m256;
using EightInts = __m256i;

inline EightInts shifted(EightInts slots, int by) noexcept { return _mm256_add_epi32(slots, _mm256_set1_epi32(by)); }
/// Loads the samples `by` after eight slots. The lower half of each lane is that sample, the upper half the next one.
inline EightInts pairs(const std::int16_t* samples, EightInts slots, int by) noexcept {
    return _mm256_i32gather_epi32(reinterpret_cast<const int*>(samples + by), slots, 2);
}
inline EightInts first(EightInts two) noexcept { return _mm256_srai_epi32(_mm256_slli_epi32(two, 16), 16); }
inline EightInts second(EightInts two) noexcept { return _mm256_srai_epi32(two, 16); }
inline Eight difference(EightInts a, EightInts b) noexcept { return _mm256_cvtepi32_ps(_mm256_sub_epi32(a, b)); }

/// For eight edges of the grid: the samples at both ends, and the field's change about each as in `SampleSlope`.
struct EightEdges {
    EightInts low, high;
    Eight low_slope[3], high_slope[3];
};

inline EightEdges along_x(const std::int16_t* v, EightInts at) noexcept {
    const EightInts before = pairs(v, at, -1), after = pairs(v, at, 1);
    EightEdges e;
    e.low = second(before);
    e.high = first(after);
    e.low_slope[0] = difference(e.high, first(before));
    e.high_slope[0] = difference(second(after), e.low);
    constexpr int steps[3] = {0, slot_row, slot_layer};
    for (int n = 1; n < 3; ++n) {
        const EightInts below = pairs(v, at, -steps[n]), above = pairs(v, at, steps[n]);
        e.low_slope[n] = difference(first(above), first(below));
        e.high_slope[n] = difference(second(above), second(below));
    }
    return e;
}

/// Loads edges along y or z.
template <int axis>
inline EightEdges across(const std::int16_t* v, EightInts at) noexcept {
    constexpr int step = axis == 1 ? slot_row : slot_layer, other = axis == 1 ? slot_layer : slot_row;
    const EightInts low = pairs(v, at, -1), high = pairs(v, at, step - 1);
    EightEdges e;
    e.low = second(low);
    e.high = second(high);
    e.low_slope[0] = difference(first(pairs(v, at, 1)), first(low));
    e.high_slope[0] = difference(first(pairs(v, at, step + 1)), first(high));
    e.low_slope[axis] = difference(e.high, first(pairs(v, at, -step)));
    e.high_slope[axis] = difference(first(pairs(v, at, 2 * step)), e.low);
    e.low_slope[3 - axis] = difference(first(pairs(v, at, other)), first(pairs(v, at, -other)));
    e.high_slope[3 - axis] = difference(first(pairs(v, at, step + other)), first(pairs(v, at, step - other)));
    return e;
}

/// Stores six numbers of each of eight vertices, and two arbitrary numbers after the last.
inline void store(const Eight (&row)[6], float* to) noexcept {
    const Eight nothing = _mm256_setzero_ps();
    const Eight a0 = _mm256_unpacklo_ps(row[0], row[1]), a1 = _mm256_unpackhi_ps(row[0], row[1]);
    const Eight b0 = _mm256_unpacklo_ps(row[2], row[3]), b1 = _mm256_unpackhi_ps(row[2], row[3]);
    const Eight c0 = _mm256_unpacklo_ps(row[4], row[5]), c1 = _mm256_unpackhi_ps(row[4], row[5]);
    const auto lows = [](Eight p, Eight q) {
        return _mm256_castpd_ps(_mm256_unpacklo_pd(_mm256_castps_pd(p), _mm256_castps_pd(q)));
    };
    const auto highs = [](Eight p, Eight q) {
        return _mm256_castpd_ps(_mm256_unpackhi_pd(_mm256_castps_pd(p), _mm256_castps_pd(q)));
    };
    const Eight first_four[4] = {lows(a0, b0), highs(a0, b0), lows(a1, b1), highs(a1, b1)};
    const Eight last_two[4] = {lows(c0, nothing), highs(c0, nothing), lows(c1, nothing), highs(c1, nothing)};
    for (int n = 0; n < 4; ++n) _mm256_storeu_ps(to + 6 * n, _mm256_permute2f128_ps(first_four[n], last_two[n], 0x20));
    for (int n = 0; n < 4; ++n)
        _mm256_storeu_ps(to + 6 * (n + 4), _mm256_permute2f128_ps(first_four[n], last_two[n], 0x31));
}

template <int axis>
void crossings_along(const std::int16_t* samples, const std::uint16_t* slots, std::size_t count,
                     const SampleFrame& frame, SurfaceVertex* vertices) noexcept {
    const Eight spacing = _mm256_set1_ps(frame.spacing), one = _mm256_set1_ps(1.0f), zero = _mm256_setzero_ps(),
                sign = _mm256_set1_ps(-0.0f);
    const EightInts nibble = _mm256_set1_epi32(15);
    for (std::size_t i = 0; i < count; i += 8) {
        const EightInts at = _mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(slots + i)));
        EightEdges e;
        if constexpr (axis == 0)
            e = along_x(samples, at);
        else
            e = across<axis>(samples, at);
        const Eight to_low = _mm256_cvtepi32_ps(_mm256_abs_epi32(e.low)),
                    to_high = _mm256_cvtepi32_ps(_mm256_abs_epi32(e.high));

        Eight slope[3];
        for (int n = 0; n < 3; ++n) slope[n] = to_high * e.low_slope[n] + to_low * e.high_slope[n];
        const Eight squared = (slope[0] * slope[0] + slope[1] * slope[1]) + slope[2] * slope[2];
        const Eight scale = one / _mm256_sqrt_ps(squared);
        const Eight rises = _mm256_cmp_ps(squared, zero, _CMP_GT_OQ);
        const Eight outwards = _mm256_or_ps(one, _mm256_andnot_ps(_mm256_castsi256_ps(e.low), sign));
        Eight row[6];
        for (int n = 0; n < 3; ++n) row[3 + n] = _mm256_blendv_ps(n == axis ? outwards : zero, slope[n] * scale, rises);

        const Eight t = _mm256_cvtepi32_ps(e.low) / _mm256_cvtepi32_ps(_mm256_sub_epi32(e.low, e.high));
        const EightInts of_axis[3] = {_mm256_and_si256(at, nibble), _mm256_and_si256(_mm256_srli_epi32(at, 4), nibble),
                                      _mm256_srli_epi32(at, 8)};
        for (int n = 0; n < 3; ++n) {
            Eight sample = _mm256_cvtepi32_ps(shifted(of_axis[n], frame.first[n] - 1));
            if (n == axis) sample = sample + t;
            row[n] = _mm256_set1_ps(frame.origin[n]) + spacing * sample;
        }
        store(row, vertices[i].position);
    }
}

}  // namespace

void larger_rows(const BrickAround& a, const BrickAround& b, std::int16_t* samples, std::uint16_t* inside) noexcept {
    for (int z = 0; z < stored_row; ++z)
        for (int y = 0; y < stored_row; ++y) {
            const int from = z * stored_layer + y * stored_row, to = slot_of(0, y, z);
            const __m128i low = larger_of_eight(a.own + from, b.own + from);           // samples 0 … 7
            const __m128i high = larger_of_eight(a.own + from + 1, b.own + from + 1);  // samples 1 … 8
            store(samples + to, low);
            store(samples + to + 1, high);
            samples[to - 1] = larger(a.neighbour[0][from + 7], b.neighbour[0][from + 7]);
            samples[to + 9] = larger(a.neighbour[1][from + 1], b.neighbour[1][from + 1]);
            const unsigned signs = static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(low, high)));
            inside[to >> 4] = static_cast<std::uint16_t>((signs & 0xff) << 1 | signs >> 15 << 9);
        }
}

void larger_border(const BrickAround& a, const BrickAround& b, std::int16_t* samples) noexcept {
    const auto copy = [&](int side, int from, int to) {
        const std::int16_t *p = a.neighbour[side] + from, *q = b.neighbour[side] + from;
        store(samples + to, larger_of_eight(p, q));
        samples[to + 8] = larger(p[8], q[8]);
    };
    for (int n = 0; n < stored_row; ++n) {
        copy(2, n * stored_layer + 7 * stored_row, slot_of(0, -1, n));
        copy(3, n * stored_layer + 1 * stored_row, slot_of(0, 9, n));
        copy(4, 7 * stored_layer + n * stored_row, slot_of(0, n, -1));
        copy(5, 1 * stored_layer + n * stored_row, slot_of(0, n, 9));
    }
}

void crossings(const std::int16_t* samples, const std::uint16_t* slots, std::size_t count, int axis,
               const SampleFrame& frame, SurfaceVertex* vertices) noexcept {
    if (axis == 0) crossings_along<0>(samples, slots, count, frame, vertices);
    if (axis == 1) crossings_along<1>(samples, slots, count, frame, vertices);
    if (axis == 2) crossings_along<2>(samples, slots, count, frame, vertices);
}

}  // namespace kerf::avx2
