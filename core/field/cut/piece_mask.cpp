// SPDX-License-Identifier: Apache-2.0
#include "core/field/cut/piece_mask.h"

#include <algorithm>
#include <array>

namespace kerf {

namespace {

constexpr int block = 3 * brick_edge;  ///< samples along an edge of 3³ bricks
using Row = std::uint32_t;             ///< of a block: one bit per sample along x
constexpr Row all_in_row = (Row{1} << block) - 1;

/// Samples of 3³ bricks.
struct Block {
    std::array<std::array<Row, block>, block> row{};  ///< [z][y]

    void put(const BrickBits& bits, int bx, int by, int bz) noexcept {
        for (int z = 0; z < brick_edge; ++z)
            for (int y = 0; y < brick_edge; ++y) {
                const auto eight = static_cast<Row>(bits.slice[static_cast<std::size_t>(z)] >> (8 * y) & 0xffu);
                row[static_cast<std::size_t>(bz * brick_edge + z)][static_cast<std::size_t>(by * brick_edge + y)] |=
                    eight << (bx * brick_edge);
            }
    }
    /// Returns the samples and their neighbours: over faces alone, or over edges and corners too. Alternating, the two
    /// approximate a Euclidean distance.
    [[nodiscard]] Block grown(bool over_corners) const noexcept {
        const auto along_x = [](Row r) { return (r | r << 1 | r >> 1) & all_in_row; };
        Block result;
        if (!over_corners) {
            for (std::size_t z = 0; z < block; ++z)
                for (std::size_t y = 0; y < block; ++y) {
                    Row r = along_x(row[z][y]);
                    if (y > 0) r |= row[z][y - 1];
                    if (y + 1 < block) r |= row[z][y + 1];
                    if (z > 0) r |= row[z - 1][y];
                    if (z + 1 < block) r |= row[z + 1][y];
                    result.row[z][y] = r;
                }
            return result;
        }
        Block flat;
        for (std::size_t z = 0; z < block; ++z)
            for (std::size_t y = 0; y < block; ++y)
                flat.row[z][y] = along_x(row[z][y] | (y > 0 ? row[z][y - 1] : 0) | (y + 1 < block ? row[z][y + 1] : 0));
        for (std::size_t z = 0; z < block; ++z)
            for (std::size_t y = 0; y < block; ++y)
                result.row[z][y] =
                    flat.row[z][y] | (z > 0 ? flat.row[z - 1][y] : 0) | (z + 1 < block ? flat.row[z + 1][y] : 0);
        return result;
    }
    [[nodiscard]] BrickBits middle() const noexcept {
        BrickBits bits;
        for (std::size_t z = 0; z < brick_edge; ++z)
            for (std::size_t y = 0; y < brick_edge; ++y)
                bits.slice[z] |= std::uint64_t{row[z + brick_edge][y + brick_edge] >> brick_edge & 0xffu} << (8 * y);
        return bits;
    }
};

/// Returns the samples of the middle brick that are bone of `others`, or air nearer to `others` than to `own`. Air
/// beyond the clamp of the fields does not count.
BrickBits nearer_to_others(Block own, Block others) noexcept {
    BrickBits removed = others.middle();
    BrickBits settled = removed;
    settled |= own.middle();
    for (int step = 0; step <= static_cast<int>(clamp_voxels); ++step) {
        own = own.grown(step % 2 == 1);
        others = others.grown(step % 2 == 1);
        const BrickBits near_own = own.middle(), near_others = others.middle();
        removed |= near_others.without(near_own).without(settled);
        settled |= near_own;
        settled |= near_others;
    }
    return removed;
}

}  // namespace

PieceMask::PieceMask(const Grid& grid, const SampleSet& all, const SampleSet& piece)
    : grid_(grid), extent_(grid.brick_count(), RemovedExtent::everything), slot_(grid.brick_count(), 0) {
    // Find bricks with bone of the piece, or of others, in them or in their neighbours.
    std::vector<BrickBits> own(grid.brick_count()), others(grid.brick_count());
    std::vector<std::uint8_t> is_near_own(grid.brick_count(), 0), is_near_others(grid.brick_count(), 0);
    const auto around = [&](std::size_t brick, const auto& what) {
        const auto at = grid_.brick_coordinates(brick);
        for (int k = std::max(at[2] - 1, 0); k <= std::min(at[2] + 1, grid_.bricks[2] - 1); ++k)
            for (int j = std::max(at[1] - 1, 0); j <= std::min(at[1] + 1, grid_.bricks[1] - 1); ++j)
                for (int i = std::max(at[0] - 1, 0); i <= std::min(at[0] + 1, grid_.bricks[0] - 1); ++i)
                    what(grid_.brick_index(i, j, k), i - at[0] + 1, j - at[1] + 1, k - at[2] + 1);
    };
    piece.for_each([&](std::size_t brick, const BrickBits& bits) {
        own[brick] |= bits;
        around(brick, [&](std::size_t b, int, int, int) { is_near_own[b] = 1; });
    });
    all.for_each([&](std::size_t brick, const BrickBits& bits) {
        others[brick] |= bits.without(own[brick]);
        if (!others[brick].is_empty()) around(brick, [&](std::size_t b, int, int, int) { is_near_others[b] = 1; });
    });

    for (std::size_t b = 0; b < extent_.size(); ++b) {
        if (is_near_own[b] == 0) continue;
        extent_[b] = RemovedExtent::nothing;
        if (is_near_others[b] == 0) continue;
        Block mine, theirs;
        around(b, [&](std::size_t n, int x, int y, int z) {
            mine.put(own[n], x, y, z);
            theirs.put(others[n], x, y, z);
        });
        const BrickBits removed = nearer_to_others(mine, theirs);
        if (removed.is_empty()) continue;
        extent_[b] = RemovedExtent::some;
        slot_[b] = static_cast<std::uint32_t>(some_.size());
        some_.push_back(removed);
    }
}

bool PieceMask::is_removed(int i, int j, int k) const noexcept {
    // Stored samples beyond the last brick count as its last samples.
    const auto in_grid = [&](int v, std::size_t axis) { return std::min(v, grid_.samples(axis) - 1); };
    i = in_grid(i, 0);
    j = in_grid(j, 1);
    k = in_grid(k, 2);
    const std::size_t b = grid_.brick_index(i / brick_edge, j / brick_edge, k / brick_edge);
    if (extent_[b] != RemovedExtent::some) return extent_[b] == RemovedExtent::everything;
    return some_[slot_[b]].has(i % brick_edge, j % brick_edge, k % brick_edge);
}

}  // namespace kerf
