// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kerf/device.hpp"

/// Pose and rate of the hand from encoder counts.
namespace kerf {

/// Checks the poses that a device reports and estimates the hand's rate.
class HandMotion {
public:
    /// Missed ticks from which on the hand's motion is unknown and the force fades.
    static constexpr std::uint32_t missed_ticks_of_pause = 3;

    explicit HandMotion(const Pose& start) : pose_(start) {}

    /// Takes one tick's pose. Ignores an invalid pose. Returns false for an invalid pose, for the first pose after one,
    /// for a jump of more than 20 mm between two ticks, and after three missed ticks. In these cases the difference to
    /// the last pose has no meaning and the rate is zero.   [haptic, nonblocking]
    bool take(const DeviceSample& sample, double dt) noexcept;

    [[nodiscard]] const Pose& pose() const noexcept { return pose_; }  ///< the last valid one
    /// Returns the rate, world frame [m/s, rad/s]: pose differences through two poles at 50 Hz.
    [[nodiscard]] const Vec6& rate() const noexcept { return rate_; }

private:
    Pose pose_;
    Vec6 first_pole_{}, rate_{};
    bool was_missing_ = false;
};

}  // namespace kerf
