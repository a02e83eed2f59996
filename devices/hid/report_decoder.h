// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "kerf/device.h"

namespace kerf::hid {

/// Turns the reports of a device into its state. The driver's thread calls it.
class ReportDecoder {
public:
    ReportDecoder() = default;
    virtual ~ReportDecoder() = default;
    ReportDecoder(const ReportDecoder&) = delete;
    ReportDecoder& operator=(const ReportDecoder&) = delete;

    /// Takes one report that came at `now` [s]. Returns false, and changes nothing, if it is none of this device.
    [[nodiscard]] virtual bool take(std::span<const std::uint8_t> report, double now,
                                    kerf_device_state& state) noexcept = 0;
    /// Drops what is too old at `now` [s] to be believed. Returns whether the state has changed.
    [[nodiscard]] virtual bool expire(double now, kerf_device_state& state) noexcept = 0;
};

}  // namespace kerf::hid
