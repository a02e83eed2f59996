// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "burr_cutting.h"
#include "kerf/contact_points.hpp"

/// Contact without cutting: the neck always, and the head while it does not cut.
namespace kerf::burring {

/// Contact forces in the last tick [N].
struct Carried {
    double by_neck = 0.0, by_head = 0.0;

    Carried() = default;
    explicit Carried(const Advance& advance) noexcept;
};

/// Returns the points that may touch bone. `removes` is true while the burr removes bone.   [haptic, nonblocking]
[[nodiscard]] ContactPoints touching_points(const BurrHead& head, double length, const BurrParameters& law,
                                            const BoneQuery& bone, bool removes) noexcept;

/// Adds contact channels, as many as fit, and friction of the contact forces in the last tick.   [haptic, nonblocking]
/// @param speed  [1/s] magnitude of the burr's speed
void add_contact(const BurrHead& head, const ContactPoints& points, const BurrParameters& law, const BoneQuery& bone,
                 const Turning& turning, double speed, const Carried& last, Channels& channels) noexcept;

}  // namespace kerf::burring
