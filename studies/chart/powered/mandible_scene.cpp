// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kerf/units.hpp"
#include "studies/chart/powered/exact_saw.h"
#include "studies/chart/powered/powered_scene.h"
#include "studies/chart/setting.h"

namespace kerf::chart {

using namespace literals;

namespace {

/// From the gonion up the ramus and forwards along the body, both as wide as a band; seen from the side: y out of the
/// cut towards the bone that stays, z along the cut.
constexpr double gonial_angle = 124.8_deg, ramus_width = 31.3_mm, thickness = 10.0_mm, rounding = 2.0_mm;  // E.3
constexpr double cortex = 2.1_mm;          // of buccal and lingual plate, E.3
constexpr double beside_gonion = 12.0_mm;  // of the cut's plane, from the middle of the corner
constexpr double half_length = 60.0_mm;    // of either band: longer than the cut can reach

double to_band(double y, double z, double direction) {
    const double along_y = std::cos(direction), along_z = std::sin(direction);
    const double at = std::clamp(y * along_y + z * along_z, 0.0, half_length);
    return std::hypot(y - at * along_y, z - at * along_z) - 0.5 * ramus_width;
}

/// Signed distance to the outside, the edges of the plate rounded.
double outside(Vec3 p) {
    const double seen = std::min(to_band(p.y, p.z, 0.5 * gonial_angle), to_band(p.y, p.z, -0.5 * gonial_angle));
    const double a = seen + rounding, b = std::abs(p.x) - 0.5 * thickness + rounding;
    return std::min(std::max(a, b), 0.0) + std::hypot(std::max(a, 0.0), std::max(b, 0.0)) - rounding;
}

/// The blade's long axis, half way between its edges.
TorqueLine long_axis(double height) { return {{0, 0, -0.5 * height}, {1, 0, 0}}; }

}  // namespace

PoweredScene mandible_scene() {
    constexpr double height = 10.0_mm, turned = 3.0_deg, feed = 4.0_mm_per_s;
    constexpr double straight = 9.0_mm, twisted = 6.0_mm, last = 9.0_mm;  // of the way: the cut is 22 mm long
    PoweredScene scene;
    scene.id = "mandible-twist";
    scene.title = "Angle of a mandible, reciprocating blade at 4 mm/s, twisted by 3 deg and back in its slot";
    scene.note = "Reference: exact until it twists, then a replay.";
    scene.cutter = "reciprocating saw";
    // As in procedures/mandibular-angle-reduction.yaml
    scene.tool = {.plugin = "kerf.sawing",
                  .tool = "reciprocating_blade",
                  .force = "reciprocating_cutting",
                  .set = {{"blade_length", 50.0_mm},
                          {"blade_height", height},
                          {"stroke", 3.0_mm},
                          {"tooth_pitch", 1.41_mm},
                          {"blade_thickness", 0.6_mm},
                          {"tooth_set", 0.3_mm},
                          {"stroke_rate", 15000.0_rpm},
                          {"run_up", 0.0},          // the motor follows at once
                          {"motor_torque", 5.0}}};  // [N·m] and never gives way
    scene.spacing_sweep = {0.5_mm, 0.25_mm, 0.125_mm};
    scene.feed = scene.trial_feed = feed;
    scene.trial_depth = 4.0_mm;
    scene.working_force = 30.0;
    scene.needs = StraightSaw::parameters();
    scene.exact = [](const PoweredScene& in, const Values& values) -> std::unique_ptr<ExactCut> {
        return std::make_unique<ExactSaw>(in.bone, StraightSaw(values));
    };
    scene.line = long_axis(height);
    scene.rivals = {{.id = "M7",
                     .title = "impulses at the teeth's rate, on fields",
                     .setup = {"papers.sawing", "reciprocating_blade", "reciprocating_impulse", scene.tool.set},
                     .scale = "mass"},
                    {.id = "004",
                     .title = "mandibular-angle, as printed, on fields",
                     .setup = {"papers.as_printed",
                               "paper_reciprocating_saw",
                               "mandibular_saw",
                               {{"length", 50.0_mm},
                                {"height", height},
                                {"stroke", 3.0_mm},
                                {"kerf", 1.2_mm},
                                {"reciprocation", 15000.0_rpm}}},
                     .points = "points",
                     .usual_points = 86,
                     .more_points = 0.5,
                     .scale = "mass",
                     .is_as_printed = true}};

    // The cut is a plane 12 mm outside the corner's middle, across the plate; z = 0 where it enters.
    double entry = 0.0;
    while (outside({0, -beside_gonion, entry + 1.0_um}) < 0.0) entry += 1.0_um;
    const auto in_mandible = [entry](Vec3 p) { return Vec3{p.x, p.y - beside_gonion, p.z + entry}; };
    scene.bone.surface = [=](Vec3 p) { return outside(in_mandible(p)); };
    scene.bone.tissues = {{"cancellous", 500.0, [=](Vec3 p) { return outside(in_mandible(p)) + cortex; }},
                          {"cortical", 1850.0, {}}};

    const Quat down = quat_between({0, 0, 1}, {0, 0, -1});
    scene.path = {{{0, 0, 1.0_mm}, down}};
    go_straight(scene.path, {0, 0, -straight}, feed);
    const auto ticks = static_cast<int>(std::lround(twisted / (feed * dt)));
    for (int i = 1; i <= ticks; ++i) {
        const double share = static_cast<double>(i) / ticks, angle = 0.5 * turned * (1.0 - std::cos(2.0 * pi * share));
        const Vec3 axis{0, 0, -0.5 * height};
        const Quat turn = quat_from_rotation_vector({angle, 0, 0});
        const Pose untwisted{{0, 0, -straight - share * twisted}, down};
        scene.path.push_back(untwisted * Pose{axis - rotate(turn, axis), turn});
    }
    go_straight(scene.path, {0, 0, -straight - twisted - last}, feed);
    scene.bone.low = {-0.5 * thickness - 1.0_mm, -3.0_mm, -straight - twisted - last - 2.0_mm};
    scene.bone.high = {0.5 * thickness + 1.0_mm, 3.0_mm, 1.5_mm};
    return scene;
}

}  // namespace kerf::chart
