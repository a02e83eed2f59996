// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "documents/anatomy.h"
#include "documents/procedure.h"

/// How the parts of a fractured bone lie to each other, and what lies in them. Poses are those of each body, in the
/// order of bodies; without any the bone has not moved.
namespace kerf {

/// What a fragment is away from its place in the whole bone.
struct Reduction {
    double offset = 0.0;  ///< [m] at the fracture's place
    double angle = 0.0;   ///< [rad]
};
/// Returns nothing for a bone without a fracture.   [any] pure.
[[nodiscard]] std::optional<Reduction> reduction_of(const Anatomy& anatomy, std::span<const Pose> world_from_body);

/// Returns the angle between two axes, each from `from` to `to` and with the body that its middle is in [rad]. Nothing
/// for a name that the anatomy does not have.   [any] pure.
[[nodiscard]] std::optional<double> angle_between(const Anatomy& anatomy, std::span<const Pose> world_from_body,
                                                  const std::string& one, const std::string& other);

/// Returns the tip–apex distance [m]: the distance from a tip to the point `apex`, as seen from the front, plus the
/// same in the view from the side that shows the axis `neck` in full [baumgaertner-1995]. Without magnification.
/// Nothing for a name that the anatomy does not have.   [any] pure.
[[nodiscard]] std::optional<double> tip_apex_distance(const Anatomy& anatomy, std::span<const Pose> world_from_body,
                                                      Vec3 tip_in_world, const std::string& apex,
                                                      const std::string& neck);

/// Returns what a limit bounds when its step ends; nothing for another sort of limit.   [any] pure.
/// @param tip_in_world  of the tool [m]
[[nodiscard]] std::optional<double> measured_at_end(const Limit& limit, const Anatomy& anatomy,
                                                    std::span<const Pose> world_from_body, Vec3 tip_in_world);

}  // namespace kerf
