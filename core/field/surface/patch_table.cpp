// SPDX-License-Identifier: Apache-2.0
#include "core/field/surface/patch_table.h"

namespace kerf {

PatchTable::PatchTable(std::size_t brick_count)
    : pages_((brick_count + page_bricks - 1) / page_bricks, std::make_shared<const Page>()) {}

PatchTable PatchTable::with(std::span<const SurfacePatches::Published> published) const {
    PatchTable next = *this;
    for (std::size_t first = 0, last = 0; first < published.size(); first = last) {
        const std::size_t page = published[first].brick / page_bricks;
        const auto changed = std::make_shared<Page>(*pages_[page]);
        for (; last < published.size() && published[last].brick / page_bricks == page; ++last)
            (*changed)[published[last].brick % page_bricks] = published[last].patch;
        next.pages_[page] = changed;
    }
    return next;
}

}  // namespace kerf
