// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/field/surface/brick_mesher.h"
#include "core/field/surface/mesh.h"

namespace kerf {

/// The surface of one body, kept brick by brick, so that only what changed is made anew.
///
/// Patches are shared and never changed: who holds one may read it on any thread, while this goes on. This itself
/// belongs to one thread at a time and starts none.
class SurfacePatches {
public:
    struct Published {
        std::size_t brick;
        std::shared_ptr<const BrickPatch> patch;  ///< null: no surface there any more
    };

    /// Of nothing yet. The body must outlive it.   [main, worker]
    explicit SurfacePatches(const Body& body);

    /// Makes the surface anew where values changed: `changed`, as CutField::take_changed() names bricks, and those of
    /// their neighbours whose normals depend on them. Returns the patches that differ from those before, bricks
    /// ascending; all patches are then, bit for bit, what `update_all` would make.   [worker]
    std::vector<Published> update(const CutField& cut, std::span<const std::size_t> changed);
    /// The same with all bricks.
    std::vector<Published> update_all(const CutField& cut);

    /// Of a brick; null where there is no surface.
    [[nodiscard]] const std::shared_ptr<const BrickPatch>& patch(std::size_t brick) const noexcept {
        return patches_[brick];
    }
    /// All of it as one closed mesh (body frame [m]).   [worker]
    [[nodiscard]] Mesh welded() const;

private:
    void remesh(const CutField& cut, std::size_t brick, std::vector<Published>& published);

    const Body* body_;
    std::unique_ptr<BrickMesher> mesher_;
    std::vector<std::shared_ptr<const BrickPatch>> patches_;  ///< by brick
};

}  // namespace kerf
