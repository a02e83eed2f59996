// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "devices/hid/hid_model.h"
#include "devices/hid/hid_transport.h"
#include "devices/hid/report_decoder.h"
#include "kerf/device.h"

namespace kerf::hid {

/// Follows one device: its reports, its loss when it is unplugged, and its return. One thread calls all functions.
class HidReader {
public:
    HidReader(std::unique_ptr<HidTransport> transport, const HidModel& model, HidDevice device);

    /// Opens the device. Returns the reason if it cannot; empty on success.
    [[nodiscard]] std::string open();
    /// Waits for reports, at most 5 ms, and takes all that have come, so that the state is of the newest. It searches
    /// a lost device once a second. Returns whether the state has changed.
    /// @param now  of a clock that never goes back [s]
    [[nodiscard]] bool step(double now) noexcept;

    [[nodiscard]] const kerf_device_state& state() const noexcept { return state_; }
    [[nodiscard]] bool is_open() const noexcept { return is_open_; }
    /// Returns the number of reports that were none of this device's.
    [[nodiscard]] std::uint64_t ignored() const noexcept { return ignored_; }
    [[nodiscard]] const HidEntry& entry() const noexcept { return device_.entry; }

private:
    void begin();
    void lose(double now) noexcept;
    [[nodiscard]] bool find_again(double now) noexcept;

    std::unique_ptr<HidTransport> transport_;
    HidModel model_;
    HidDevice device_;
    std::unique_ptr<ReportDecoder> decoder_;
    kerf_device_state state_{};
    bool is_open_ = false;
    double next_search_ = 0.0;  ///< [s]
    std::uint64_t ignored_ = 0;
};

}  // namespace kerf::hid
