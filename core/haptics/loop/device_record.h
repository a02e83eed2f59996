// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What a haptic device can do.
namespace kerf {

/// A motor about the handle's z axis: a stylus that is a driver. All zero: the device has none.
struct TorqueAxis {
    double peak_torque = 0.0;  ///< [N·m]; if not 0, resolution and friction are not 0 either
    double resolution = 0.0;   ///< [rad] of one count
    double friction = 0.0;     ///< [N·m] Coulomb
};

/// A haptic device as the loop needs it. Device newtons.
struct DeviceRecord {
    const char* id;
    double peak_force;         ///< [N]
    double continuous_force;   ///< [N]
    double peak_torque;        ///< [N·m] about every line; 0: torques are sensed, not actuated, but for `axis`
    double largest_stiffness;  ///< [N/m]
    double largest_damping;    ///< [N·s/m]
    double mass;               ///< [kg] at the handle
    double viscosity;          ///< [N·s/m]
    double friction;           ///< [N] Coulomb
    double resolution;         ///< [m] of one count
    /// The stiffest sampled spring that rests on the device alone, its friction counted, when forces come 0, 1 or 2
    /// whole ticks of a millisecond late [N/m]. Measured on our model of the device: `kerf stability`, S-02.
    double stiffest_wall[3];
    const char* source;
    TorqueAxis axis{};  ///< of a device whose peak_torque is 0
};

/// How late forces reach a device [ticks]; more is not looked at.
inline constexpr int longest_latency = 2;

/// The records known by name; nullptr for an unknown one.
[[nodiscard]] const DeviceRecord* find_device(const char* id) noexcept;
/// All of them, `count` written.
[[nodiscard]] const DeviceRecord* all_devices(int& count) noexcept;

}  // namespace kerf
