// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kerf/math.hpp"

/// Values that a device and the haptic loop exchange once a tick. Draft: it may change in any version.
namespace kerf {

/// Sent by the device. The loop treats an invalid pose (NaN, a rotation that is not a unit quaternion) as lost.
struct DeviceSample {
    Pose world_from_handle = identity_pose();  ///< pose that the hand wants for the tool
    std::uint32_t missed = 0;                  ///< ticks that were due since the last sample and did not run
    bool is_lost = false;  ///< the device is silent, unplugged or clutched: the pose is the last one
};

/// Setpoint of a device that closes the spring itself, faster than the loop. Until the next setpoint it applies
///
///     f = carried + limited(K (p − x) + B (ṗ − ẋ))      [N] on the hand, world frame
///
/// The magnitude of the second term is at most `limit`; x is the position that the device reports.
struct Setpoint {
    Vec3 position{};         ///< p [m]
    Vec3 velocity{};         ///< ṗ [m/s]
    double stiffness = 0.0;  ///< K [N/m], device newtons
    double damping = 0.0;    ///< B [N·s/m]
    double limit = 0.0;      ///< [N]
    Vec3 carried{};          ///< [N] force outside the spring: release, passivity
};

/// Sent to the device.
struct DeviceCommand {
    Vec6 wrench{};  ///< on the hand, at the grip, world frame [N, N·m], device newtons; constant until the next tick
    Setpoint setpoint;  ///< the same force as a spring, for a device that closes the spring itself
};

}  // namespace kerf
