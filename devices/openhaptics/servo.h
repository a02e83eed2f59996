// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

#include "hd.h"
#include "kerf/device_exchange.hpp"

namespace kerf::openhaptics {

/// Why the device makes no force now.
enum class ServoFault : std::uint8_t { none, no_pose, jump, frozen, not_calibrated, error };

/// What happens in each period of the servo of libHD: it reads pose and buttons and makes the loop's newest force.
class Servo {
public:
    Servo(const Hd& hd, double peak_force) noexcept : hd_(&hd), peak_force_(peak_force) {}

    /// Begins anew with a device. The servo must not run.   [the driver's thread]
    /// @param style  of a calibration that the device can carry out by itself; 0: none
    void restart(unsigned device, unsigned style) noexcept;
    /// One period.   [libHD's thread, nonblocking but for libHD]
    void step() noexcept;

    [[nodiscard]] DeviceExchange& exchange() noexcept { return exchange_; }
    /// Makes no force from now on.   [any]
    void end() noexcept { is_ending_.store(true, std::memory_order_release); }
    /// Returns whether a zero force was sent after `end`.   [any]
    [[nodiscard]] bool has_ended() const noexcept { return has_ended_.load(std::memory_order_acquire); }
    /// Returns whether the device must be initialised again.   [any]
    [[nodiscard]] bool is_lost() const noexcept { return is_lost_.load(std::memory_order_acquire); }
    /// Returns the number of periods so far.   [any]
    [[nodiscard]] std::uint64_t periods() const noexcept { return periods_.load(std::memory_order_relaxed); }
    /// Returns whether the newest state is valid. The first one comes after three periods in a row without an error:
    /// libHD reports a made-up pose until its servo runs.   [any]
    [[nodiscard]] bool is_ready() const noexcept { return is_ready_.load(std::memory_order_acquire); }
    [[nodiscard]] ServoFault fault() const noexcept { return fault_.load(std::memory_order_relaxed); }
    /// Returns the newest error of libHD within the last second; code 0: none.   [any]
    [[nodiscard]] HdError error() const noexcept;

private:
    void take(double now, const double (&transform)[16], int buttons) noexcept;
    [[nodiscard]] ServoFault fault_of(double now, const Pose& pose) noexcept;
    void check_calibration(double now) noexcept;
    [[nodiscard]] bool note_errors(double now) noexcept;

    const Hd* hd_;
    double peak_force_;  ///< [N]
    unsigned device_ = no_device, style_ = 0;
    DeviceExchange exchange_;
    kerf_device_state state_ = state_without_report();
    Pose last_{};   ///< of the period before
    Quat still_{};  ///< rotation since which the position has not changed
    bool has_last_ = false, is_calibrated_ = true;
    double still_since_ = 0.0, unsound_until_ = 0.0, next_check_ = 0.0;  ///< [s]
    int sound_periods_ = 0;                                              ///< in a row
    std::atomic<bool> is_ready_{false}, is_ending_{false}, has_ended_{false}, is_lost_{false};
    std::atomic<std::uint64_t> periods_{0};
    std::atomic<ServoFault> fault_{ServoFault::none};
    std::atomic<unsigned> error_code_{0};
    std::atomic<int> error_internal_{0};
    std::atomic<double> error_time_{-1e9};
};

}  // namespace kerf::openhaptics
