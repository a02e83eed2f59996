// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/field/surface/brick_mesher.h"
#include "core/field/surface/mesh.h"
#include "core/field/surface/paged_table.h"

namespace kerf {

/// The surface of one body, stored brick by brick, so that only changed bricks are meshed again.
///
/// Patches are immutable and reference-counted: any thread may read a patch while this object changes. The object
/// itself belongs to one thread at a time and starts none.
class SurfacePatches {
public:
    using Published = PatchChange<BrickPatch>;

    /// Makes an empty surface. The body must outlive it.   [main, worker]
    explicit SurfacePatches(const Body& body);

    /// Meshes the bricks `changed` (as in CutField::take_changed()) and the neighbours whose normals depend on them.
    /// Returns the patches that differ from their predecessors, bricks ascending. Afterwards all patches are, bit for
    /// bit, those that `update_all` makes.   [worker]
    std::vector<Published> update(const CutField& cut, std::span<const std::size_t> changed);
    /// Meshes all bricks. Returns the patches that differ from their predecessors, bricks ascending.
    std::vector<Published> update_all(const CutField& cut);

    /// Returns the patch of a brick; null if it has no surface.
    [[nodiscard]] const std::shared_ptr<const BrickPatch>& patch(std::size_t brick) const noexcept {
        return patches_[brick];
    }
    /// Returns the whole surface as one closed mesh (body frame [m]).   [worker]
    [[nodiscard]] Mesh welded() const;

private:
    void remesh(const CutField& cut, std::size_t brick, std::vector<Published>& published);

    const Body* body_;
    std::unique_ptr<BrickMesher> mesher_;
    std::vector<std::shared_ptr<const BrickPatch>> patches_;  ///< by brick
};

}  // namespace kerf
