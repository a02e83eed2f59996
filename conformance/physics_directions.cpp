// SPDX-License-Identifier: Apache-2.0
// Level 4: forces and torques of a running tool in all directions.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "conformance/law_probe.h"
#include "conformance/test_groups.h"

namespace kerf::conformance {

namespace {

std::string moved(Vec3 direction) { return "Running in solid bone and moved along " + name_of_direction(direction); }

void opposes_each_motion(Examination& exam) {
    LawProbe probe(*exam.subject, solid_bone());
    if (!probe.refusal().empty()) return exam.skip(probe.refusal());
    const LawProbe::Help help = probe.largest_help();
    if (help.newtons > 0.05 * help.largest)
        exam.fail(moved(help.along) + ", its force on the hand is " + in_newtons(help.force) + ": it helps with " +
                  number(help.newtons) + " N, expected none. Bone resists each motion.");
}

void cuts_alike_on_both_sides(Examination& exam) {
    if (exam.subject->tool->tool->feed == KERF_FEED_SIDE) return exam.skip("the tool is fed to one side");
    LawProbe probe(*exam.subject, solid_bone());
    if (!probe.refusal().empty()) return exam.skip(probe.refusal());
    constexpr double tolerance = 0.2;  // [–] whirl, and points that are spread unevenly
    const Quat half_turn{0, 0, 0, 1};
    double largest = length(probe.move(at_depth(0), probe.feed(probe_speed)).force());
    for (const Vec3 v : {Vec3{1, 0, 0}, Vec3{0, 1, 0}}) {
        const Vec3 one = probe.move(at_depth(0), make_vec6(probe_speed * v, {})).force(),
                   other = probe.move(at_depth(0), make_vec6(-probe_speed * v, {})).force();
        const double size = std::max(length(one), length(other));
        largest = std::max(largest, size);
        if (length(one - rotate(half_turn, other)) > tolerance * size + 0.01 * largest)
            return exam.fail(moved(v) + ", its force is " + in_newtons(one) + ", and along " + name_of_direction(-v) +
                             " " + in_newtons(other) +
                             ", expected the same after half a turn about the shaft, within 20 %.");
    }
}

/// The reach of a tool from its axis [m].
double reach_of(const ToolOutline& outline) {
    double reach = outline.thread_radius;
    for (const kerf_profile_point& p : outline.profile) reach = std::max(reach, p.radius);
    return reach;
}

void pays_for_its_spin(Examination& exam) {
    const kerf_tool& tool = *exam.subject->tool->tool;
    if (tool.drive_count == 0 && tool.feed != KERF_FEED_TURN) return exam.skip("the tool has no drive");
    const auto try_drives = [&](double fraction) {
        WalkSettings settings = solid_bone();
        settings.drives = drives_at(*exam.subject->tool, fraction);
        LawProbe probe(*exam.subject, settings);
        if (!probe.refusal().empty()) return exam.skip(probe.refusal());
        const double reach = reach_of(probe.law().outline());
        const auto check = [&](const Vec6& rate) {
            const Response r = probe.move(at_depth(0), rate);
            const double torque = fraction * r.wrench[5], max_torque = reach * r.loaded;  // [N·m]
            if (torque > 0.03 * max_torque)
                exam.fail(std::string("With its drives ") + (fraction > 0.0 ? "forwards" : "in reverse") +
                          " and moved along " + name_of_direction((1.0 / probe_speed) * linear(rate)) +
                          ", bone turns it onwards with " + number(1e3 * torque) +
                          " N mm about its shaft, expected none: bone brakes what turns in it. A tool whose drive is "
                          "positive turns about +z.");
            else if (-torque > 4.0 * max_torque)
                exam.fail("Moved along " + name_of_direction((1.0 / probe_speed) * linear(rate)) +
                          ", bone brakes it with " + number(-1e3 * torque) +
                          " N mm about its shaft, but all its forces, " + number(r.loaded) + " N, act within " +
                          number(1e3 * reach) + " mm of the shaft.");
        };
        if (tool.drive_count == 0) return check(probe.feed(probe_speed));
        for (const Vec3 v : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}})
            check(make_vec6(probe_speed * v, {}));
    };
    try_drives(1.0);
    for (std::uint32_t i = 0; i < tool.drive_count; ++i)
        if (tool.drives[i].min < 0.0 && tool.drives[i].def > 0.0) return try_drives(-1.0);
}

