// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kerf/device.hpp"

/// Pose and rate of the hand from encoder counts.
namespace kerf {

/// Checks the poses that a device reports and estimates the hand's rate.
class HandMotion {
public:
    /// With this number of missed ticks or more, the hand's motion is unknown and the force fades.
    static constexpr std::uint32_t missed_ticks_of_pause = 3;

    explicit HandMotion(const Pose& start) : pose_(start) {}

    /// Takes the pose of one tick of `dt` [s]. Keeps the last pose if this one is lost or invalid. Returns false for
    /// such a pose and for the first one after it. Also for a jump of more than 20 mm and after three or more missed
    /// ticks. Then the difference to the last pose has no meaning, and the rate is zero.   [haptic, nonblocking]
    bool take(const DeviceSample& sample, double dt) noexcept;

    [[nodiscard]] const Pose& pose() const noexcept { return pose_; }  ///< the last valid one
    /// Returns the rate, world frame [m/s, rad/s]: differences of successive poses through a low-pass filter with two
    /// poles at 50 Hz.
    [[nodiscard]] const Vec6& rate() const noexcept { return rate_; }

private:
    Pose pose_;
    Vec6 first_pole_{}, rate_{};
    bool was_missing_ = false;
};

}  // namespace kerf
