// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/field/surface/mesh.h"

namespace kerf {

/// A surface as the page draws it and the session keeps it, packed once. Numbers are little-endian, least significant
/// byte first. Empty: there is none to draw.
struct DrawnSurface {
    double step = 0.0;                     ///< [m] of one step of a position
    Vec3 half_size{};                      ///< [m] of the box around it, about whose middle positions are measured
    std::vector<unsigned char> positions;  ///< int16 x, y, z and 0, for each vertex
    std::vector<unsigned char> normals;    ///< int8 x, y, z and 0, in 127ths, for each vertex
    std::vector<unsigned char> tissues;    ///< index into the run's tissues, for each vertex
    std::vector<unsigned char> triangles;  ///< three vertices each: uint16 if is_short(), else uint32

    [[nodiscard]] bool is_empty() const noexcept { return triangles.empty(); }
    [[nodiscard]] bool is_short() const noexcept { return tissues.size() <= 65'535; }
    friend bool operator==(const DrawnSurface&, const DrawnSurface&) = default;
};

/// The tissue of what is no bone: the page draws it grey.
inline constexpr std::uint8_t drawn_metal = 15;

/// Positions become 16-bit steps from the middle of the box around them: 3 µm in a bone of 20 cm. Normals are made
/// where there are none; triangles with vertices that do not exist are left out.   [any]
[[nodiscard]] DrawnSurface drawn_surface(const Mesh& mesh);

/// Whether the lengths fit together and every triangle has vertices that exist.   [any]
[[nodiscard]] bool is_sound(const DrawnSurface& surface);

}  // namespace kerf
