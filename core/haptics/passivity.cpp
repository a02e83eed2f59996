// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/passivity.h"

#include <algorithm>

namespace kerf {

void PassivityGuard::observe(const Vec6& wrench, const Vec6& moved, double supplied, double stored) noexcept {
    moved_ = linear(moved);
    const double way = length(moved_);
    if (way > 0.0 && way < 1.5 * count_) supplied += unseen_;
    energy_ = std::min(energy_ - dot(wrench, moved) + supplied, stored);
    least_ = std::min(least_, energy_);
}

Vec3 PassivityGuard::correction(double dt) noexcept {
    const Vec3 velocity = (1.0 / dt) * moved_;
    const double excess = -tolerance - energy_, speed2 = dot(velocity, velocity);
    if (excess <= 0.0 || speed2 <= 0.0) return {};
    ++corrections_;
    return -std::min(excess / (dt * speed2), largest_damping_) * velocity;
}

}  // namespace kerf
