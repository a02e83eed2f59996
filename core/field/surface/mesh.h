// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kerf/math.hpp"

namespace kerf {

/// A closed surface of triangles, for display, measurement and export.
struct Mesh {
    std::vector<Vec3> vertices;                           ///< [m] LPS
    std::vector<Vec3> normals;                            ///< unit, outward; one per vertex
    std::vector<std::uint8_t> tissue;                     ///< per vertex: index into Body::materials
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< anticlockwise seen from outside
};

}  // namespace kerf
