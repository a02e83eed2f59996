// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "conformance/test.h"
#include "kerf/abi.h"
#include "kerf/device.h"

/// A device that the kit opens through its driver. There need be no device: tests are skipped then.
namespace kerf::conformance {

/// Returns the defaults of a driver's parameters.   [any]
[[nodiscard]] std::vector<double> defaults_of(const kerf_component& driver);

/// How a device is opened.
struct OpenRequest {
    std::string id{};                                             ///< empty: any
    std::vector<std::pair<std::string, std::string>> settings{};  ///< key and value
    double patience = 1.0;  ///< [s] after which `is_cancelled` is true; the kit waits for no hardware
};

/// Calls `open`. Returns what it wrote; `status` is what it returned.   [main]
struct Opening {
    kerf_status status = KERF_FAILED;
    kerf_device_open_out out{};
};
[[nodiscard]] Opening open_device(const kerf_component& driver, const OpenRequest& request);

/// An open device of a driver with the defaults of its parameters and no settings. Closed with this object.   [main]
class DeviceTrial {
public:
    explicit DeviceTrial(const kerf_component& driver) : driver_(driver), opening_(open_device(driver, {})) {}
    ~DeviceTrial() { close(); }
    DeviceTrial(const DeviceTrial&) = delete;
    DeviceTrial& operator=(const DeviceTrial&) = delete;

    [[nodiscard]] bool is_open() const noexcept { return opening_.out.device != nullptr; }
    /// Returns why there is no device, for a test that is skipped.
    [[nodiscard]] std::string reason() const;
    [[nodiscard]] const kerf_device_facts& facts() const noexcept { return opening_.out.facts; }
    [[nodiscard]] kerf_device_state read() const noexcept;
    void write(const kerf_device_command& command) const noexcept;
    /// Closes it, once.
    void close() noexcept;

private:
    const kerf_component& driver_;
    Opening opening_;
};

/// Returns a command of a tick: a force that slowly turns, well below the limits of every device, and the tool where
/// the handle is.   [any] pure
[[nodiscard]] kerf_device_command gentle_command(std::uint64_t tick, const kerf_device_state& state) noexcept;

}  // namespace kerf::conformance
