// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "kerf/math.hpp"

namespace kerf::motion {

/// A pose of a handle, and what is pressed then.
struct MotionRow {
    double time = 0.0;                          ///< [s] from the beginning of the motion
    Pose device_from_handle = identity_pose();  ///< [m]
    std::uint32_t buttons = 0;                  ///< bit i: button i is pressed
};

/// A motion of a handle in the frame of its device.
class Motion {
public:
    /// Pre: at least one row; their times rise.
    explicit Motion(std::vector<MotionRow> rows);

    /// Returns the newest row that is not later than this millisecond: before the first row the first one, after the
    /// last row its pose with no button pressed.   [haptic, nonblocking] pure
    [[nodiscard]] MotionRow at(std::uint64_t millisecond) const noexcept;
    /// Returns the number of buttons up to the last one that is ever pressed.   [any]
    [[nodiscard]] std::uint32_t button_count() const noexcept { return button_count_; }

private:
    std::vector<MotionRow> rows_;
    std::uint32_t button_count_ = 0;
};

}  // namespace kerf::motion
