// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/plan/going.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "studies/times.h"

namespace kerf::plan {

namespace {

constexpr int run_up = 600;  // [ticks] a motor is given to come to its speed

Pose at(const Way& way, double gone) {
    return way.start * Pose{gone * way.direction, quat_from_rotation_vector({0, 0, gone * way.turn})};
}

int ticks_of(const Way& way) { return static_cast<int>(std::ceil(way.length / (way.feed * Simulation::dt))); }

double share(double difference2, double whole2) { return whole2 > 0.0 ? std::sqrt(difference2 / whole2) : 0.0; }

}  // namespace

bool go(const Body& body, const ToolSetup& setup, const Way& way, Met& met, std::string& error) {
    ToolOutline outline;
    if (!outline_of(setup, outline, error)) return false;
    Simulation simulation(body, setup, outline,
                          CouplingGains{.stiffness = 1.0, .force_limit = 1.0, .torque_limit = 1.0}, way.start);
    const auto tick = [&](double gone) {
        const TickResult result = simulation.tick_direct({at(way, gone)});
        return result;
    };
    for (int i = 0; i < run_up; ++i) (void)tick(0.0);
    met = {};
    const int ticks = ticks_of(way);
    int cutting = 0;
    for (int i = 1; i <= ticks; ++i) {
        const TickResult result = tick(std::min(way.length, way.feed * Simulation::dt * i));
        met.force.push_back(linear(result.bone_on_tool));
        met.torque.push_back(result.torque);
        cutting += result.is_cutting;
    }
    simulation.finish();
    met.removed = simulation.present().removed();
    met.removes = static_cast<double>(cutting) / ticks;
    return true;
}

Cost cost_of(const Body& body, const ToolSetup& setup, const CouplingGains& gains, const Way& way) {
    ToolOutline outline;
    std::string error;
    if (!outline_of(setup, outline, error)) return {};
    Simulation simulation(body, setup, outline, gains, way.start);
    for (int i = 0; i < run_up; ++i) {
        (void)simulation.tick({way.start});
    }
    std::vector<double> microseconds;
    const int ticks = ticks_of(way);
    for (int i = 1; i <= ticks; ++i) {
        const DeviceSample sample{at(way, std::min(way.length, way.feed * Simulation::dt * i))};
        microseconds.push_back(processor_time_of([&] { (void)simulation.loop().tick(sample); }));
        simulation.follow();
    }
    const Times times = times_of(std::move(microseconds));
    return {times.median, times.p999, times.longest};
}

Apart apart(const Met& met, const Met& reference) {
    double force = 0.0, forces = 0.0, torque = 0.0, torques = 0.0;
    for (std::size_t i = 0; i < std::min(met.force.size(), reference.force.size()); ++i) {
        const Vec3 d = met.force[i] - reference.force[i];
        force += dot(d, d);
        forces += dot(reference.force[i], reference.force[i]);
        torque += (met.torque[i] - reference.torque[i]) * (met.torque[i] - reference.torque[i]);
        torques += reference.torque[i] * reference.torque[i];
    }
    return {share(force, forces), share(torque, torques),
            reference.removed > 0.0 ? std::abs(met.removed / reference.removed - 1.0) : 0.0};
}

}  // namespace kerf::plan
