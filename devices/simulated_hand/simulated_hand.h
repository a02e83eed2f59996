// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kerf/device.hpp"

/// A hand without hardware: an arm that holds a haptic device and carries out intent.
namespace kerf::simulated_hand {

/// The arm that holds the handle, and the handle itself. Device side.
struct Plant {
    double arm_mass = 0.554;        ///< [kg]     one fitted trial [van-beek-2015]
    double arm_damping = 6.45;      ///< [N·s/m]  same
    double arm_stiffness = 135.0;   ///< [N/m]    same
    double device_mass = 0.075;     ///< [kg]
    double device_viscosity = 0.1;  ///< [N·s/m]
    double device_friction = 0.04;  ///< [N] Coulomb
    double resolution = 30e-6;      ///< [m] of one encoder count
    bool asks_setpoint = false;  ///< the device closes the spring itself, 20 times a tick, instead of holding the force
};

/// One leg of the way: to `target`, in a straight line.
struct Leg {
    Pose target = identity_pose();
    double speed = 10e-3;  ///< [m/s] aimed at
    double push = 0.0;     ///< [N] the most the hand pushes, device side
};

struct Intent {
    std::vector<Leg> legs;
    double reaction = 0.15;  ///< [s] until the hand answers what it feels
};

/// An arm with an intent.
///
/// The mind moves a plan along the leg at the speed it aims at. The arm's spring pulls the handle to the plan; where
/// that is not enough the mind leans in, in proportion to the lag it sees and for as long as it sees it, up to `push`.
/// Seeing takes one reaction time. When it sees the handle ahead of the plan it lets go: the lean is gone and the plan
/// goes on from where the handle is. It knows nothing of the tool's pose and never writes it. The wrist turns to its
/// aim and holds it, whatever it meets.
class SimulatedHand {
public:
    SimulatedHand(const Plant& plant, const Intent& intent, const Pose& start, double dt);

    /// One tick under what the device is sent; what the encoders say then.
    Pose step(const DeviceCommand& command);
    /// The last answer of `step`, or the start.
    [[nodiscard]] Pose reported() const noexcept;
    [[nodiscard]] bool is_done() const noexcept { return leg_ >= intent_.legs.size(); }
    [[nodiscard]] std::size_t leg() const noexcept { return leg_; }

private:
    void think();

    Plant plant_;
    Intent intent_;
    double dt_;
    Vec3 position_, velocity_{};
    Quat rotation_;
    double plan_ = 0.0;  ///< [m] along the leg: where the mind would be
    double lean_ = 0.0;  ///< [m] along the leg: stretch of the arm's spring on top
    Vec3 leg_start_;
    std::size_t leg_ = 0;
    /// What was, and what was planned, one reaction time ago: rings.
    std::vector<Vec3> felt_;
    std::vector<double> planned_;
    std::size_t felt_at_ = 0;
};

}  // namespace kerf::simulated_hand
