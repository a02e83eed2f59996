// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kerf/math.hpp"

/// What a device and the haptic loop tell each other once a tick. Draft: no promise yet.
namespace kerf {

/// From the device. Anything that is no pose (NaN, no unit rotation) is taken as "not there".
struct DeviceSample {
    Pose world_from_handle = identity_pose();  ///< where the hand wants the tool
    std::uint32_t missed = 0;                  ///< ticks that were due since the last one and did not run
};

/// For a device that closes the spring itself, faster than the loop: until the next one comes it makes
///
///     f = carried + limited(K (p − x) + B (ṗ − ẋ))      [N] on the hand, world frame
///
/// with the bracket no longer than `limit` and x the position it reports.
struct Setpoint {
    Vec3 position{};         ///< p [m]
    Vec3 velocity{};         ///< ṗ [m/s]
    double stiffness = 0.0;  ///< K [N/m], device newtons
    double damping = 0.0;    ///< B [N·s/m]
    double limit = 0.0;      ///< [N]
    Vec3 carried{};          ///< [N] what is not of the spring: release, passivity
};

/// To the device.
struct DeviceCommand {
    Vec6 wrench{};      ///< on the hand, at the grip, world frame [N, N·m], device newtons; held until the next tick
    Setpoint setpoint;  ///< the same force as a spring, for a device that asks for it
};

}  // namespace kerf
