// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/field/grid/brick_bits.h"
#include "core/field/grid/grid.h"
#include "core/field/grid/sample_set.h"

namespace kerf {

/// Marks the samples that do not belong to a piece of separated bone: bone of other pieces, air nearer to them, and all
/// of a brick if neither it nor a neighbour contains bone of the piece.
///
/// A sample in the air between two pieces stores the distance to the nearer piece. A piece that kept the samples nearer
/// to the other one would have contact with a wall where the other piece was.
class PieceMask {
public:
    /// Makes the mask of `piece`, which is a part of `all`: the bone before it separated.   [worker]
    PieceMask(const Grid& grid, const SampleSet& all, const SampleSet& piece);

    enum class RemovedExtent : std::uint8_t { nothing, some, everything };
    [[nodiscard]] RemovedExtent removed_extent(std::size_t brick_index) const noexcept { return extent_[brick_index]; }
    /// Returns whether sample (i, j, k) of the grid is marked. Each index is at most `Grid::samples`, one beyond the
    /// last sample.
    [[nodiscard]] bool is_removed(int i, int j, int k) const noexcept;

private:
    Grid grid_;
    std::vector<RemovedExtent> extent_;
    std::vector<std::uint32_t> slot_;  ///< index into `some_`, for bricks with RemovedExtent::some
    std::vector<BrickBits> some_;
};

}  // namespace kerf
