// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

/// The capabilities of haptic devices.
namespace kerf {

/// A motor about the handle's z axis, as on a stylus that is a screwdriver. All zero: the device has none.
struct TorqueAxis {
    double peak_torque = 0.0;  ///< [N·m]; if not 0, resolution and friction are not 0
    double resolution = 0.0;   ///< [rad] of one count
    double friction = 0.0;     ///< [N·m] Coulomb
};

/// The properties of a haptic device that the loop needs. Device newtons.
struct DeviceRecord {
    const char* id;
    double peak_force;         ///< [N]
    double continuous_force;   ///< [N]
    double peak_torque;        ///< [N·m] about every line; 0: torques are sensed, not actuated, except about `axis`
    double largest_stiffness;  ///< [N/m]
    double largest_damping;    ///< [N·s/m]
    double mass;               ///< [kg] at the handle
    double viscosity;          ///< [N·s/m]
    double friction;           ///< [N] Coulomb
    double resolution;         ///< [m] of one count
    /// The stiffest sampled spring that is stable on the device alone, with its friction, when forces arrive 0, 1 or 2
    /// ticks of a millisecond late [N/m]. Measured on our model of the device: `kerf stability`, S-02.
    double stiffest_wall[3];
    const char* source;
    TorqueAxis axis{};               ///< only for a device whose `peak_torque` is 0
    double continuous_torque = 0.0;  ///< [N·m] about every line; 0: no such limit
    bool is_connected = false;       ///< real: the loop limits the heat of its motors; a model's are ideal
};

/// Largest latency of a device's forces for which `stiffest_wall` has a value [ticks].
inline constexpr int max_latency = 2;

/// Returns the record of a known device, or nullptr for an unknown one.
[[nodiscard]] const DeviceRecord* find_device(const char* id) noexcept;
[[nodiscard]] std::span<const DeviceRecord> all_devices() noexcept;
[[nodiscard]] std::vector<std::string> device_ids();

}  // namespace kerf
