// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bone/radiograph/attenuation.h"
#include "bone/radiograph/beam.h"

namespace kerf::bone {

/// A closed surface around metal, such as a tool or a screw. Triangles run anticlockwise seen from outside. A triangle
/// whose index or position is not valid is left out.
struct MetalShape {
    std::span<const std::array<float, 3>> positions;  ///< [m] frame of the shape
    std::span<const std::array<std::uint32_t, 3>> triangles;
    Pose world_from_shape = identity_pose();
    double attenuation = steel_attenuation;  ///< [1/m]
};

/// Returns for each pixel the integral of the attenuation through all shapes [–]: Σ ± depth of their back and front
/// faces. Metal behind the source, within 2 % of the distance to the detector, or behind the detector is not in it.
/// Where shapes overlap, both count. Empty, if `error_of` refuses the beam.   [worker] pure.
[[nodiscard]] std::vector<float> metal_shadow(std::span<const MetalShape> shapes, const Beam& beam);

}  // namespace kerf::bone