/// How far a wrench's line of action passes from the bone between two heights of the tool and its reach [m]. A couple
/// about the shaft does not count: edges on opposite sides make one. Where forces of opposite sides cancel, their
/// couple counts as that of one newton per newton of the channel.
double distance_from(const double* wrench, double low, double high, double reach) {
    const Vec3 f{wrench[0], wrench[1], wrench[2]};
    const double size = length(f);
    if (size < 1e-9) return 0.0;
    const double a[2] = {wrench[3], wrench[4]}, b[2] = {f.y, -f.x}, bb = b[0] * b[0] + b[1] * b[1];
    const double z = std::clamp(bb > 1e-12 * size * size ? -(a[0] * b[0] + a[1] * b[1]) / bb : low, low, high);
    return std::max(0.0, (std::hypot(a[0] + z * b[0], a[1] + z * b[1]) - std::abs(f.z) * reach) / std::max(size, 1.0));
}

void acts_where_bone_is(Examination& exam) {
    constexpr double thickness = 0.1e-3, step = 0.04e-3;  // [m] of a thin plate that the tool goes through
    WalkSettings settings;
    settings.bone.thickness = thickness;
    LawProbe probe(*exam.subject, settings);
    if (!probe.refusal().empty()) return exam.skip(probe.refusal());
    const ToolOutline& outline = probe.law().outline();
    if (outline.cutting_count == 0) return exam.skip("the tool has no cutting part");
    const double reach = reach_of(outline), allowed = 0.03 * reach + 0.06e-3;
    const double longest = std::min(outline.cutting.tip_z() - outline.cutting.end_z(), 12e-3);
    const Vec3 directions[] = {{0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    struct Worst {
        double off = 0.0, height = 0.0;
        std::string channel;
    } worst;
    for (double depth = -outline.cutting.tip_z(); depth < longest - outline.cutting.tip_z(); depth += step) {
        if (!probe.evaluate(at_depth(depth))) return;
        double largest = 0.0;
        for (const bool is_first : {true, false})
            for (std::size_t i = 0; i < probe.law().channels().size(); ++i) {
                const kerf_channel& c = probe.law().channels()[i];
                double lambda = 0.0;
                for (const Vec3 v : directions) {
                    const double s = dot(direction(c), make_vec6(probe_speed * v, {}));
                    lambda = std::max(lambda, std::abs(channel_force(c, s, probe.law().dt()).lambda));
                }
                if (is_first) largest = std::max(largest, lambda);
                if (is_first || c.kind != KERF_CUT || lambda < 0.02 * largest) continue;
                for (const double* wrench : {c.d, c.follow})
                    if (const double off = distance_from(wrench, -depth, thickness - depth, reach); off > worst.off)
                        worst = {off, 0.5 * thickness - depth,
                                 name_of(c, i) + (wrench == c.d ? "" : ", its `follow`,")};
            }
    }
    if (worst.off > allowed)
        exam.fail("With bone only at " + number(1e3 * worst.height) + " mm of its shaft, " + worst.channel +
                  " acts along a line that passes " + number(1e3 * worst.off) +
                  " mm from that bone, expected through it. The torque of a force is r × F, with r from the tip to "
                  "where bone is cut.");
}

constexpr int long_time = 40;  // [s] of processor time
constexpr Test tests[] = {
    {"physics.opposes", 4, Scope::law, "Running, it is resisted in each direction.", &opposes_each_motion, "law.sound",
     long_time},
    {"physics.sides", 4, Scope::law, "It cuts alike to opposite sides.", &cuts_alike_on_both_sides, "law.sound",
     long_time, KERF_DOES_NOT_RESIST_SIDEWAYS},
    {"physics.spin", 4, Scope::law, "Bone brakes its turning.", &pays_for_its_spin, "law.sound", long_time,
     KERF_DOES_NOT_BRAKE_TURNING},
    {"physics.lever", 4, Scope::law, "Its cutting forces act where bone is.", &acts_where_bone_is, "law.sound",
     long_time},
};

}  // namespace

std::span<const Test> physics_direction_tests() { return tests; }

}  // namespace kerf::conformance
