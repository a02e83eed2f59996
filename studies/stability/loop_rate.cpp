// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/haptics/loop/work_force.h"
#include "studies/rms.h"
#include "studies/scenes/bone_block.h"
#include "studies/stability/led_tool.h"
#include "studies/stability/scenes.h"

namespace kerf::stability {

namespace {

constexpr double above = -0.5e-3, way = 4e-3;  // [m] from where, and how far
const BoneBlock block{.thickness = 8e-3};
constexpr double min_torque =
    0.07;  // [–] of what the thrust gives at the rim: a hand tells no less, and a blade's teeth cancel

struct Drilled {
    std::vector<double> thrust, torque;  ///< at equal ways [N, N·m]
    double removed = 0.0;                ///< [m³]
};

/// The same way of the hand at the same speed, with ticks of another length.
Drilled drill(const LedTool& tool, double hand_way, double feed, double period) {
    constexpr double samples = 125.0, longest_tick = 2e-3;  // sampled at whole ticks of whatever length
    const auto ticks_in = [&](double seconds) { return static_cast<int>(std::lround(seconds / period)); };
    const double seconds = hand_way / feed;
    const int every = ticks_in(longest_tick * std::round(seconds / samples / longest_tick));
    for (int i = 0; i < ticks_in(run_up * Simulation::dt); ++i) tool.move(0.0);
    Drilled drilled;
    for (int i = 1; i <= ticks_in(seconds); ++i) {
        tool.move(feed);
        if (i % every != 0) continue;
        drilled.thrust.push_back(tool.thrust());
        drilled.torque.push_back(tool.torque());
    }
    return drilled;
}

/// RMS of the difference, of the RMS of the first [–].
double apart(const std::vector<double>& a, const std::vector<double>& b) {
    double difference = 0.0, whole = 0.0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        difference += (a[i] - b[i]) * (a[i] - b[i]);
        whole += a[i] * a[i];
    }
    return std::sqrt(difference / whole);
}

/// Who makes the force: a law of the papers or the plugin's at a prescribed motion, or the plugin's, solved.
enum class Rendering { printed, prescribed, solved };

Drilled drill_with(Rendering how, const ToolUnderTest& tool, const CouplingGains& gains, const Body& body, double push,
                   double feed, double period) {
    if (how == Rendering::printed) {
        papers::PrintedLoop loop(block, body.grid(), tool.setup, at_depth(above), period);
        return drill(led_by(loop, tool.setup, above, 0.0, period), way, feed, period);
    }
    KerfLoop loop(body, tool.setup, gains, above,
                  how == Rendering::solved ? KerfLoop::Rendering::solved : KerfLoop::Rendering::direct, 0.0, period);
    // Solved: as far again as the push stretches the coupling, or the tool would hardly have set out.
    const double hand_way = how == Rendering::solved ? way + push / gains.stiffness : way;
    Drilled drilled = drill(led_by(loop, above, period), hand_way, feed, period);
    loop.simulation().finish();
    drilled.removed = loop.simulation().present().removed();
    return drilled;
}

/// With the strongest motor, which keeps its speed at every feed here.
ToolUnderTest strong(ToolUnderTest tool) {
    if (const auto torque = tool_parameter(tool.setup, "motor_torque"))
        tool.setup.tool_parameters[*torque] = tool.setup.tool->params[*torque].max;
    return tool;
}

void look_at(Rendering how, const ToolUnderTest& tool, const Scope& scope, const Body& body, Finding finding,
             const Report& report) {
    const DeviceRecord& device = scope.devices.front();
    if (how == Rendering::solved) finding.device = device.id;
    for (const double feed : {0.5e-3, 2e-3, 8e-3}) {
        // Scaled so that the push feeds the tool at this rate.
        const double push = push_of(device);
        const CouplingGains gains =
            how == Rendering::printed
                ? CouplingGains{}
                : in_hands(gains_for(device, std::min(1.0, push / work_force(tool.setup, body, feed))));
        const auto at = [&](double period) { return drill_with(how, tool, gains, body, push, feed, period); };
        const Drilled at_1_khz = at(1e-3);
        for (const double period : {2e-3, 0.5e-3, 0.25e-3}) {
            const Drilled other = at(period);
            const double thrust = apart(at_1_khz.thrust, other.thrust), torque = apart(at_1_khz.torque, other.torque);
            const bool torque_counts = rms(at_1_khz.torque) >= min_torque * rms(at_1_khz.thrust) * tool.radius;
            const double removed = how == Rendering::printed ? 0.0 : other.removed / at_1_khz.removed - 1.0;
            finding.measured =
                figure(1e3 * feed, "mm/s, ") + figure(1.0 / period, "Hz") + ": thrust " + figure(100.0 * thrust, "%") +
                ", torque " + (torque_counts ? figure(100.0 * torque, "%") : "next to none") +
                (how == Rendering::printed ? "" : ", bone taken " + figure(100.0 * removed, "%")) + " off 1000 Hz";
            finding.outcome = passes(thrust <= 0.02 && (!torque_counts || torque <= 0.02) && std::abs(removed) <= 0.02);
            report(finding);
        }
    }
}

}  // namespace

void check_loop_rate(const Scope& scope, const ToolUnderTest& of, std::span<const ToolUnderTest> printed,
                     const Report& report) {
    const Body body = make(block);
    const auto finding_of = [](const std::string& scene, Method method) {
        return Finding{.test = "P-05", .scene = scene, .method = method, .hand = led, .criterion = "each within 2 %"};
    };
    Finding as_printed = finding_of("loop rate, prescribed feed", Method::as_printed);
    if (printed.empty()) {
        as_printed.reason = papers::no_papers;
        report(as_printed);
    }
    for (const ToolUnderTest& tool : printed) {
        as_printed.reason = std::string(tool.law) + ": its bone stays until the drilling ends";
        look_at(Rendering::printed, tool, scope, body, as_printed, report);
    }
    const ToolUnderTest tool = strong(of);
    look_at(Rendering::prescribed, tool, scope, body, finding_of("loop rate, prescribed feed", Method::kerf), report);
    look_at(Rendering::solved, tool, scope, body, finding_of("loop rate, solved", Method::kerf), report);
}

}  // namespace kerf::stability
