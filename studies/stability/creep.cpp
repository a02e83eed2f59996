// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "kerf/units.hpp"
#include "studies/papers/printed_loop.h"
#include "studies/scenes/bone_block.h"
#include "studies/stability/kerf_loop.h"
#include "studies/stability/scenes.h"
#include "studies/worst.h"

namespace kerf::stability {

namespace {

constexpr double spacing = 0.25e-3, above = -1e-3;  // [m]
constexpr double slow_turning = 1.0;                // [1/s]
constexpr double hard = 1850.0, soft = 585.0;       // [kg/m³] the law takes the square: 10 : 1

struct Way {
    const char* name;
    Vec3 along;
};

struct Crept {
    double force = 0.0, step = 0.0, swing = 0.0;  ///< [N] thrust before, its largest change in a tick, least to most
};

/// A tool that is where it is told to be.
struct Prescribed {
    std::function<double(double depth)> thrust_at;  ///< [N] in a tick in which it goes so deep [m]
    std::function<void(bool is_slow)> turn;  ///< at its usual speed, or so slowly that a tick's turn is next to nothing
};

/// Into the bone at a usual feed, then on at 0.01 mm/s: to where its thrust is taken for the force, and, from `from`, a
/// `way` over which where points lie in grid and tissue is all that changes. So it turns slowly there: askew to a
/// border the thrust of turning lips goes up and down by half of it, and by a fifth in a tick at 1000 rpm.
Crept creep(const Prescribed& tool, double engaged, double from, double way) {
    constexpr double usual = 2e-3, slow = 0.01e-3, settle = 5e-6;  // [m/s], [m]
    double depth = above;
    const auto go = [&](double speed) { return tool.thrust_at(depth += speed * Simulation::dt); };
    const auto stay = [&] {
        for (int i = 0; i < run_up; ++i) (void)go(0.0);
    };
    const auto settled = [&] {
        tool.turn(true);
        stay();
        double thrust = 0.0;
        for (const double until = depth + settle; depth < until;) thrust = go(slow);
        return thrust;
    };
    stay();
    while (depth < engaged) (void)go(usual);
    Crept crept{.force = settled()};
    if (depth < from) {
        tool.turn(false);
        stay();
        while (depth < from) (void)go(usual);
        (void)settled();
    }
    std::vector<double> thrust;
    for (const double until = depth + way; depth < until;) thrust.push_back(go(slow));
    for (std::size_t i = 1; i < thrust.size(); ++i) crept.step = worst(crept.step, std::abs(thrust[i] - thrust[i - 1]));
    const auto [low, high] = std::minmax_element(thrust.begin(), thrust.end());
    crept.swing = *high - *low;
    return crept;
}

/// The depth nearest to this one at which voxels meet: half a voxel beside their centres.
double at_a_face(const Grid& grid, double depth) {
    return -(grid.origin.z + (std::floor((-depth - grid.origin.z) / grid.spacing) + 0.5) * grid.spacing);
}

/// One law along one way: through bone of one tissue, and over a border along a face of its voxels.
struct Place {
    BoneBlock block;
    Body body;
};

Crept creep_in(const Place& place, const ToolUnderTest& tool, const CouplingGains& gains, Vec3 along, Method method) {
    const Vec3 direction = normalized(along);
    const Quat turned = quat_between({0, 0, 1}, direction);
    const auto at = [&](double depth) { return Pose{depth * direction, turned}; };
    const double spread =
        tool.radius * std::tan(std::acos(-direction.z));  // along the plane's normal a rim is so much deeper
    const double engaged = 1.5e-3 + (tool.full_depth + spread) / -direction.z;
    // Over a border: half of the lips' depth is past it in the middle of the way.
    constexpr double way = spacing;
    const double from =
        place.block.shell > 0.0 ? place.block.shell / -direction.z + 0.5 * (tool.full_depth - way) : engaged;
    const double usual = tool.setup.drives.empty() ? 0.0 : tool.setup.drives.front();
    const auto told = [=](bool is_slow) { return is_slow ? std::min(usual, slow_turning) : usual; };
    if (method == Method::as_printed) {
        papers::PrintedLoop loop(place.block, place.body.grid(), tool.setup, at(above), Simulation::dt);
        return creep({[&](double depth) {
                          loop.go(at(depth));
                          return loop.thrust();
                      },
                      [&](bool is_slow) { loop.command_drive(0, told(is_slow)); }},
                     engaged, from, way);
    }
    ToolOutline outline;
    std::string error;
    if (!outline_of(tool.setup, outline, error)) return {};
    Simulation simulation(place.body, tool.setup, outline, gains, at(above));
    const auto thrust_at = [&](double depth) {
        const double thrust = simulation.tick_direct({at(depth)}).thrust;
        return thrust;
    };
    return creep({thrust_at, [&](bool is_slow) { simulation.command_drive(0, told(is_slow)); }}, engaged, from, way);
}

Place one_tissue() {
    const BoneBlock block{.thickness = 16e-3, .spacing = spacing, .width = 24e-3};
    return {block, make(block)};
}

Place two_tissues() {
    BoneBlock block{.thickness = 16e-3, .spacing = spacing, .density = hard, .inner = soft, .width = 24e-3};
    block.shell = at_a_face(one_tissue().body.grid(), 8e-3);
    return {block, make(block)};
}

}  // namespace

void check_creep(const Scope& scope, const ToolUnderTest& tool, const ToolUnderTest* printed, const Report& report) {
    const CouplingGains gains = in_hands(gains_for(scope.devices.front(), 1.0));
    std::vector<Way> ways{{"along an edge of the grid", {0, 0, -1}}, {"across its cells", {1, 1, -1}}};
    if (!scope.is_quick) {
        ways.push_back({"across its faces", {1, 0, -1}});
        ways.push_back({"10 deg off an edge", {std::tan(10.0 * pi / 180.0), 0, -1}});
        ways.push_back({"askew", {0.2, 0.37, -1}});
    }
    for (const bool has_border : {false, true}) {
        const Place place = has_border ? two_tissues() : one_tissue();
        for (const Method method : {Method::as_printed, Method::kerf}) {
            Finding finding{.test = "S-05", .scene = "creep of 0.01 mm/s, prescribed", .method = method, .hand = led};
            if (has_border) finding.scene = "creep over a border 10 : 1 on a face";
            finding.criterion = "steps <= 1/31 of the force";
            if (method == Method::as_printed && printed == nullptr) {
                finding.reason = papers::no_papers;
                report(finding);
                continue;
            }
            for (const Way& way : ways) {
                const Crept crept = creep_in(place, method == Method::kerf ? tool : *printed, gains, way.along, method);
                if (!(crept.force > 0.0)) {
                    finding.measured = std::string(way.name) + ": no force";
                    finding.outcome = Outcome::not_applicable;
                    finding.reason = "the tool meets no bone on this way, or does not cut when it goes so slowly";
                    report(finding);
                    continue;
                }
                finding.reason = "";
                finding.measured = std::string(way.name) + ": step " + figure(100.0 * crept.step / crept.force, "%") +
                                   " of " + figure(crept.force, "N") + ", " +
                                   figure(100.0 * crept.swing / crept.force, "%") + " from least to most";
                finding.outcome = passes(crept.step <= crept.force / 31.0);
                report(finding);
            }
        }
    }
}

}  // namespace kerf::stability
