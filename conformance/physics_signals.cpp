// SPDX-License-Identifier: Apache-2.0
// Level 4: signals against what the law did.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "conformance/law_probe.h"
#include "conformance/test_groups.h"

namespace kerf::conformance {

namespace {

constexpr double speed = 0.5e-3;  // [m/s] slow enough for any motor
constexpr kerf_dimension of_force{{1, 1, -2, 0, 0, 0, 0, 0}}, of_frequency{{0, 0, -1, 0, 0, 0, 0, 0}};

bool is_same(const kerf_dimension& a, const kerf_dimension& b) {
    return std::equal(std::begin(a.exponent), std::end(a.exponent), std::begin(b.exponent));
}

/// All forces of the law in hand at a rate [N], channels and what follows them.
double forces_of(const LawWalk& law, const Vec6& rate) {
    double sum = std::hypot(law.law().wrench[0], law.law().wrench[1], law.law().wrench[2]);
    for (const kerf_channel& c : law.channels()) {
        const double lambda = std::abs(channel_force(c, dot(direction(c), rate), law.dt()).lambda);
        sum += lambda *
               (std::max(1.0, std::hypot(c.d[0], c.d[1], c.d[2])) + std::hypot(c.follow[0], c.follow[1], c.follow[2]));
    }
    return sum;
}

void reports_its_forces(Examination& exam) {
    const kerf_force& force = *exam.subject->force->force;
    WalkSettings settings;
    std::vector<double> largest(force.signal_count, 0.0);
    double forces = 0.0;
    const std::vector<Pose> path = eventful_path();
    std::size_t at = 0;
    walk(
        exam, settings, path,
        [&](LawWalk& law) {
            forces = std::max(forces, forces_of(law, law.rate_to(path[++at])));
            return true;
        },
        [&](LawWalk& law) {
            for (std::uint32_t i = 0; i < force.signal_count; ++i)
                largest[i] = std::max(largest[i], std::abs(law.signals()[i]));
            return true;
        });
    if (exam.status() != Status::passed) return;
    for (std::uint32_t i = 0; i < force.signal_count; ++i) {
        if (!is_same(force.signals[i].dimension, of_force)) continue;
        const std::string text = "On a path in and out of bone its signal `" + std::string(force.signals[i].id) +
                                 "` is up to " + number(largest[i]) + " N; all its forces together are up to " +
                                 number(forces) + " N";
        if (largest[i] > 1.2 * forces + 1e-9)
            return exam.fail(text + ", expected no more. Report the force of the channels.");
        if (largest[i] > 0.0 && largest[i] < 2e-3 * forces)
            return exam.fail(text + ", expected a force of that size. Report it in newtons.");
    }
}

void reports_its_speeds(Examination& exam) {
    const kerf_force& force = *exam.subject->force->force;
    const kerf_tool& tool = *exam.subject->tool->tool;
    const kerf_drive* drive = nullptr;
    for (std::uint32_t i = 0; i < tool.drive_count; ++i)
        if (is_same(tool.drives[i].dimension, of_frequency) && tool.drives[i].def > 0.0) {
            if (drive != nullptr) return exam.skip("the tool has several drives of a frequency");
            drive = tool.drives + i;
        }
    if (drive == nullptr) return exam.skip("the tool has no drive of a frequency");
    const auto signals_at = [&](double fraction) {
        WalkSettings settings;
        settings.bone.shape = PlaneBone::Shape::air;
        settings.drives = drives_at(*exam.subject->tool, fraction);
        LawProbe probe(*exam.subject, settings);
        return probe.move(at_depth(-1.0), {}, 20).signals;
    };
    const std::vector<double> full = signals_at(1.0), half = signals_at(0.5);
    for (std::uint32_t i = 0; i < force.signal_count && i < full.size() && i < half.size(); ++i) {
        if (!is_same(force.signals[i].dimension, of_frequency) || full[i] == 0.0) continue;
        const double expected = std::clamp(0.5 * drive->def, drive->min, drive->max) / drive->def,
                     got = half[i] / full[i];
        if (std::abs(full[i]) > 1.05 * drive->max || std::abs(got - expected) > 0.05)
            return exam.fail("Running in air, its signal `" + std::string(force.signals[i].id) + "` is " +
                             number(full[i]) + " 1/s with `" + drive->id + "` at " + number(drive->def) + " 1/s, and " +
                             number(half[i]) + " 1/s at half of that, expected a speed that follows the drive.");
    }
}

void reports_nothing_in_air(Examination& exam) {
    const kerf_force& force = *exam.subject->force->force;
    WalkSettings settings;
    std::vector<double> largest(force.signal_count, 0.0), last(force.signal_count, 0.0);
    std::vector<Pose> path = short_path();
    const std::size_t in_air = path.size();
    for (int i = 0; i < 200; ++i) path.push_back(at_depth(-2e-3 - 1e-6 * i));
    walk(exam, settings, path, {}, [&](LawWalk& law) {
        for (std::uint32_t i = 0; i < force.signal_count; ++i) {
            last[i] = std::abs(law.signals()[i]);
            largest[i] = std::max(largest[i], last[i]);
        }
        return true;
    });
    static_cast<void>(in_air);
    for (std::uint32_t i = 0; i < force.signal_count; ++i)
        if (is_same(force.signals[i].dimension, of_force) && last[i] > 0.02 * largest[i] + 1e-9)
            return exam.fail("After 0.2 s in air its signal `" + std::string(force.signals[i].id) + "` is " +
                             number(last[i]) + " N, in bone it was up to " + number(largest[i]) +
                             " N, expected none: no bone is near.");
}

constexpr int long_time = 40;  // [s] of processor time
constexpr Test tests[] = {
    {"physics.force_signals", 4, Scope::law, "A signal of a force is no more than its forces.", &reports_its_forces,
     "law.sound", long_time},
    {"physics.speed_signals", 4, Scope::law, "A signal of a speed follows the drive.", &reports_its_speeds, "law.sound",
     long_time},
    {"physics.air_signals", 4, Scope::law, "A signal of a force ends in air.", &reports_nothing_in_air, "law.sound",
     long_time},
};

}  // namespace

std::span<const Test> physics_signal_tests() { return tests; }

}  // namespace kerf::conformance
