// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/station.h"
#include "kerf/device.h"
#include "kerf/math.hpp"

namespace kerf::run {

/// A handle that a lab has extended: the hand grips it away from the handle's origin, and the device carries what was
/// fixed there. Reports and commands are those of the grip; the device gets those of its own handle. The power is the
/// same at both, but for a torque beyond `peak_torque`.
class FittedHandle {
public:
    /// @param peak_torque   [N·m] of the device about every line; 0: it makes none
    FittedHandle(const documents::HandleFit& fit, double peak_torque) noexcept : fit_(fit), peak_torque_(peak_torque) {}

    /// Turns a report of the handle into one of the grip.   [haptic, nonblocking]
    void take(kerf_device_state& state) noexcept;
    /// Returns the command to the handle for one at the grip, in which the device also carries the mass. That force
    /// rises within half a second of ticks, from the first tick or from the device's return.   [haptic, nonblocking]
    [[nodiscard]] kerf_device_command give(kerf_device_command command) noexcept;

private:
    documents::HandleFit fit_;
    double peak_torque_;
    bool is_there_ = false;
    Vec3 lever_{};          ///< [m] from the handle's origin to the grip, frame of the device
    double carried_ = 0.0;  ///< [–] of the weight
};

}  // namespace kerf::run
