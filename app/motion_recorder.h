// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "devices/motion/motion.h"
#include "kerf/device.h"

namespace kerf::app {

/// Records the motion of a device's handle, for the drivers that play one (`motion:` of a station).
class MotionRecorder {
public:
    /// @param seconds  expected duration [s]
    explicit MotionRecorder(double seconds);

    /// Takes a report, unless the device is lost or its pose cannot be used, or no time has passed since the last one.
    /// [any] may allocate after the expected duration
    /// @param time  [s], rising; the first one that is taken is the beginning of the motion
    void take(double time, const kerf_device_state& state);
    /// Writes the motion as a whole file. Returns the error as text, empty on success.   [main]
    [[nodiscard]] std::string write(const std::string& file) const;

private:
    std::vector<motion::MotionRow> rows_;
    std::optional<double> start_{};  ///< [s]
};

}  // namespace kerf::app
