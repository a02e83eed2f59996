// SPDX-License-Identifier: Apache-2.0
// Level 4: signals against what the law did.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "conformance/law_probe.h"
#include "conformance/test_groups.h"
#include "kerf/units.hpp"

namespace kerf::conformance {

namespace {

bool is_same(const kerf_dimension& a, const kerf_dimension& b) {
    return std::equal(std::begin(a.exponent), std::end(a.exponent), std::begin(b.exponent));
}

/// The farthest that a point of the tool's outline lies from its tip [m].
double longest_lever(const ToolOutline& outline) {
    double lever = outline.thread_radius;
    for (const kerf_profile_point& p : outline.profile) lever = std::max(lever, std::hypot(p.z, p.radius));
    return lever;
}

/// The largest that each signal was on a path, and its bounds.
struct Recorded {
    std::vector<double> largest;
    double forces = 0.0, torques = 0.0;  ///< [N] all forces together; [N m] those at the longest lever, and all torques
};

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

/// All torques of the law in hand at a rate [N m], channels and what follows them, about the tip.
double torques_of(const LawWalk& law, const Vec6& rate) {
    double sum = std::hypot(law.law().wrench[3], law.law().wrench[4], law.law().wrench[5]);
    for (const kerf_channel& c : law.channels()) {
        const double lambda = std::abs(channel_force(c, dot(direction(c), rate), law.dt()).lambda);
        sum += lambda * (std::hypot(c.d[3], c.d[4], c.d[5]) + std::hypot(c.follow[3], c.follow[4], c.follow[5]));
    }
    return sum;
}

Recorded record(Examination& exam) {
    const kerf_force& force = *exam.subject->force->force;
    Recorded recorded{std::vector<double>(force.signal_count, 0.0)};
    const std::vector<Pose> path = eventful_path();
    std::size_t at = 0;
    walk(
        exam, {}, path,
        [&](LawWalk& law) {
            const Vec6 rate = law.rate_to(path[++at]);
            const double forces = forces_of(law, rate);
            recorded.forces = std::max(recorded.forces, forces);
            recorded.torques =
                std::max(recorded.torques, torques_of(law, rate) + forces * longest_lever(law.outline()));
            return true;
        },
        [&](LawWalk& law) {
            for (std::uint32_t i = 0; i < force.signal_count; ++i)
                recorded.largest[i] = std::max(recorded.largest[i], std::abs(law.signals()[i]));
            return true;
        });
    return recorded;
}

void reports_its_torques(Examination& exam) {
    const kerf_force& force = *exam.subject->force->force;
    const Recorded recorded = record(exam);
    if (exam.status() != Status::passed) return;
    for (std::uint32_t i = 0; i < force.signal_count; ++i)
        if (is_same(force.signals[i].dimension, dimension::torque) &&
            recorded.largest[i] > 1.2 * recorded.torques + 1e-9)
            return exam.fail("On a path in and out of bone its signal `" + std::string(force.signals[i].id) +
                             "` is up to " + number(1e3 * recorded.largest[i]) +
                             " N mm; all its torques, and all its forces at the far end of the tool, are up to " +
                             number(1e3 * recorded.torques) +
                             " N mm, expected no more. Report the torque of the channels in newton metres.");
}

/// Returns the index of the only signal of a dimension; -1 if there is none or more than one.
int only_signal(const kerf_force& force, const kerf_dimension& dimension) {
    int found = -1;
    for (std::uint32_t i = 0; i < force.signal_count; ++i)
        if (is_same(force.signals[i].dimension, dimension)) {
            if (found >= 0) return -1;
            found = static_cast<int>(i);
        }
    return found;
}

void reports_its_power(Examination& exam) {
    const kerf_force& force = *exam.subject->force->force;
    const int power = only_signal(force, dimension::power), frequency = only_signal(force, dimension::frequency);
    if (power < 0 || frequency < 0) return;
    LawProbe probe(*exam.subject, solid_bone());
    if (!probe.refusal().empty()) return exam.skip(probe.refusal());
    if (probe.law().outline().whole.is_prism()) return;
    WalkSettings in_air;
    in_air.bone.shape = PlaneBone::Shape::air;
    LawProbe idle(*exam.subject, in_air);
    const auto p = static_cast<std::size_t>(power), f = static_cast<std::size_t>(frequency);
    const Response without = idle.move(at_depth(-1.0), {}, 100);
    if (without.signals.size() <= std::max(p, f)) return;
    bool is_braked = false;
    for (const auto& [name, rate] : probe.motions(probe_speed)) {
        const Response r = probe.move(at_depth(0), rate, 100);
        if (r.signals.size() <= std::max(p, f)) return;
        const double reported = r.signals[p] - without.signals[p], turns = std::abs(r.signals[f]),
                     torque = std::abs(r.wrench[5]), made = 2.0 * pi * turns * torque;
        if (made < 0.05) continue;
        is_braked = true;
        if (reported < made / 2.5 || reported > 2.5 * made)
            return exam.fail("Running and " + name + " in solid bone, it turns at " + number(turns) + " 1/s against " +
                             number(1e3 * torque) + " N mm, which is " + number(made) + " W; its signal `" +
                             force.signals[p].id + "` is " + number(reported) +
                             " W more than in air, expected as much, up to a factor of 2.5. P = 2π n M.");
    }
    if (!is_braked) exam.skip("bone brakes it with less than 0.05 W");
}

void reports_its_forces(Examination& exam) {
    const kerf_force& force = *exam.subject->force->force;
    const auto [largest, forces, torques] = record(exam);
    if (exam.status() != Status::passed) return;
    for (std::uint32_t i = 0; i < force.signal_count; ++i) {
        if (!is_same(force.signals[i].dimension, dimension::force)) continue;
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
        if (is_same(tool.drives[i].dimension, dimension::frequency) && tool.drives[i].def > 0.0) {
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
        if (!is_same(force.signals[i].dimension, dimension::frequency) || full[i] == 0.0) continue;
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
    for (int i = 0; i < 200; ++i) path.push_back(at_depth(-2e-3 - 1e-6 * i));
    walk(exam, settings, path, {}, [&](LawWalk& law) {
        for (std::uint32_t i = 0; i < force.signal_count; ++i) {
            last[i] = std::abs(law.signals()[i]);
            largest[i] = std::max(largest[i], last[i]);
        }
        return true;
    });
    for (std::uint32_t i = 0; i < force.signal_count; ++i)
        if (is_same(force.signals[i].dimension, dimension::force) && last[i] > 0.02 * largest[i] + 1e-9)
            return exam.fail("After 0.2 s in air its signal `" + std::string(force.signals[i].id) + "` is " +
                             number(last[i]) + " N, in bone it was up to " + number(largest[i]) +
                             " N, expected none: no bone is near.");
}

constexpr int long_time = 40;  // [s] of processor time
constexpr Test tests[] = {
    {"physics.force_signals", 4, Scope::law, "A signal of a force is no more than its forces.", &reports_its_forces,
     "law.sound", long_time},
    {"physics.torque_signals", 4, Scope::law, "A signal of a torque is no more than its torques.", &reports_its_torques,
     "law.sound", long_time},
    {"physics.power_signals", 4, Scope::law, "A signal of a power is that of the torque that brakes it.",
     &reports_its_power, "law.sound", long_time},
    {"physics.speed_signals", 4, Scope::law, "A signal of a speed follows the drive.", &reports_its_speeds, "law.sound",
     long_time},
    {"physics.air_signals", 4, Scope::law, "A signal of a force ends in air.", &reports_nothing_in_air, "law.sound",
     long_time},
};

}  // namespace

std::span<const Test> physics_signal_tests() { return tests; }

}  // namespace kerf::conformance
