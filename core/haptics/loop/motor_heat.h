// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace kerf {

/// Limits a device's force, or its torque, by the heat of its motors. The heat is a low-pass of (force / continuous
/// force)², so at 1 the motors can make the continuous force without end. From 0.8 to 1 the limit falls from the peak
/// force to the continuous force.
class MotorHeat {
public:
    /// Takes the force of a tick of `dt` [s]. Sets the usable fraction of the peak force for the next tick. A
    /// `continuous` force of 0 sets no limit.   [haptic, nonblocking] once a tick
    void take(double force, double continuous, double peak, double dt) noexcept {
        if (continuous <= 0.0 || continuous >= peak) return;
        const double ratio = force / continuous;
        heat_ += dt / time_constant * (ratio * ratio - heat_);
        usable_fraction_ = 1.0 - (1.0 - continuous / peak) * std::clamp((heat_ - warm) / (1.0 - warm), 0.0, 1.0);
        is_warm_ = heat_ > (is_warm_ ? cool : warm);
    }
    [[nodiscard]] double usable_fraction() const noexcept { return usable_fraction_; }  ///< [–] of the peak force
    /// Returns whether the limit has fallen, until the motors have cooled.
    [[nodiscard]] bool is_warm() const noexcept { return is_warm_; }
    [[nodiscard]] double heat() const noexcept { return heat_; }  ///< [–]

private:
    static constexpr double time_constant = 30.0;    // [s] of a winding [assumed]
    static constexpr double warm = 0.8, cool = 0.7;  // [–] [assumed]
    double heat_ = 0.0, usable_fraction_ = 1.0;
    bool is_warm_ = false;
};

}  // namespace kerf
