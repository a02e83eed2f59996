// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>

#include "core/field/grid/grid.h"
#include "core/field/grid/kernel/crossing.h"
#include "core/field/grid/kernel/surface_kernel.h"

namespace kerf::portable {

namespace {

constexpr int stored_row = stored_edge, stored_layer = stored_edge * stored_edge;

constexpr int slot_of(int x, int y, int z) noexcept { return (z + 1) * slot_layer + (y + 1) * slot_row + (x + 1); }

inline std::int16_t larger(std::int16_t a, std::int16_t b) noexcept { return a > b ? a : b; }

/// Writes the larger of two fields at each of the nine samples of a row.
inline void larger_row(const std::int16_t* a, const std::int16_t* b, std::int16_t* samples) noexcept {
    for (int x = 0; x < stored_edge; ++x) samples[x] = larger(a[x], b[x]);
}

}  // namespace

void larger_rows(const BrickAround& a, const BrickAround& b, std::int16_t* samples, std::uint16_t* inside) noexcept {
    for (int z = 0; z < stored_edge; ++z)
        for (int y = 0; y < stored_edge; ++y) {
            const int from = z * stored_layer + y * stored_row, to = slot_of(0, y, z);
            larger_row(a.own + from, b.own + from, samples + to);
            samples[to - 1] = larger(a.neighbour[0][from + 7], b.neighbour[0][from + 7]);
            samples[to + 9] = larger(a.neighbour[1][from + 1], b.neighbour[1][from + 1]);
            unsigned bits = 0;
            for (int x = 0; x < stored_edge; ++x) bits |= (samples[to + x] < 0 ? 1U : 0U) << x;
            inside[to >> 4] = static_cast<std::uint16_t>(bits << 1);
        }
}

void larger_border(const BrickAround& a, const BrickAround& b, std::int16_t* samples) noexcept {
    const auto copy = [&](int side, int from, int to) {
        larger_row(a.neighbour[side] + from, b.neighbour[side] + from, samples + to);
    };
    for (int n = 0; n < stored_edge; ++n) {
        copy(2, n * stored_layer + 7 * stored_row, slot_of(0, -1, n));
        copy(3, n * stored_layer + 1 * stored_row, slot_of(0, 9, n));
        copy(4, 7 * stored_layer + n * stored_row, slot_of(0, n, -1));
        copy(5, 1 * stored_layer + n * stored_row, slot_of(0, n, 9));
    }
}

void crossings(const std::int16_t* samples, const std::uint16_t* slots, std::size_t count, int axis,
               const SampleFrame& frame, SurfaceVertex* vertices) noexcept {
    const int step = axis == 0 ? 1 : axis == 1 ? slot_row : slot_layer;
    const auto slope = [](const std::int16_t* v) -> SampleSlope {
        return {{v[1] - v[-1], v[slot_row] - v[-slot_row], v[slot_layer] - v[-slot_layer]}};
    };
    for (std::size_t i = 0; i < count; ++i) {
        const std::int16_t *low = samples + slots[i], *high = low + step;
        const int at[3] = {(slots[i] & 15) - 1, (slots[i] >> 4 & 15) - 1, (slots[i] >> 8) - 1};
        vertices[i] = crossing(*low, *high, slope(low), slope(high), axis, at, frame);
    }
}

}  // namespace kerf::portable
