// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <string>

#include "hd.h"
#include "kerf/device_driver.hpp"

namespace kerf::openhaptics {

/// A device that libHD has initialised, with its scheduler. One thread at a time calls its functions, except where
/// they state `any`.
class Session {
public:
    explicit Session(const Hd& hd) : hd_(&hd) {}
    ~Session() { close(); }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Stops the scheduler and initialises the device of this name; without one, by each name that a default device may
    /// have. Returns why it cannot, and what to do; empty on success.
    [[nodiscard]] std::string init(const std::string& name);
    /// Enables forces and starts the scheduler. Returns why it cannot.
    [[nodiscard]] std::string start();
    /// Calls `callback` in each period of the servo, on a thread of libHD, until `close`. Returns why it cannot.
    [[nodiscard]] std::string schedule(unsigned (*callback)(void*), void* context);
    /// Returns the style of a calibration that the device carries out by itself; 0: none.
    [[nodiscard]] unsigned own_calibration() const noexcept;
    void close() noexcept;

    [[nodiscard]] unsigned device() const noexcept { return device_; }
    /// Returns the styles of the device that was initialised last.   [any]
    [[nodiscard]] int calibration_styles() const noexcept { return styles_.load(std::memory_order_relaxed); }
    [[nodiscard]] std::string id() const;    ///< its serial number; "default" without one
    [[nodiscard]] std::string name() const;  ///< its model
    [[nodiscard]] kerf_device_facts facts() const;

private:
    [[nodiscard]] HdError init_once(const char* name);

    const Hd* hd_;
    unsigned device_ = no_device;
    std::atomic<int> styles_{0};
    bool is_running_ = false, is_scheduled_ = false;
    unsigned long callback_ = 0;
};

}  // namespace kerf::openhaptics
