// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "kerf/units.hpp"
#include "studies/scenes/bone_block.h"
#include "studies/stability/led_tool.h"
#include "studies/stability/scenes.h"
#include "studies/worst.h"

namespace kerf::stability {

namespace {

constexpr double shell = 3e-3;                 // [m]
constexpr double hard = 1850.0, soft = 585.0;  // [kg/m³] the law takes the square: 10 : 1
constexpr double fastest_feed = 10e-3;         // [m/s] that the test asks for
constexpr double feeds[] = {0.5e-3, 2e-3, fastest_feed};
constexpr double tilted_by = 10.0;  // [deg] and 0
constexpr const char* sideways_scene = "border at 10 deg: force sideways";
constexpr double above = -0.5e-3;  // [m] where it begins

/// One tick of a crossing.
struct Moment {
    double tip = 0.0, thrust = 0.0, torque = 0.0;  ///< at the beginning of the tick [m], [N], [N·m]
    Vec3 sideways{};                               ///< [N] tool frame
    double angle = 0.0;                            ///< [rad] of the first lip
};

struct Crossing {
    double before = 0.0, after = 0.0, step = 0.0;  ///< [N] thrust on either side, its largest change in a tick
    double fastest = 0.0;                          ///< [m/s] of the tip
    std::vector<Moment> moments;                   ///< from some time before the border until some time after
};

Crossing cross(const LedTool& tool, const ToolUnderTest& of, double feed, double tilt, double period = Simulation::dt) {
    constexpr double approach = 2e-3, margin = 0.2e-3;
    const int ticks_per_nominal = static_cast<int>(std::lround(Simulation::dt / period)),
              longest = 20000 * ticks_per_nominal;
    double angle = 0.0, was = above;
    const auto go = [&](double speed) {
        was = tool.tip();
        tool.move(speed);
        angle += 2.0 * pi * tool.turning() * period;
    };
    for (int i = 0; i < run_up * ticks_per_nominal; ++i) go(0.0);
    const double spread = of.radius * std::tan(tilt);
    const double from = shell / std::cos(tilt) - spread - margin;
    const double until = shell / std::cos(tilt) + of.full_depth + spread + margin;
    for (int i = 0; i < longest && tool.tip() < from - 0.3e-3; ++i) go(approach);
    for (int i = 0; i < longest && tool.tip() < from; ++i) go(feed);
    Crossing crossing;
    crossing.before = tool.thrust();
    double last = crossing.before;
    for (int i = 0; i < longest && tool.tip() < until; ++i) {
        const double turned = angle;
        go(feed);
        crossing.fastest = std::max(crossing.fastest, (tool.tip() - was) / period);
        crossing.step = worst(crossing.step, std::abs(tool.thrust() - last));
        last = tool.thrust();
        crossing.moments.push_back({was, last, tool.torque(), tool.sideways(), turned});
    }
    crossing.after = last;
    return crossing;
}

BoneBlock two_tissues() { return {.thickness = 10e-3, .density = hard, .shell = shell, .inner = soft}; }

Finding finding_of(const std::string& scene, double tilt, const Crossing& crossing) {
    Finding finding{.test = "S-16", .scene = scene, .hand = led};
    finding.measured = figure(tilt, "deg") + ": step " + figure(100.0 * crossing.step / crossing.before, "%") +
                       " a tick, " + figure(crossing.before, "N") + " -> " + figure(crossing.after, "N");
    finding.criterion = "<= 3.2 % of the force before, a tick";
    finding.outcome = passes(crossing.step <= 0.032 * crossing.before);
    return finding;
}

// ---- the force sideways --------------------------------------------------------------------------------------------

/// A drill with two straight lips.
struct TwoLips {
    double radius, chisel, half_web;  ///< [m] where lips end and begin, and how far beside the axis they run
    double half_point;                ///< [rad]
};

std::optional<TwoLips> lips_of(const ToolSetup& setup) {
    const auto at = [&](const char* id) { return tool_parameter(setup, id); };
    if (!at("diameter") || !at("point_angle") || !at("web")) return std::nullopt;
    const double diameter = setup.tool_parameters[*at("diameter")], point = setup.tool_parameters[*at("point_angle")],
                 web = setup.tool_parameters[*at("web")];
    constexpr double chisel_angle = 55.0 * pi / 180.0;  // from the lips, standard grind
    const double half_web = 0.5 * web * diameter;
    return TwoLips{0.5 * diameter, half_web / std::sin(chisel_angle), half_web, 0.5 * point};
}

/// How far the force across the lips is off what they give by geometry alone, and that force: RMS over the crossing
/// [N].
struct Sideways {
    double off = 0.0, exact = 0.0;
};

/// How much less each length of lip gives in the soft tissue [N/m].
struct LessPerLength {
    double cutting = 0.0, radial = 0.0;
};

/// Out of a crossing without tilt, where both lips are as far in: of the torque, T = g (R² − r_c²), and of how the
/// thrust falls while the lips cross, dF/dr = −2 g_z; what pushes inwards is g_z cot p.
///
/// Source: C.2, C.4 of the project's accuracy reference.
LessPerLength less_per_length(const Crossing& straight, const TwoLips& lips) {
    const double cot = std::cos(lips.half_point) / std::sin(lips.half_point), inner = 0.5 * lips.radius,
                 outer = 0.9 * lips.radius;
    const auto thrust_at = [&](double r) {
        const auto there = std::find_if(straight.moments.begin(), straight.moments.end(),
                                        [&](const Moment& m) { return m.tip >= shell + r * cot; });
        return (there == straight.moments.end() ? straight.moments.back() : *there).thrust;
    };
    const double squares = lips.radius * lips.radius - lips.chisel * lips.chisel;
    return {(straight.moments.front().torque - straight.moments.back().torque) / squares,
            (thrust_at(inner) - thrust_at(outer)) / (2.0 * (outer - inner)) * cot};
}

/// What geometry alone says of the force across the lips while one of them is deeper in the soft tissue, the way the
/// first one runs:
///
///     F_t = −Σ ± ∫ (g √(r² − b²) + g_r b)/r dr   over what of lip ± is in the hard tissue, from r_c to R
///
/// with g and g_r what either lip gives less per length in the soft one, and b the half web, beside which lips run. For
/// b = 0 this is g (r_1 − r_2) with r_k = h/(cot p ∓ tan γ cos α) between r_c and R.
///
/// Source: C.5 of the project's accuracy reference, whose lips are radii.
double sideways_by_geometry(const Moment& m, const TwoLips& lips, const LessPerLength& less, double tilt) {
    constexpr int pieces = 400;
    const Pose tool = at_depth(m.tip, tilt);
    const double cot = std::cos(lips.half_point) / std::sin(lips.half_point), dr = (lips.radius - lips.chisel) / pieces;
    const double c = std::cos(m.angle), s = std::sin(m.angle), b = lips.half_web;
    double sum = 0.0;
    for (int i = 0; i < pieces; ++i) {
        const double r = lips.chisel + (i + 0.5) * dr, along = std::sqrt(r * r - b * b);
        const double given = (less.cutting * along + less.radial * b) / r * dr;
        for (const double side : {1.0, -1.0}) {
            const Vec3 place = tool * Vec3{side * (along * c - b * s), side * (along * s + b * c), -r * cot};
            if (place.z > -shell) sum -= side * given;
        }
    }
    return sum;
}

Sideways sideways_of(const Crossing& crossing, const TwoLips& lips, const LessPerLength& less, double tilt) {
    Sideways sum;
    for (const Moment& m : crossing.moments) {
        const double exact = sideways_by_geometry(m, lips, less, tilt),
                     n = static_cast<double>(crossing.moments.size());
        const double measured = -m.sideways.x * std::sin(m.angle) + m.sideways.y * std::cos(m.angle);
        sum.off += (measured - exact) * (measured - exact) / n;
        sum.exact += exact * exact / n;
    }
    return {std::sqrt(sum.off), std::sqrt(sum.exact)};
}

Finding finding_sideways(double tilt, double feed, const Crossing& crossing, const Crossing& straight,
                         const TwoLips& lips) {
    const Sideways sideways = sideways_of(crossing, lips, less_per_length(straight, lips), tilt * pi / 180.0);
    Finding finding{.test = "S-16", .scene = sideways_scene, .hand = led};
    finding.measured = figure(1e3 * feed, "mm/s") + ": RMS " + figure(100.0 * sideways.off / crossing.before, "%") +
                       " of the thrust off, of " + figure(100.0 * sideways.exact / crossing.before, "%");
    finding.criterion = "within 1 % of the thrust of what geometry says";
    finding.outcome = passes(sideways.off <= 0.01 * crossing.before);
    return finding;
}

// ---- who leads -----------------------------------------------------------------------------------------------------

/// The tool is where it is told to be: no device has a part in it.
void check_prescribed(const ToolUnderTest& tool, const ToolUnderTest* printed, const Report& report) {
    const BoneBlock block = two_tissues();
    const Body body = make(block);
    for (const Method method : {Method::as_printed, Method::kerf})
        for (const double feed : feeds) {
            const ToolUnderTest* of = method == Method::kerf ? &tool : printed;
            const auto tell = [&](Finding finding) {
                finding.method = method;
                report(finding);
            };
            const std::string scene = "border 10 : 1 at " + figure(1e3 * feed, "mm/s") + ", prescribed";
            if (of == nullptr) {
                tell({.test = "S-16", .scene = scene, .hand = led, .reason = papers::no_papers});
                continue;
            }
            const auto crossing_at = [&](double tilt) {
                if (method == Method::kerf) {
                    KerfLoop loop(body, of->setup, CouplingGains{}, above, KerfLoop::Rendering::direct, tilt);
                    return cross(led_by(loop, above, Simulation::dt), *of, feed, tilt);
                }
                papers::PrintedLoop loop(block, body.grid(), of->setup, at_depth(above, tilt), Simulation::dt);
                return cross(led_by(loop, of->setup, above, tilt, Simulation::dt), *of, feed, tilt);
            };
            const Crossing straight = crossing_at(0.0), tilted = crossing_at(tilted_by * pi / 180.0);
            tell(finding_of(scene, 0.0, straight));
            tell(finding_of(scene, tilted_by, tilted));
            const auto lips = lips_of(of->setup);
            if (lips)
                tell(finding_sideways(tilted_by, feed, tilted, straight, *lips));
            else
                tell({.test = "S-16",
                      .scene = sideways_scene,
                      .hand = led,
                      .reason = "known by geometry for two straight lips alone"});
        }
}

/// A hand that is where it is told to be leads the tool by the coupling. That lets the drill jump into the softer bone,
/// at a rate beyond what the test crosses at; then it is looked at in ticks so short that the tip goes no further in
/// one of them than at the test's fastest feed in a whole one. A step is as large in a short tick; a steep fall is not.
void check_led_by_spring(const Scope& scope, const ToolUnderTest& tool, const Report& report) {
    constexpr int max_parts = 16;
    const Body body = make(two_tissues());
    for (const DeviceRecord& device : scope.devices)
        for (const double tilt : {0.0, tilted_by})
            for (const double feed : feeds) {
                const CouplingGains gains = gains_under_push(device, push_of(device), tool, body);
                const auto in_parts = [&](int parts) {
                    const double period = Simulation::dt / parts, turned = tilt * pi / 180.0;
                    KerfLoop loop(body, tool.setup, gains, above, KerfLoop::Rendering::solved, turned, period);
                    return cross(led_by(loop, above, period), tool, feed, turned, period);
                };
                const std::string scene = "border 10 : 1 at " + figure(1e3 * feed, "mm/s") + ", by a spring";
                const Crossing whole = in_parts(1);
                Finding finding = finding_of(scene, tilt, whole);
                if (whole.fastest > fastest_feed) {
                    int parts = 1;
                    Crossing crossing = whole;
                    while (crossing.fastest > parts * fastest_feed && parts < max_parts) {
                        parts = std::min(max_parts, static_cast<int>(std::ceil(crossing.fastest / fastest_feed)));
                        crossing = in_parts(parts);
                    }
                    const std::string told = finding.measured;
                    finding = finding_of(scene, tilt, crossing);
                    finding.criterion = "<= 3.2 % of the force before, a tick of at most 0.01 mm";
                    finding.reason = "crosses at up to " + figure(1e3 * crossing.fastest, "mm/s") + ": tested in 1/" +
                                     std::to_string(parts) + " of a tick; in a whole one " + told;
                    if (crossing.fastest > parts * fastest_feed) finding.outcome = Outcome::not_applicable;
                }
                finding.device = device.id;
                report(finding);
            }
}

}  // namespace

void check_border(const Scope& scope, const ToolUnderTest& tool, const ToolUnderTest* printed, const Report& report) {
    check_prescribed(tool, printed, report);
    check_led_by_spring(scope, tool, report);
}

}  // namespace kerf::stability
