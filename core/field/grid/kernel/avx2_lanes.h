// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#include "core/field/grid/kernel/block_kernel.h"

/// Arithmetic on four or eight points at a time, for the files that are compiled with -mavx2. In an unnamed namespace,
/// so that no other file links to functions compiled for AVX2.
namespace kerf {
namespace {

using Four = __m256d;
constexpr std::size_t lanes = 4;
constexpr int brick_bits = 3, stored = 9;  // of core/field/grid/grid.h: 8 samples a brick and axis, 9 with the apron

inline Four all(double v) noexcept { return _mm256_set1_pd(v); }
/// Returns a < b ? a : b; so b if either is NaN.
inline Four min_of(Four a, Four b) noexcept { return _mm256_min_pd(a, b); }
/// Returns a > b ? a : b; so b if either is NaN.
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

/// The points of a query, `step` at a time. Copies of the last point fill the last step.
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

}  // namespace
}  // namespace kerf
