// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/field/surface/mesh.h"

namespace kerf::session {

/// A packed surface, as the page draws it and the session stores it. Numbers are little-endian. Empty: no surface.
struct DrawnSurface {
    double step = 0.0;                     ///< [m] per step of a position
    Vec3 half_size{};                      ///< [m] half the size of its box; positions are relative to the box's centre
    Vec3 centre{};                         ///< [m] of its box, world frame; zero in sessions of older schemas
    std::vector<unsigned char> positions;  ///< int16 x, y, z and 0 per vertex
    std::vector<unsigned char> normals;    ///< int8 x, y, z and 0 in 127ths, per vertex
    std::vector<unsigned char> tissues;    ///< index into the run's tissues per vertex
    std::vector<unsigned char> triangles;  ///< three vertices per triangle: uint16 if is_short(), else uint32

    [[nodiscard]] bool is_empty() const noexcept { return triangles.empty(); }
    [[nodiscard]] bool is_short() const noexcept { return tissues.size() <= 65'535; }
    friend bool operator==(const DrawnSurface&, const DrawnSurface&) = default;
};

/// Tissue index of surfaces that are not bone: the page draws them grey.
inline constexpr std::uint8_t drawn_metal = 15;

/// Packs a mesh. Positions become 16-bit steps from the centre of its box: 3 µm in a bone of 20 cm. Computes normals if
/// there are none. Leaves out triangles with invalid vertices.   [any]
[[nodiscard]] DrawnSurface drawn_surface(const Mesh& mesh);

/// Returns the mesh that was packed, with its rounded positions and normals.   [any] pure. Pre: is_sound(surface)
[[nodiscard]] Mesh unpacked(const DrawnSurface& surface);

/// Returns whether the arrays have consistent lengths and every triangle has valid vertices.   [any]
[[nodiscard]] bool is_sound(const DrawnSurface& surface);

}  // namespace kerf::session
