// SPDX-License-Identifier: Apache-2.0
// Level 4: bone of several tissues and bodies, soft and dense, bone that ends, and the work that each of it costs.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "conformance/law_probe.h"
#include "conformance/parameter_sets.h"
#include "conformance/test_groups.h"
#include "kerf/units.hpp"

namespace kerf::conformance {

namespace {

/// The wrench in each tick of a short path.
std::vector<Vec6> trace(Examination& exam, const WalkSettings& settings) {
    std::vector<Vec6> wrenches;
    const std::vector<Pose> path = short_path();
    std::size_t at = 0;
    walk(exam, settings, path, [&](LawWalk& law) {
        wrenches.push_back(law.force_at(law.rate_to(path[++at])));
        return true;
    });
    return wrenches;
}

double largest_of(const std::vector<Vec6>& wrenches) {
    double largest = 0.0;
    for (const Vec6& w : wrenches) largest = std::max(largest, length(linear(w)));
    return largest;
}

/// Compares a path in one bone with the same path in another.
void is_the_same_in(Examination& exam, const std::string& what, const std::vector<Vec6>& expected,
                    const WalkSettings& settings) {
    if (exam.status() != Status::passed) return;
    const std::vector<Vec6> got = trace(exam, settings);
    if (exam.status() != Status::passed) return;
    const double allowed = 1e-6 * largest_of(expected) + 1e-9;
    for (std::size_t i = 0; i < std::min(got.size(), expected.size()); ++i)
        if (!(length(linear(got[i]) - linear(expected[i])) <= allowed))
            return exam.fail("In " + what + " its force at tick " + std::to_string(i) + " of a path is " +
                             in_newtons(linear(got[i])) + ", and " + in_newtons(linear(expected[i])) +
                             " in one body of one tissue, expected the same.");
}

std::vector<std::vector<double>> drives_of(const Subject& subject) {
    std::vector<std::vector<double>> drives{drives_at(*subject.tool, 1.0)};
    if (subject.tool->tool->drive_count > 0) drives.push_back(drives_at_rest(*subject.tool));
    return drives;
}

bool has_thread(const Subject& subject) {
    const LawWalk law(subject);
    return law.refusal().empty() && law.outline().has_thread();
}

void knows_all_bodies(Examination& exam) {
    for (const std::vector<double>& drives : drives_of(*exam.subject)) {
        WalkSettings settings;
        settings.drives = drives;
        const std::vector<Vec6> expected = trace(exam, settings);
        for (const std::uint16_t body : {std::uint16_t{1}, std::uint16_t{5}}) {
            settings.bone.body = body;
            is_the_same_in(exam, "body " + std::to_string(body) + ", as a piece that came off,", expected, settings);
        }
        settings.bone.body = 0;
        settings.bone.is_split = true;
        if (!has_thread(*exam.subject))
            is_the_same_in(exam, "two bodies, one on either side of the shaft,", expected, settings);
    }
}

void knows_all_tissues(Examination& exam) {
    for (const std::vector<double>& drives : drives_of(*exam.subject)) {
        WalkSettings settings;
        settings.drives = drives;
        settings.bone.tissues = 1;
        settings.bone.others = 1.0;
        const std::vector<Vec6> expected = trace(exam, settings);
        settings.bone.tissues = 4;
        for (const std::uint32_t first : {0u, 1u, 2u, 3u}) {
            settings.bone.first = first;
            settings.bone.fraction_of_first = 1.0;
            is_the_same_in(exam, "tissue " + std::to_string(first + 1) + " of 4, as dense,", expected, settings);
            settings.bone.fraction_of_first = 0.5;
            is_the_same_in(exam, "a mixture of tissue " + std::to_string(first + 1) + " and the next, as dense,",
                           expected, settings);
        }
    }
}

void resists_by_density(Examination& exam) {
    constexpr double densities[] = {150.0, 300.0, 600.0, 900.0, 1200.0, 1500.0, 1850.0, 2200.0};
    constexpr double dense = 1850.0, soft = 600.0;
    LawProbe in_dense(*exam.subject, solid_bone());
    if (!in_dense.refusal().empty()) return exam.skip(in_dense.refusal());
    double largest = 0.0;
    for (const auto& [name, rate] : in_dense.motions(probe_speed)) {
        const double of_dense = against(in_dense.move(at_depth(0), rate), rate);
        largest = std::max(largest, of_dense);
        if (of_dense < 1e-9 || of_dense < 0.02 * largest) continue;
        double before = 0.0, of_soft = 0.0;
        for (const double density : densities) {
            LawProbe probe(*exam.subject, solid_bone({.density = density}));
            const Response r = probe.move(at_depth(0), rate);
            const double force = against(r, rate), ratio = density / dense;
            const std::string text = "Running and " + name + " in solid bone of " + number(density) +
                                     " kg/m³, it is resisted with " + number(force) + " N";
            if (force < 0.98 * before)
                return exam.fail(text + ", and with " + number(before) + " N in softer bone, expected no less.");
            if (r.cut_ticks > 0 && force < 0.2 * std::min(1.0, ratio * ratio * ratio) * of_dense)
                return exam.fail(text + " and removes it; at 1850 kg/m³ it is resisted with " + number(of_dense) +
                                 " N. Bone that is removed costs work.");
            if (density == soft) of_soft = force;
            before = force;
        }
        if (of_dense < 1.1 * of_soft)
            return exam.fail("Running and " + name + ", it is resisted with " + number(of_soft) +
                             " N in bone of 600 kg/m³ and with " + number(of_dense) +
                             " N in bone of 1850 kg/m³, expected more in denser bone. Strength grows with density "
                             "(kerf/edge_law.hpp, `resistance`).");
    }
    if (largest < 1e-9) exam.skip("it resists nothing in solid bone");
}

void mixes_tissues(Examination& exam) {
    LawProbe dense(*exam.subject, solid_bone()), soft(*exam.subject, solid_bone({.fraction_of_first = 0.0})),
        mixed(*exam.subject, solid_bone({.fraction_of_first = 0.5}));
    if (!dense.refusal().empty()) return exam.skip(dense.refusal());
    const Vec6 rate = dense.feed(probe_speed);
    const double of_dense = against(dense.move(at_depth(0), rate), rate),
                 of_soft_tissue = against(soft.move(at_depth(0), rate), rate),
                 between = against(mixed.move(at_depth(0), rate), rate);
    if (of_dense < 1e-9) return exam.skip("it resists nothing in solid bone");
    if (between < 0.98 * std::min(of_soft_tissue, of_dense) || between > 1.02 * std::max(of_soft_tissue, of_dense))
        exam.fail("Fed in solid bone, it is resisted with " + number(of_dense) + " N by a dense tissue, with " +
                  number(of_soft_tissue) + " N by one half as dense, and with " + number(between) +
                  " N by half of each, expected a force between.");
}

// ---- where bone ends ----------------------------------------------------------------------------------------------

void ends_with_the_bone(Examination& exam) {
    LawProbe probe(*exam.subject, solid_bone());
    if (!probe.refusal().empty()) return exam.skip(probe.refusal());
    PlaneBone air({.shape = PlaneBone::Shape::air});
    for (const auto& [name, rate] : probe.motions(probe_speed)) {
        const Response r = probe.move(at_depth(0), rate, 60);
        const double there = length(r.force());
        if (probe.law().resist_in(air) != KERF_OK) return;
        const Vec6 left = probe.law().force_at(rate);
        const double force = length(linear(left)), torque = std::hypot(left[3], left[4]);
        if (force > 0.01 * there + 1e-6 || torque > 0.01 * length(r.torque()) + 1e-6)
            return exam.fail("Running and " + name + " through bone that ends, it still makes " + number(force) +
                             " N and " + number(1e3 * torque) +
                             " N mm in the first tick in air, expected none; in bone it made " + number(there) +
                             " N. Take force from the bone of this tick.");
    }
}

void crosses_gaps(Examination& exam) {
    constexpr double gap = 0.3e-3, step = 0.1e-3;  // [m], of a tick
    LawProbe closed(*exam.subject, solid_bone()), open(*exam.subject, solid_bone({.gap = gap}));
    if (!closed.refusal().empty()) return exam.skip(closed.refusal());
    if (closed.is_threaded()) return exam.skip("a thread is cut along its flanks");
    const auto cutting = [&](LawProbe& probe, const Vec6& rate) {
        double sum = 0.0;
        if (!probe.evaluate(at_depth(0))) return sum;
        for (const kerf_channel& c : probe.law().channels())
            if (c.kind == KERF_CUT) sum += channel_force(c, dot(direction(c), rate), probe.law().dt()).lambda;
        return sum;
    };
    for (const auto& [name, slow] : closed.motions(probe_speed)) {
        Vec6 rate = slow;
        for (double& part : rate) part *= step / (closed.law().dt() * probe_speed);
        const double there = cutting(closed, rate), left = cutting(open, rate);
        if (left > 0.02 * there + 1e-9)
            return exam.fail("Running and " + name +
                             " by 0.1 mm in a tick, with a gap of 0.3 mm to uncut bone, its cut channels make " +
                             number(left) + " N, expected none; without a gap they make " + number(there) +
                             " N. Pass the `gap` of the sample on.");
    }
}

// ---- work ---------------------------------------------------------------------------------------------------------

/// The area of a tool's cutting part as seen along a direction of its shaft, and across it [m²].
struct Silhouette {
    double along = 0.0, x = 0.0, y = 0.0;
};
Silhouette silhouette_of(const ToolOutline& outline) {
    Silhouette seen;
    double widest = 0.0;
    for (std::size_t p = outline.cutting_first; p + 1 < outline.cutting_first + outline.cutting_count; ++p) {
        const auto &a = outline.profile[p], &b = outline.profile[p + 1];
        seen.y += (a.radius + b.radius) * (a.z - b.z);
        widest = std::max({widest, a.radius, b.radius});
    }
    const bool is_prism = outline.whole.is_prism();
    const double thickness = outline.cutting.thickness(), bore = outline.cutting.bore();
    seen.x = is_prism ? thickness * (outline.cutting.tip_z() - outline.cutting.end_z()) : seen.y;
    seen.along = is_prism ? 2.0 * widest * thickness : pi * (widest * widest - bore * bore);
    return seen;
}

void pays_for_what_it_removes(Examination& exam) {
    constexpr double min_fraction = 0.1;  // [–] of the work per volume that it costs as it is fed
    LawProbe probe(*exam.subject, solid_bone());
    if (!probe.refusal().empty()) return exam.skip(probe.refusal());
    if (probe.law().outline().cutting_count == 0) return exam.skip("the tool has no cutting part");
    const Silhouette seen = silhouette_of(probe.law().outline());
    const bool is_fed_sideways = exam.subject->tool->tool->feed == KERF_FEED_SIDE;
    double own = 0.0;
    for (const auto& [name, rate] : probe.motions(probe_speed)) {
        const Response r = probe.move(at_depth(0), rate);
        const Vec3 v = (1.0 / length(linear(rate))) * linear(rate);
        const double area = std::abs(v.z) * seen.along + std::abs(v.x) * seen.x + std::abs(v.y) * seen.y;
        const double work =
            (against(r, rate) - std::min(0.0, r.wrench[5] * rate[5] / length(linear(rate)))) / area;  // [J/m³]
        if (own == 0.0) own = work;
        if (own <= 0.0)
            return is_fed_sideways || r.cut_ticks > 0
                       ? exam.fail(
                             "Fed in solid bone, it removes bone without work, expected a force against the feed.")
                       : exam.skip("it removes nothing in solid bone");
        if (r.cut_ticks == 0 && r.cutting > 0.2 * against(r, rate) && against(r, rate) > 1e-3)
            return exam.fail("Running and " + name + " in solid bone, its cut channels make " + number(r.cutting) +
                             " N, but it requests no `cut`: nothing is removed in front of its edges.");
        if (r.cut_ticks > r.ticks / 2 && work < min_fraction * own)
            return exam.fail("Running and " + name + " in solid bone, it removes bone for " + number(1e-6 * work) +
                             " J/cm³, and for " + number(1e-6 * own) +
                             " J/cm³ as it is fed, expected a tenth of that at least. Resist that motion, or request "
                             "no `cut` in it.");
    }
    exam.note(number(1e-6 * own) + " J/cm³ as it is fed");
}

constexpr int long_time = 40;  // [s] of processor time
constexpr Test tests[] = {
    {"physics.bodies", 4, Scope::law, "All bodies are bone: a piece that came off, too.", &knows_all_bodies,
     "law.sound", long_time},
    {"physics.tissues", 4, Scope::law, "Each tissue resists by its density.", &knows_all_tissues, "law.sound",
     long_time},
    {"physics.mixture", 4, Scope::law, "A mixture resists as a tissue between.", &mixes_tissues, "law.sound",
     long_time},
    {"physics.densities", 4, Scope::law, "From soft to dense bone, it is resisted more.", &resists_by_density,
     "law.sound", long_time, KERF_DOES_NOT_DEPEND_ON_DENSITY},
    {"physics.ends", 4, Scope::law, "Its force ends with the bone, at once.", &ends_with_the_bone, "law.sound",
     long_time},
    {"physics.gap", 4, Scope::law, "It cuts no air on its way to bone.", &crosses_gaps, "law.sound", long_time},
    {"physics.work", 4, Scope::law, "What it removes costs work, sideways too.", &pays_for_what_it_removes, "law.sound",
     long_time},
};

}  // namespace

std::span<const Test> physics_bone_tests() { return tests; }

}  // namespace kerf::conformance
