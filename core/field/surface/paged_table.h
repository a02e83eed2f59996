// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace kerf {

/// The new patch of a brick; null: the brick has no surface any more.
template <class Patch>
struct PatchChange {
    std::size_t brick;
    std::shared_ptr<const Patch> patch;
};

/// The patches of a body at one moment, by brick. Immutable: any thread may keep and read it.
///
/// Bricks are grouped into pages. A new table reuses all unchanged pages of its predecessor. So its cost depends on the
/// number of changes, not on the size of the surface.
template <class Patch>
class PagedTable {
public:
    using Pointer = std::shared_ptr<const Patch>;
    static constexpr std::size_t page_bricks = 32;
    using Page = std::array<Pointer, page_bricks>;

    /// Makes a table without patches.   [main, worker]
    explicit PagedTable(std::size_t brick_count)
        : pages_((brick_count + page_bricks - 1) / page_bricks, std::make_shared<const Page>()) {}

    /// Returns a copy of this table with these patches replaced. Pre: bricks ascending.   [worker]
    [[nodiscard]] PagedTable with(std::span<const PatchChange<Patch>> changes) const {
        PagedTable next = *this;
        for (std::size_t first = 0, last = 0; first < changes.size(); first = last) {
            const std::size_t page = changes[first].brick / page_bricks;
            const auto changed = std::make_shared<Page>(*pages_[page]);
            for (; last < changes.size() && changes[last].brick / page_bricks == page; ++last)
                (*changed)[changes[last].brick % page_bricks] = changes[last].patch;
            next.pages_[page] = changed;
        }
        return next;
    }

    /// Returns the patch of a brick; null if it has no surface.   [any] nonblocking
    [[nodiscard]] const Pointer& operator[](std::size_t brick) const noexcept {
        return (*pages_[brick / page_bricks])[brick % page_bricks];
    }
    /// Calls `visit(brick, patch)` for each brick whose patch differs from that in `earlier`. Unchanged pages cost one
    /// comparison. Pre: both tables are of one body.   [any]
    template <class Visit>
    void for_each_change_since(const PagedTable& earlier, const Visit& visit) const {
        for (std::size_t page = 0; page < pages_.size(); ++page) {
            if (pages_[page] == earlier.pages_[page]) continue;
            for (std::size_t i = 0; i < page_bricks; ++i)
                if ((*pages_[page])[i] != (*earlier.pages_[page])[i]) visit(page * page_bricks + i, (*pages_[page])[i]);
        }
    }
    /// Returns the number of bricks, rounded up to whole pages.
    [[nodiscard]] std::size_t capacity() const noexcept { return page_bricks * pages_.size(); }

private:
    std::vector<std::shared_ptr<const Page>> pages_;
};

}  // namespace kerf
