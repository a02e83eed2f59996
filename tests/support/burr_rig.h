// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "plugins/burring/burr_force.h"
#include "tests/support/drill_rig.h"

/// The burring plugin as the host loads it. The bone's face is z = 0; the burr comes from above.
namespace kerf::test {

inline ToolSetup burr_of(const std::string& tool, const std::map<std::string, double>& set = {}) {
    return powered_tool("kerf.burring", tool, "burr_cutting", set);
}
inline ToolSetup round_burr(const std::map<std::string, double>& set = {}) { return burr_of("round_burr", set); }

inline constexpr double ball = 2e-3;  ///< [m] radius of the default round burr

/// Averages over some ticks.
struct BurrFelt {
    Vec6 wrench{};  ///< bone on burr, world frame, about the tip
    burring::BurrCutting::Signals signals;
};

/// A ball burr that is led: its centre along a way, its shaft leaning from the vertical.
class LedBurr {
public:
    /// @param centre  of the ball [m]
    /// @param lean    [rad] of the shaft, away from the way (+x) so that the tip goes ahead; turned by `about` around z
    LedBurr(Body body, const ToolSetup& setup, Vec3 centre, double lean = 0.0, double period = Simulation::dt,
            double about = 0.0, double radius = ball)
        : centre_(centre),
          lean_(lean),
          about_(about),
          radius_(radius),
          dt_(period),
          rig_(std::move(body), setup, pose(), test::gains(), period) {}

    /// One tick; the centre moves at `velocity` [m/s].
    TickResult go(Vec3 velocity) {
        centre_ = centre_ + dt_ * velocity;
        return rig_.tick_direct({pose()});
    }
    /// Moves the centre to a point, at `speed` [m/s].
    void to(Vec3 target, double speed) {
        const Vec3 way = target - centre_;
        const auto ticks = static_cast<int>(std::ceil(length(way) / (speed * dt_)));
        for (int i = 0; i < ticks; ++i) (void)go((1.0 / (ticks * dt_)) * way);
    }
    BurrFelt mean(Vec3 velocity, int ticks) {
        BurrFelt sum;
        for (int i = 0; i < ticks; ++i) {
            const TickResult r = go(velocity);
            const auto signals = signals_of<burring::BurrCutting>(rig_.signals());
            for (std::size_t c = 0; c < 6; ++c) sum.wrench[c] += r.bone_on_tool[c] / ticks;
            sum.signals.cutting_force += signals.cutting_force / ticks;
            sum.signals.side_pull += signals.side_pull / ticks;
            sum.signals.chip_thickness += signals.chip_thickness / ticks;
            sum.signals.engagement += signals.engagement / ticks;
            sum.signals.drive_power += signals.drive_power / ticks;
        }
        return sum;
    }
    [[nodiscard]] double removed() {
        rig_.finish();
        return rig_.present().removed();
    }
    [[nodiscard]] Vec3 centre() const noexcept { return centre_; }
    [[nodiscard]] double dt() const noexcept { return dt_; }
    [[nodiscard]] Simulation& simulation() noexcept { return rig_; }

private:
    [[nodiscard]] Pose pose() const noexcept {
        const Quat turn = quat_from_rotation_vector({0, 0, about_});
        const Vec3 along = rotate(turn, {std::sin(lean_), 0.0, -std::cos(lean_)});
        return pointing(centre_ + radius_ * along, along);
    }
    Vec3 centre_;
    double lean_, about_, radius_, dt_;
    Rig rig_;
};

}  // namespace kerf::test
