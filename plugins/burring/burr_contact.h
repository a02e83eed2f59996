// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "burr_cutting.h"
#include "kerf/contact_points.hpp"

/// Where a burr touches without cutting: its neck always, its head as far as it does not cut.
namespace kerf::burring {

/// What contact carried in the last tick [N].
struct Carried {
    double by_neck = 0.0, by_head = 0.0;

    Carried() = default;
    explicit Carried(const Advance& advance) noexcept;
};

/// The points that may touch, while the burr takes bone or as it is otherwise.   [haptic, nonblocking]
[[nodiscard]] ContactPoints touching_points(const BurrHead& head, double length, const BurrParameters& law,
                                            const BoneQuery& bone, bool removes) noexcept;

/// As many contact channels as the law has room for, and friction of what they carried in the last tick.   [haptic,
/// nonblocking]
/// @param speed  [1/s] magnitude of the burr's
void add_contact(const BurrHead& head, const ContactPoints& points, const BurrParameters& law, const BoneQuery& bone,
                 const Turning& turning, double speed, const Carried& last, Channels& channels) noexcept;

}  // namespace kerf::burring
