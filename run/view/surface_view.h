// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/field/pieces/present_bone.h"
#include "core/field/surface/surface_patches.h"
#include "run/view/viewed_run.h"

namespace kerf::run {

/// Makes the surface that viewers draw: the patches of the present bone, with the light at each vertex. Belongs to the
/// thread of the bone.
class SurfaceView {
public:
    /// Meshes what changed since the last call. Returns the new surface; null if nothing changed.   [worker]
    /// @param is_drawn  for each body: its patches are drawn. Others, such as metal, get none.
    [[nodiscard]] std::shared_ptr<const ViewedSurface> update(PresentBone& bone, const std::vector<bool>& is_drawn);

private:
    struct Piece {
        const Body* bone;
        std::optional<SurfacePatches> patches;  ///< nothing: not drawn
    };
    [[nodiscard]] bool update_body(PresentBone& bone, std::size_t body, bool is_new, ViewedSurface& next);

    std::vector<std::optional<Piece>> pieces_;  ///< for each body; nothing: a new one
    std::shared_ptr<const ViewedSurface> last_;
};

/// Returns a patch with the light at each vertex: how free of bone it is at four distances along its normal.
/// [any] pure
[[nodiscard]] ViewedPatch lit_patch(const BrickPatch& patch, const Body& bone, const CutField& cut);

}  // namespace kerf::run
