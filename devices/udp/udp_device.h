// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "kerf/device_driver.hpp"

namespace kerf::udp {

/// A device that a program next to Kerf drives: it sends poses and gets forces as datagrams (docs/guide/devices.md).
///
/// Settings of the station: `peer`, the address of another machine, and `key_file`, a file of 32 hexadecimal digits.
/// Without them only programs on this machine can connect.
struct Udp {
    double port;  ///< [–] of this machine
    double wait;  ///< [s] for the device's program

    static constexpr auto about() {
        using namespace literals;
        return describe("udp", "A device whose own program sends poses and gets forces as datagrams.",
                        param(&Udp::port, {.id = "port",
                                           .help = "UDP port on which Kerf listens.",
                                           .min = 1024.0,
                                           .max = 65535.0,
                                           .def = 4190.0,
                                           .source = "assumed"}),
                        param(&Udp::wait, {.id = "wait",
                                           .help = "Maximum time to wait for the device's program.",
                                           .unit = unit::s,
                                           .min = 0.1_s,
                                           .max = 3600.0_s,
                                           .def = 60.0_s,
                                           .source = "assumed"}));
    }
    [[nodiscard]] std::vector<DeviceFound> find() const;
    /// Waits for the hello of a program. Throws std::runtime_error with the reason if none does.
    [[nodiscard]] std::unique_ptr<DeviceLink> open(const DeviceRequest& request) const;
};

}  // namespace kerf::udp
