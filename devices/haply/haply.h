// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "kerf/device_driver.hpp"

namespace kerf::haply {

/// Inverse3 and Minverse of Haply, with their grips, through the maker's Inverse Service on this machine.
///
/// Frame `device`: its origin is that of the service, at the mounting plate of the arm. The handle is the cursor; with
/// a grip it has the grip's rotation.
///
/// Setting of the station: `service`, the version 3.1 or 3.5 of the messages. Without it the driver finds out by a
/// force of 0.05 N.
struct Haply {
    double port;              ///< [–] of the simulation channel
    double events_port;       ///< [–] of the channel of events
    double wait;              ///< [s] for the service's first message
    double peak_force;        ///< [N]
    double continuous_force;  ///< [N]
    double stiffness;         ///< [N/m] largest

    static constexpr auto about() {
        using namespace literals;
        return describe(
            "haply", "An Inverse3 or Minverse of Haply, through its Inverse Service on this machine.",
            param(&Haply::port, {.id = "port",
                                 .help = "Port of the service's simulation channel.",
                                 .min = 1.0,
                                 .max = 65535.0,
                                 .def = 10001.0,
                                 .source = "docs.haply.co, Inverse Service 3.5"}),
            param(&Haply::events_port, {.id = "events_port",
                                        .help = "Port of the service's channel of events.",
                                        .min = 1.0,
                                        .max = 65535.0,
                                        .def = 10020.0,
                                        .source = "docs.haply.co, Inverse Service 3.5"}),
            param(&Haply::wait, {.id = "wait",
                                 .help = "Maximum time to wait for the service's first message.",
                                 .unit = unit::s,
                                 .min = 0.1_s,
                                 .max = 60.0_s,
                                 .def = 5.0_s,
                                 .source = "assumed"}),
            param(&Haply::peak_force, {.id = "peak_force",
                                       .help = "Largest force that Kerf lets the arm make.",
                                       .unit = unit::N,
                                       .min = 0.5_N,
                                       .max = 12.0_N,
                                       .def = 4.0_N,
                                       .source = "assumed; the maker's pages state none"}),
            param(&Haply::continuous_force, {.id = "continuous_force",
                                             .help = "Force that Kerf lets the arm make for long.",
                                             .unit = unit::N,
                                             .min = 0.2_N,
                                             .max = 12.0_N,
                                             .def = 2.0_N,
                                             .source = "assumed; Isaac Lab lets it make 2 N along each axis"}),
            param(&Haply::stiffness, {.id = "stiffness",
                                      .help = "Largest stiffness that the arm renders stably.",
                                      .unit = unit::N_per_mm,
                                      .min = 0.05_N_per_mm,
                                      .max = 5.0_N_per_mm,
                                      .def = 0.8_N_per_mm,
                                      .source = "assumed"}));
    }
    /// Returns the arms of a service on the usual port.
    [[nodiscard]] std::vector<DeviceFound> find() const;
    /// Connects to the service. Throws std::runtime_error with the reason if there is no usable arm.
    [[nodiscard]] std::unique_ptr<DeviceLink> open(const DeviceRequest& request) const;
};

}  // namespace kerf::haply
