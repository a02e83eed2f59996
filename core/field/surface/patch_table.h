// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/field/surface/surface_patches.h"

namespace kerf {

/// The patches of a body at one moment, by brick. Never changed once made: any thread may keep and read it.
///
/// Bricks lie in pages, and a table shares with the one it was made from all pages in which nothing changed, so that a
/// new one costs what changed and not what there is.
class PatchTable {
public:
    /// Without any surface.   [main, worker]
    explicit PatchTable(std::size_t brick_count);

    /// The next one: this with what was `published` since, bricks ascending.   [worker]
    [[nodiscard]] PatchTable with(std::span<const SurfacePatches::Published> published) const;

    /// Null where there is no surface.   [any] nonblocking
    [[nodiscard]] const std::shared_ptr<const BrickPatch>& operator[](std::size_t brick) const noexcept {
        return (*pages_[brick / page_bricks])[brick % page_bricks];
    }

private:
    static constexpr std::size_t page_bricks = 32;
    using Page = std::array<std::shared_ptr<const BrickPatch>, page_bricks>;

    std::vector<std::shared_ptr<const Page>> pages_;
};

}  // namespace kerf
