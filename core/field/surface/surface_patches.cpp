// SPDX-License-Identifier: Apache-2.0
#include "core/field/surface/surface_patches.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/field/surface/patch_weld.h"

namespace kerf {

SurfacePatches::SurfacePatches(const Body& body)
    : body_(&body), mesher_(std::make_unique<BrickMesher>(body)), patches_(body.grid().brick_count()) {}

void SurfacePatches::remesh(const CutField& cut, std::size_t brick, std::vector<Published>& published) {
    std::shared_ptr<const BrickPatch>& patch = patches_[brick];
    const PatchView view = mesher_->may_cross(cut, brick) ? mesher_->mesh(cut, brick) : PatchView{};
    if (patch == nullptr ? view.vertices.empty() : patch->is_same_as(view)) return;
    patch = view.vertices.empty() ? nullptr : std::make_shared<const BrickPatch>(view);
    published.push_back({brick, patch});
}

std::vector<SurfacePatches::Published> SurfacePatches::update(const CutField& cut,
                                                              std::span<const std::size_t> changed) {
    const auto& n = body_->grid().bricks;
    std::vector<std::size_t> bricks(changed.begin(), changed.end());
    for (const std::size_t brick : changed) {
        const std::array<std::size_t, 3> step{1, static_cast<std::size_t>(n[0]),
                                              static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1])};
        const std::array<std::size_t, 3> at{brick % step[1], brick % step[2] / step[1], brick / step[2]};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto depends = [&](std::size_t other, std::size_t side) {
                return patches_[other] != nullptr && patches_[other]->depends_on(static_cast<int>(side));
            };
            if (at[axis] > 0 && depends(brick - step[axis], 2 * axis + 1)) bricks.push_back(brick - step[axis]);
            if (at[axis] + 1 < static_cast<std::size_t>(n[axis]) && depends(brick + step[axis], 2 * axis))
                bricks.push_back(brick + step[axis]);
        }
    }
    std::sort(bricks.begin(), bricks.end());
    bricks.erase(std::unique(bricks.begin(), bricks.end()), bricks.end());

    std::vector<Published> published;
    for (const std::size_t brick : bricks) remesh(cut, brick, published);
    return published;
}

std::vector<SurfacePatches::Published> SurfacePatches::update_all(const CutField& cut) {
    std::vector<Published> published;
    for (std::size_t brick = 0; brick < patches_.size(); ++brick) remesh(cut, brick, published);
    return published;
}

Mesh SurfacePatches::welded() const {
    std::size_t vertices = 0, triangles = 0;
    for (const auto& patch : patches_) {
        if (patch == nullptr) continue;
        vertices += patch->vertices().size();
        triangles += patch->triangles().size();
    }
    PatchWeld weld(body_->grid(), vertices, triangles);
    for (std::size_t brick = 0; brick < patches_.size(); ++brick)
        if (patches_[brick] != nullptr) weld.add(brick, patches_[brick]->view());
    return std::move(weld).mesh();
}

}  // namespace kerf
