// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "plugins/implant/screw_force.h"
#include "tests/support/turned_screw.h"

/// A screw on its driver above a block of one material; the face is z = 0.
namespace kerf::test {

/// A hand that turns the screw and lets it go along the shaft as it will.
class ScrewRig {
public:
    using Signals = implant::ScrewInsertion::Signals;

    /// With a pilot hole of the radius `hole` [m]; 0: as wide as the core's tip.
    explicit ScrewRig(double density, const std::map<std::string, double>& set = {}, double period = Simulation::dt,
                      double thickness = 55e-3, double hole = 0.0)
        : rig_(pilot_block(density, thickness, hole > 0.0 ? hole : 0.5 * tip_of(set)), screw_setup(set),
               at_depth(-0.2e-3), gains(), period),
          period_(period),
          thread_(value_of<implant::PedicleScrew>(rig_.setup().tool_parameters).thread()) {
        depth_ = -0.2e-3;
    }

    /// Turns by `by` [rad] at `speed` [rad/s]. `push`: [N] of the hand along the shaft.
    void turn(double by, double speed, double push = 0.0) {
        const auto ticks = static_cast<int>(std::ceil(std::abs(by) / (speed * period_)));
        for (int i = 0; i < ticks; ++i) {
            angle_ += by / ticks;
            // As stiff as bone and thread together: the depth at which nothing pulls is found in a few ticks.
            constexpr double stiffness = 3e7;  // [N/m]
            depth_ += thread_.advance() * by / ticks + std::clamp((push - against_) / stiffness, -2e-6, 2e-6);
            last_ = rig_.tick_direct({turned_at(depth_, angle_)});
            against_ = linear(last_.bone_on_tool).z;
            for (std::size_t e = 0; e < last_.event_count; ++e) events_.emplace_back(last_.events[e]);
        }
    }
    /// Puts the tip into the hole until the thread meets bone, and turns `turns` times.
    void insert(double turns, double speed) {
        depth_ = thread_.cone();
        for (double depth = -0.2e-3; depth < depth_; depth += 20e-6) (void)rig_.tick_direct({at_depth(depth)});
        turn(2.0 * pi * turns, speed);
    }
    [[nodiscard]] Signals signals() const { return signals_of<implant::ScrewInsertion>(rig_.signals()); }
    [[nodiscard]] double depth() const noexcept { return depth_; }
    [[nodiscard]] double angle() const noexcept { return angle_; }
    [[nodiscard]] const implant::ScrewThread& thread() const noexcept { return thread_; }
    [[nodiscard]] const std::vector<std::string>& events() const noexcept { return events_; }
    [[nodiscard]] Rig& rig() noexcept { return rig_; }

private:
    static double tip_of(const std::map<std::string, double>& set) {
        return value_of<implant::PedicleScrew>(screw_setup(set).tool_parameters).tip_core_diameter;
    }

    Rig rig_;
    double period_;
    implant::ScrewThread thread_;
    double depth_ = 0.0, angle_ = 0.0, against_ = 0.0;
    TickResult last_;
    std::vector<std::string> events_;
};

}  // namespace kerf::test
