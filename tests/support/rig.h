// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "core/haptics/scene/simulation.h"
#include "tests/support/block.h"
#include "tests/support/made_outline.h"

namespace kerf::test {

/// Gains of the default device at a scale of 1/100.
inline CouplingGains gains(double scale = 0.01) { return gains_for(*find_device("premium-1.5-6dof"), scale); }

/// A drill at `depth` of its tip below the face z = 0, straight down, tilted by `tilt` about y.
inline Pose at_depth(double depth, double tilt = 0.0, Vec3 entry = {0, 0, 0}) {
    const Vec3 along{std::sin(tilt), 0, -std::cos(tilt)};
    return pointing(entry + depth * along, along);
}

/// The bone of a rig, which its simulation refers to.
class KeptBody {
public:
    explicit KeptBody(Body body) : body_(std::move(body)) {}
    [[nodiscard]] const Body& body() const noexcept { return body_; }

private:
    Body body_;
};

/// A tool at `start` in a bone made for the question: a simulation that keeps its bone.
class Rig : public KeptBody, public Simulation {
public:
    Rig(Body body, const ToolSetup& setup, const Pose& start, const CouplingGains& gains = test::gains(),
        double period = Simulation::dt)
        : Rig(std::move(body), setup, test::outline(setup), start, gains, period) {}
    Rig(Body body, const ToolSetup& setup, ToolOutline outline, const Pose& start,
        const CouplingGains& gains = test::gains(), double period = Simulation::dt)
        : KeptBody(std::move(body)), Simulation(KeptBody::body(), setup, std::move(outline), gains, start, period) {}

    /// Feeds the clamped tool straight down or up from one depth to the other, by `step` a tick [m]. Returns the last
    /// tick.
    TickResult feed(double from, double to, double step) {
        TickResult result;
        for (double depth = from; from < to ? depth < to : depth > to; depth += from < to ? step : -step)
            result = tick_direct({at_depth(depth)});
        return result;
    }
};

}  // namespace kerf::test
