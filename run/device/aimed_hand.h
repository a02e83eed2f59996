// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/loop/device_record.h"
#include "devices/simulated_hand/simulated_hand.h"
#include "documents/station.h"
#include "kerf/device.hpp"

namespace kerf::run {

/// An arm, and its maximum push.
struct Arm {
    simulated_hand::Plant plant{};
    double max_push = 30.0;  ///< [N] device newtons [assumed]
};

/// Returns the arm at the handle of a modelled device. It pushes with 30 N at most [assumed], with no more than the
/// device can hold, and with no more than 500 N on the tool [assumed: two hands].   [any] pure
[[nodiscard]] Arm arm_at(const DeviceRecord& device, double force_scale) noexcept;

/// A simulated hand whose aim a deflected cap moves. So a device without force still has a hand's feed and push.
///
/// A full deflection moves the aim at the station's speed, and turns it about the tip. While bone resists, the arm
/// stretches. Its maximum push, times the deflection's fraction of the full speed, limits the stretch. So the cap
/// controls the speed in air and the push in bone. A push that exceeds the limit decays with a time constant of 0.1 s.
class AimedHand {
public:
    AimedHand(const documents::DeviceStation& station, const Arm& arm, const Pose& world_from_tool, double dt);

    /// Advances by one tick under the force of the last one. Returns the pose of the hand. In periods that a clock
    /// misses, neither aim nor hand moves.   [haptic, nonblocking]
    /// @param along, about  deflection along and about the device's axes, -1 to 1 [–]
    [[nodiscard]] Pose step(Vec3 along, Vec3 about, const DeviceCommand& command);
    /// Ends motion and push where the hand is.   [haptic, nonblocking]
    void stop() noexcept;

private:
    void move_aim(Vec3 along, Vec3 about) noexcept;

    Quat world_from_device_;
    double speed_, turn_speed_, dead_zone_;  ///< [m/s], [rad/s], [–]
    double max_push_, max_lead_;             ///< [N], [m]
    double dt_;                              ///< [s]
    simulated_hand::SimulatedHand hand_;
    Pose aim_;
};

}  // namespace kerf::run
