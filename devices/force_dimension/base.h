// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dhd.h"
#include "kerf/device_driver.hpp"

namespace kerf::force_dimension {

/// One base, opened through the library. One thread calls all functions.
class Base {
public:
    explicit Base(const Dhd& dhd) : dhd_(&dhd) {}
    ~Base() { close(); }
    Base(const Base&) = delete;
    Base& operator=(const Base&) = delete;

    /// Opens the base with this serial number, or the first one if it is empty. Returns why it cannot, and what to do;
    /// empty on success.
    /// @param may_move  the base may move its arm to calibrate itself
    [[nodiscard]] std::string open(const std::string& serial, bool may_move);
    void close() noexcept;
    [[nodiscard]] bool is_open() const noexcept { return is_open_; }

    [[nodiscard]] const std::string& serial() const noexcept { return serial_; }
    [[nodiscard]] kerf_device_facts facts() const;

    /// Reads pose and buttons into the state. Returns false if the base is lost.
    /// @param now  of a clock that never goes back [s]
    [[nodiscard]] bool read(double now, kerf_device_state& state);
    /// Makes a force [N], frame `device`. Returns false if the base is lost.
    [[nodiscard]] bool make(Vec3 force) noexcept;
    /// Returns why the base makes no force or reports no pose now; empty if nothing is wrong. Queries the base.
    [[nodiscard]] std::string problem() const;

private:
    [[nodiscard]] std::string prepare(bool may_move);
    [[nodiscard]] std::string last_error() const;

    const Dhd* dhd_;
    char id_ = -1;
    bool is_open_ = false, has_wrist_ = false, has_watchdog_ = false;
    std::string serial_;
    Model model_{};
    std::string fault_{};  ///< of the last report
    bool has_position_ = false;
    Vec3 last_position_{};
    double unsound_until_ = 0.0;  ///< [s]
};

/// Returns the connected bases, each with its problem if it cannot be opened.
[[nodiscard]] std::vector<DeviceFound> list_bases(const Dhd& dhd);

}  // namespace kerf::force_dimension
