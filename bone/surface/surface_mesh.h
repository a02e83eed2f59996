// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/field/grid/box.h"
#include "kerf/math.hpp"

namespace kerf::bone {

using Triangle = std::array<std::uint32_t, 3>;  ///< indices of its corners, anticlockwise seen from outside

/// A triangle mesh. Unit and frame: those of its file until it is placed; then metres, LPS.
struct SurfaceMesh {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;

    [[nodiscard]] std::array<Vec3, 3> corners(const Triangle& t) const noexcept {
        return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
    }
};

/// Returns the box around all used vertices; from +∞ to −∞ without any.   [any] pure.
[[nodiscard]] Box bounds_of(const SurfaceMesh& mesh) noexcept;
[[nodiscard]] double area_of(const SurfaceMesh& mesh) noexcept;
/// Returns the volume by the divergence theorem; negative if inside out. Meaningful for closed surfaces only.
[[nodiscard]] double signed_volume_of(const SurfaceMesh& mesh) noexcept;

/// Removes the vertices that no triangle uses; the others keep their order.
void drop_unused_vertices(SurfaceMesh& mesh);

}  // namespace kerf::bone
