// SPDX-License-Identifier: Apache-2.0
// Level 3: a law over its parameters, drives, bones, ticks and motions.
#include <cmath>
#include <string>
#include <vector>

#include "conformance/law_walk.h"
#include "conformance/parameter_sets.h"
#include "conformance/test_groups.h"
#include "kerf/units.hpp"

namespace kerf::conformance {

namespace {

/// Walks with these settings; a fault's text begins with what they are.
void is_sound_with(Examination& exam, const WalkSettings& settings, const std::string& what,
                   const std::vector<Pose>& path) {
    Examination one(exam.path, exam.subject);
    walk(one, settings, path, [&](LawWalk& law) {
        std::string fault = fault_of_numbers(law);
        if (fault.empty()) fault = fault_of_channels(law);
        if (!fault.empty()) one.fail(fault);
        return !one.has_failed();
    });
    if (one.has_failed()) exam.fail("With " + what + ": " + one.text());
}

void takes_its_parameters(Examination& exam) {
    for (const ParameterSet& set : parameter_sets(*exam.subject->force, 12)) {
        WalkSettings settings;
        settings.force_parameters = set.values;
        is_sound_with(exam, settings, set.name, coarse_path());
        if (exam.has_failed()) return;
    }
}

void takes_all_tools(Examination& exam) {
    for (const ParameterSet& set : parameter_sets(*exam.subject->tool, 12)) {
        WalkSettings settings;
        settings.tool_parameters = set.values;
        is_sound_with(exam, settings, set.name + " of the tool", coarse_path());
        if (exam.has_failed()) return;
    }
}

void takes_its_drives(Examination& exam) {
    for (const ParameterSet& set : drive_sets(*exam.subject->tool)) {
        WalkSettings settings;
        settings.drives = set.values;
        is_sound_with(exam, settings, set.name, short_path());
        if (exam.has_failed()) return;
    }
}

void takes_any_tick(Examination& exam) {
    for (const double dt : {0.1e-3, 0.25e-3, 0.5e-3, 2e-3, 4e-3}) {
        WalkSettings settings;
        settings.dt = dt;
        is_sound_with(exam, settings, "ticks of " + number(1e3 * dt) + " ms", coarse_path());
        if (exam.has_failed()) return;
    }
}

void takes_any_bone(Examination& exam) {
    const auto try_bone = [&](const PlaneBone::Settings& bone, const std::string& what) {
        WalkSettings settings;
        settings.bone = bone;
        if (!exam.has_failed()) is_sound_with(exam, settings, what, coarse_path());
    };
    for (const double density : {0.0, 1.0, 100.0, 3000.0})
        try_bone({.density = density}, "bone of " + number(density) + " kg/m³");
    for (const std::uint32_t tissues : {1u, 3u, 4u})
        try_bone({.tissues = tissues}, std::to_string(tissues) + " tissue(s)");
    for (const double share : {0.0, 0.5}) try_bone({.fraction_of_first = share}, "mixed tissues");
    for (const double voxel : {0.05e-3, 1e-3}) try_bone({.voxel = voxel}, "voxels of " + number(1e3 * voxel) + " mm");
    for (const double thickness : {0.2e-3, 1e-3})
        try_bone({.thickness = thickness}, "a plate of " + number(1e3 * thickness) + " mm");
    try_bone({.shape = PlaneBone::Shape::endless}, "bone on all sides");
}

void takes_any_motion(Examination& exam) {
    std::vector<Pose> leaps;
    for (const double depth : {-5e-3, 30e-3, 0.0, -100e-3, 1e-3})
        for (const double tilt : {0.0, 0.5 * pi, pi - 0.01}) leaps.push_back(at_depth(depth, tilt, {depth, 0, 0}));
    is_sound_with(exam, {}, "a hand that leaps", leaps);
}

constexpr Test tests[] = {
    {"range.parameters", 3, Scope::law, "It is sound over all of its parameters.", &takes_its_parameters, "law.sound",
     6},
    {"range.tools", 3, Scope::law, "It is sound over all parameters of its tool.", &takes_all_tools, "law.sound", 6},
    {"range.drives", 3, Scope::law, "It is sound at every setting of its drives.", &takes_its_drives, "law.sound"},
    {"range.ticks", 3, Scope::law, "It is sound for every length of the tick.", &takes_any_tick, "law.sound"},
    {"range.bone", 3, Scope::law, "It is sound in any bone.", &takes_any_bone, "law.sound"},
    {"range.motion", 3, Scope::law, "It is sound whatever the hand does.", &takes_any_motion, "law.sound"},
};

}  // namespace

std::span<const Test> range_tests() { return tests; }

}  // namespace kerf::conformance
