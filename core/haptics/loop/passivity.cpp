// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/loop/passivity.h"

#include <algorithm>
#include <cmath>

namespace kerf {

void PassivityGuard::observe(const Vec6& wrench, const Vec6& moved, double supplied, double stored,
                             double turned) noexcept {
    moved_ = linear(moved);
    turned_ = turned;
    const double travel = length(moved_), turn = std::abs(turned);
    if (travel > 0.0 && travel < 1.5 * forces_.count) supplied += forces_.unseen;
    if (turn > 0.0 && turn < 1.5 * shaft_.count) supplied += shaft_.unseen;
    energy_ = std::min(energy_ - dot(wrench, moved) + supplied, stored);
    min_energy_ = std::min(min_energy_, energy_);
}

Vec3 PassivityGuard::correction(double dt) noexcept {
    const Vec3 velocity = (1.0 / dt) * moved_;
    const double excess = -tolerance - energy_, speed2 = dot(velocity, velocity);
    left_ = std::max(excess, 0.0);
    if (excess <= 0.0 || speed2 <= 0.0) return {};
    ++corrections_;
    const double damping = std::min(excess / (dt * speed2), forces_.largest_damping);
    left_ -= damping * dt * speed2;
    return -damping * velocity;
}

double PassivityGuard::shaft_correction(double dt) noexcept {
    const double speed = turned_ / dt;
    if (left_ <= 0.0 || speed == 0.0 || shaft_.largest_damping <= 0.0) return 0.0;
    ++corrections_;
    return -std::min(left_ / (dt * speed * speed), shaft_.largest_damping) * speed;
}

}  // namespace kerf
