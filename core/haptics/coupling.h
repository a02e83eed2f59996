// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/math.hpp"

/// The device's limits and what follows from them for the coupling between hand and tool.
namespace kerf {

/// A haptic device as the loop needs it. Device newtons.
struct DeviceRecord {
    const char* id;
    double peak_force;         ///< [N]
    double continuous_force;   ///< [N]
    double peak_torque;        ///< [N·m]; 0: torques are sensed, not actuated
    double largest_stiffness;  ///< [N/m]
    double largest_damping;    ///< [N·s/m]
    double mass;               ///< [kg] at the handle
    double viscosity;          ///< [N·s/m]
    double friction;           ///< [N] Coulomb
    double resolution;         ///< [m] of one count
    const char* source;
};

/// The records known by name; nullptr for an unknown one.
[[nodiscard]] const DeviceRecord* find_device(const char* id) noexcept;
/// All of them, `count` written.
[[nodiscard]] const DeviceRecord* all_devices(int& count) noexcept;

/// Gains on the device's side; divided by the force scale they act on the bone's.
struct CouplingGains {
    double stiffness = 0.0;       ///< K_c [N/m]
    double damping = 0.0;         ///< B_c [N·s/m]
    double force_limit = 0.0;     ///< [N]
    double torque_limit = 0.0;    ///< [N·m]
    double force_scale = 1.0;     ///< [–] device newtons per bone newton, one for force and torque
    double rotation_arm = 0.05;   ///< [m] K_rot = K arm², B_rot = B arm² [assumed]
    double release_time = 0.15;   ///< [s] release damping = release_time × K_c (docs/ARCHITECTURE.md, release)
};

/// K_c = 0.6 × the device's stiffness, B_c = 0.3 × its damping (resolutions B6; the bisected K_max is not known yet).
[[nodiscard]] CouplingGains gains_for(const DeviceRecord& device, double force_scale) noexcept;

/// The largest scale at which `work_force` [N, bone] stays within 0.6 of what the device can hold, at most 1 (R5).
[[nodiscard]] double force_scale_for(const DeviceRecord& device, double work_force) noexcept;

}  // namespace kerf
