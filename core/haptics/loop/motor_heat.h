// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace kerf {

/// Limits a device's force to what its motors can carry. Their heat is a low-pass of (force / continuous force)², so 1
/// is what they carry for ever. From 0.8 to 1 the limit falls from the peak force to the continuous force.
class MotorHeat {
public:
    /// Takes the force of a tick of `dt` [s]. Returns the usable fraction of the peak force in the next tick (0 … 1).
    /// A `continuous` force of 0 sets no limit.   [haptic, nonblocking] once a tick
    [[nodiscard]] double usable_fraction(double force, double continuous, double peak, double dt) noexcept {
        if (continuous <= 0.0 || continuous >= peak) return 1.0;
        const double ratio = force / continuous;
        heat_ += dt / time_constant * (ratio * ratio - heat_);
        return 1.0 - (1.0 - continuous / peak) * std::clamp((heat_ - warm) / (1.0 - warm), 0.0, 1.0);
    }
    [[nodiscard]] double heat() const noexcept { return heat_; }  ///< [–]

private:
    static constexpr double time_constant = 30.0;  // [s] of a winding [assumed]
    static constexpr double warm = 0.8;            // [–] [assumed]
    double heat_ = 0.0;
};

}  // namespace kerf
