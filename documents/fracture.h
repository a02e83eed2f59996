// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/anatomy.h"
#include "kerf/exact_math.hpp"

/// Where the parts of a fractured bone are. Landmarks, zones and tissues are those of the whole bone: of where its
/// parts are to go.
namespace kerf::documents {

/// [m] in front of the fracture; negative: behind it. The fragment is in front.
[[nodiscard]] inline double in_front_of(const Fracture& fracture, Vec3 point) noexcept {
    return dot(point - fracture.at, fracture.normal);
}

/// The body that a place of the whole bone is in: 0, or 1 for the fragment of a fracture.
[[nodiscard]] inline std::size_t body_at(const Anatomy& anatomy, Vec3 point) noexcept {
    return anatomy.fracture && in_front_of(*anatomy.fracture, point) > 0.0 ? 1 : 0;
}

/// Where the fragment lies at first: turned about the fracture's place, then shifted.
[[nodiscard]] inline Pose world_from_fragment(const Fracture& fracture) noexcept {
    const Quat turned = quat_from_rotation_vector(fracture.turn * fracture.about);
    return {fracture.at + fracture.shift - rotate(turned, fracture.at), turned};
}

}  // namespace kerf::documents
