// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/field/surface/surface_patches.h"

namespace kerf {

/// The patches of a body at one moment, by brick. Immutable: any thread may keep and read it.
///
/// Bricks are grouped into pages. A new table reuses all unchanged pages of its predecessor. So its cost depends on the
/// number of changes, not on the size of the surface.
class PatchTable {
public:
    /// Makes a table without patches.   [main, worker]
    explicit PatchTable(std::size_t brick_count);

    /// Returns a copy of this table with the patches in `published` replaced. Pre: bricks ascending.   [worker]
    [[nodiscard]] PatchTable with(std::span<const SurfacePatches::Published> published) const;

    /// Returns the patch of a brick; null if it has no surface.   [any] nonblocking
    [[nodiscard]] const std::shared_ptr<const BrickPatch>& operator[](std::size_t brick) const noexcept {
        return (*pages_[brick / page_bricks])[brick % page_bricks];
    }

private:
    static constexpr std::size_t page_bricks = 32;
    using Page = std::array<std::shared_ptr<const BrickPatch>, page_bricks>;

    std::vector<std::shared_ptr<const Page>> pages_;
};

}  // namespace kerf
