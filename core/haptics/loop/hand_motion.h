// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/device.hpp"

/// Where the hand is and how fast, out of encoder counts.
namespace kerf {

/// Takes a device's samples as they come: estimates the rate, and tells a hand from a fault.
class HandMotion {
public:
    explicit HandMotion(const Pose& start) : pose_(start) {}

    /// One tick's sample. A pose that is none is left out; a leap of more than 20 mm between two ticks is no hand's,
    /// and after three missed ticks it may have been anywhere. Returns false for any of these, and for the first sample
    /// after a pose that was none: then nothing may follow from the difference to the last one.   [haptic, nonblocking]
    bool take(const DeviceSample& sample, double dt) noexcept;

    [[nodiscard]] const Pose& pose() const noexcept { return pose_; }  ///< the last good one
    /// World frame [m/s, rad/s]: differences through two poles at 50 Hz, never raw ones.
    [[nodiscard]] const Vec6& rate() const noexcept { return rate_; }

private:
    Pose pose_;
    Vec6 first_pole_{}, rate_{};
    bool was_missing_ = false;
};

}  // namespace kerf
