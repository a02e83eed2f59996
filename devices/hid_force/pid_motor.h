// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "devices/hid/hid_transport.h"
#include "pid_codec.h"
#include "pid_layout.h"

namespace kerf::hid_force {

/// Makes a torque by one constant force that the device itself ends after `effect_duration`, unless it is started
/// again. One thread calls all functions. Each may block as the transport does.
class PidMotor {
public:
    /// Time between two starts of the effect [s].
    static constexpr double start_interval = 30e-3;
    /// Time in which gain and force rise from 0 after the start [s]. Some bases oscillate if the gain is full at once,
    /// and the Arduino library for joysticks ignores the gain.
    static constexpr double ramp = 1.0;
    /// Number of times that the block load is read before the device counts as not answering.
    static constexpr int max_polls = 60;

    /// Pre: the transport outlives it, and its device is open.
    PidMotor(hid::HidTransport& transport, const PidLayout& layout) noexcept
        : transport_(&transport), layout_(layout) {}

    /// Creates and starts the effect, without force. Returns why it cannot; empty on success.
    /// @param now  of a clock that never goes back [s]
    [[nodiscard]] std::string begin(double now);
    /// Sends force and gain if they have changed. Returns false if the device does not take it: it is lost.
    /// @param fraction  [–] of the full torque, -1 to 1; a value that is no number counts as 0
    [[nodiscard]] bool step(double fraction, double now) noexcept;
    /// Starts the effect again if it is time to. Returns false if the device does not take it: it is lost.
    /// Pre: the force of the last step is not old.
    [[nodiscard]] bool renew(double now) noexcept;
    /// Stops and frees the effect. The actuators stay enabled: some devices turn on a spring of their own without them.
    void end() noexcept;

private:
    [[nodiscard]] bool send(const Report& report) noexcept;
    [[nodiscard]] std::string create();
    [[nodiscard]] BlockLoad poll_block() noexcept;
    [[nodiscard]] bool send_gain(double now) noexcept;

    hid::HidTransport* transport_;
    PidLayout layout_;
    std::int64_t block_ = 0;                             ///< 0: there is no effect
    double began_ = 0.0, started_ = 0.0, gained_ = 0.0;  ///< [s]
    Report force_{}, gain_{};                            ///< that were sent last
};

}  // namespace kerf::hid_force
