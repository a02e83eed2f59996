// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "documents/anatomy.h"
#include "documents/procedure.h"

/// Alignment of a fractured bone and of implants in it. Poses are of all bodies, in their order; none if the bone has
/// not moved.
namespace kerf::run {

/// Displacement of a fragment from its pose in the whole bone.
struct Reduction {
    double offset = 0.0;  ///< [m] at the fracture
    double angle = 0.0;   ///< [rad]
};
/// Returns the displacement of the fragment; nothing for a bone without a fracture.   [any] pure.
[[nodiscard]] std::optional<Reduction> reduction_of(const documents::Anatomy& anatomy,
                                                    std::span<const Pose> world_from_body);

/// Returns the angle between two axes [rad]. Each axis points from `from` to `to` and moves with the body at its
/// middle. Nothing for a name that the anatomy lacks.   [any] pure.
[[nodiscard]] std::optional<double> angle_between(const documents::Anatomy& anatomy,
                                                  std::span<const Pose> world_from_body, const std::string& one,
                                                  const std::string& other);

/// Returns the tip–apex distance [m]. It is the distance from a tip to the point `apex` in the front view, plus the
/// distance in the side view that shows the axis `neck` at full length [baumgaertner-1995]. Without magnification.
/// Nothing for a name that the anatomy lacks.   [any] pure.
[[nodiscard]] std::optional<double> tip_apex_distance(const documents::Anatomy& anatomy,
                                                      std::span<const Pose> world_from_body, Vec3 tip_in_world,
                                                      const std::string& apex, const std::string& neck);

/// Returns the value of a limit that is measured at the end of its step; nothing for other limits.   [any] pure.
/// @param tip_in_world  of the tool [m]
[[nodiscard]] std::optional<double> measured_at_end(const documents::Limit& limit, const documents::Anatomy& anatomy,
                                                    std::span<const Pose> world_from_body, Vec3 tip_in_world);

}  // namespace kerf::run
