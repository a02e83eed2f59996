// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "kerf/device.h"
#include "kerf/newest.hpp"

/// What the thread of a driver needs. Draft: it may change in any version.
namespace kerf {

/// Returns the time of a clock that never goes back [s].   [any]
[[nodiscard]] inline double device_time() noexcept {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Returns the command without force and torque.   [any] pure
[[nodiscard]] inline kerf_device_command command_at_rest() noexcept {
    kerf_device_command rest{};
    rest.device_from_tool.rotation.w = 1.0;
    return rest;
}

/// Returns the state of a device without a report.   [any] pure
[[nodiscard]] inline kerf_device_state state_without_report() noexcept {
    kerf_device_state state{};
    state.device_from_handle.rotation.w = 1.0;
    return state;
}

/// Passes the newest report of a device to the haptic loop, and the loop's newest command to the thread of the driver.
/// Neither waits for the other.
class DeviceExchange {
public:
    /// Time without a command after which the loop counts as silent: the device must not keep an old force [s].
    static constexpr double silence = 20e-3;

    explicit DeviceExchange(const kerf_device_state& first = state_without_report()) noexcept
        : arrived_({first, device_time()}) {}

    /// Returns the newest report, with its age.   [haptic, nonblocking]
    [[nodiscard]] kerf_device_state read() noexcept {
        const Arrived& newest = arrived_.get();
        kerf_device_state state = newest.state;
        state.age = device_time() - newest.time;
        return state;
    }
    /// Takes the command of a tick.   [haptic, nonblocking]
    void write(const kerf_device_command& command) noexcept { commanded_.put({command, device_time()}); }

    /// Passes on a report that came at `time` [s].   [the driver's thread, nonblocking]
    void put(const kerf_device_state& state, double time) noexcept { arrived_.put({state, time}); }
    /// Returns the newest command, or the one at rest if the loop is silent.   [the driver's thread, nonblocking]
    [[nodiscard]] kerf_device_command command() noexcept {
        const Commanded& newest = commanded_.get();
        return device_time() - newest.time <= silence ? newest.command : command_at_rest();
    }

private:
    struct Arrived {
        kerf_device_state state{};
        double time = 0.0;  ///< [s]
    };
    struct Commanded {
        kerf_device_command command = command_at_rest();
        double time = 0.0;  ///< [s]
    };
    Newest<Arrived> arrived_;
    Newest<Commanded> commanded_;
};

}  // namespace kerf
