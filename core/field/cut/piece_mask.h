// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/field/grid/brick_bits.h"
#include "core/field/grid/grid.h"
#include "core/field/grid/sample_set.h"

namespace kerf {

/// What is not a piece's own, where bone has come apart: samples of other pieces, air nearer to them, and whole bricks
/// that have none of its bone near.
///
/// Air between two pieces knows the distance to the nearer of them. A piece that kept what lies nearer to the other
/// would feel a wall where the other had been (R4).
class PieceMask {
public:
    /// `piece` of all the bone in `all`.   [worker]
    PieceMask(const Grid& grid, const SampleSet& all, const SampleSet& piece);

    enum class Share : std::uint8_t { nothing, some, everything };
    [[nodiscard]] Share gone_in(std::size_t brick_index) const noexcept { return share_[brick_index]; }
    /// Sample (i, j, k) of the grid; those of its upper border too.
    [[nodiscard]] bool is_gone(int i, int j, int k) const noexcept;

private:
    Grid grid_;
    std::vector<Share> share_;
    std::vector<std::uint32_t> slot_;  ///< of bricks with `some`
    std::vector<BrickBits> some_;
};

}  // namespace kerf
