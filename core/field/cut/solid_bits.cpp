// SPDX-License-Identifier: Apache-2.0
#include "core/field/cut/solid_bits.h"

#include <algorithm>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace kerf {

namespace {

/// Returns a bit for each of eight samples of a row: set where both values are negative.
std::uint64_t row_bits(const std::int16_t* a, const std::int16_t* b) noexcept {
#if defined(__SSE2__)
    const __m128i both = _mm_and_si128(_mm_loadu_si128(reinterpret_cast<const __m128i*>(a)),
                                       _mm_loadu_si128(reinterpret_cast<const __m128i*>(b)));
    return static_cast<std::uint64_t>(_mm_movemask_epi8(_mm_packs_epi16(both, _mm_setzero_si128()))) & 0xffu;
#else
    std::uint64_t bits = 0;
    for (int x = 0; x < brick_edge; ++x) bits |= std::uint64_t{(a[x] & b[x]) < 0} << x;
    return bits;
#endif
}

}  // namespace

BrickBits solid_bits(const std::int16_t* surface, const std::int16_t* cut) noexcept {
    BrickBits bits;
    for (int z = 0; z < brick_edge; ++z) {
        std::uint64_t slice = 0;
        for (int y = 0; y < brick_edge; ++y) {
            const int row = (z * stored_edge + y) * stored_edge;
            slice |= row_bits(surface + row, cut + row) << (8 * y);
        }
        bits.slice[static_cast<std::size_t>(z)] = slice;
    }
    return bits;
}

BrickBits solid_bits(const Body& body, const CutField& cut, std::size_t index) noexcept {
    if (body.surface.is_all_air(index)) return {};
    const std::int16_t *bone = body.surface.stored(index), *removed = cut.stored(index);
    BrickBits bits = bone == nullptr && removed == nullptr
                         ? BrickBits::full()
                         : solid_bits(bone != nullptr ? bone : removed, removed != nullptr ? removed : bone);
    const auto [i, j, k] = body.grid().brick_coordinates(index);
    const auto within = [&](std::size_t axis, int brick) {  // a bit for each sample of a row that may be cut
        const int low = std::clamp(cut.first_sample()[axis] - brick * brick_edge, 0, brick_edge);
        const int high = std::clamp(cut.last_sample()[axis] - brick * brick_edge + 1, low, brick_edge);
        return static_cast<unsigned>((1 << high) - (1 << low));
    };
    const unsigned x = within(0, i), y = within(1, j), z = within(2, k);
    if (x == 0xff && y == 0xff && z == 0xff) return bits;
    std::uint64_t slice = 0;
    for (int row = 0; row < brick_edge; ++row)
        if ((y >> row & 1u) != 0) slice |= std::uint64_t{x} << (8 * row);
    for (std::size_t n = 0; n < 8; ++n) bits.slice[n] &= (z >> n & 1u) != 0 ? slice : 0;
    return bits;
}

}  // namespace kerf
