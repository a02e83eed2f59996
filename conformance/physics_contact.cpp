// SPDX-License-Identifier: Apache-2.0
// Level 4: contact of a tool at rest, in all directions and on all its sides.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "conformance/law_probe.h"
#include "conformance/parameter_sets.h"
#include "conformance/test_groups.h"

namespace kerf::conformance {

namespace {

WalkSettings at_rest(const Subject& subject) {
    WalkSettings settings;
    settings.drives = drives_at_rest(*subject.tool);
    return settings;
}

/// A tool against a face of bone: `normal` is that of the face, outward, in the tool's frame.
class Pressed {
public:
    Pressed(const ToolOutline& outline, Vec3 normal)
        : world_from_tool_(quat_between(normal, {0, 0, 1})), lowest_(lowest(outline, normal)) {}
    /// The pose with its lowest point this deep in the bone [m].
    [[nodiscard]] Pose at(double depth) const { return {{0, 0, -depth - lowest_}, world_from_tool_}; }

private:
    /// The height of the lowest point above the tip [m]: of all that is in front of the end of the cutting part, or,
    /// against a face at the tool's side or behind it, of the cutting part alone.
    static double lowest(const ToolOutline& outline, Vec3 n) {
        const bool cuts = outline.cutting_count > 0;
        const std::size_t first = cuts && n.z >= 0.0 ? outline.cutting_first : 0,
                          end = cuts ? outline.cutting_first + outline.cutting_count : outline.profile.size();
        const double half = 0.5 * (outline.whole.is_prism() ? outline.cutting.thickness() : 0.0);
        double low = 1e300;
        for (std::size_t i = first; i < std::min(end, outline.profile.size()); ++i) {
            const kerf_profile_point& p = outline.profile[i];
            const double across = outline.whole.is_prism() ? std::abs(n.x) * p.radius + std::abs(n.y) * half
                                                           : std::hypot(n.x, n.y) * p.radius;
            low = std::min(low, n.z * p.z - across);
        }
        return low;
    }
    Quat world_from_tool_;
    double lowest_;
};

std::string face(Vec3 normal) {
    return "At rest, against a face whose normal is " + name_of_direction(normal) + " of the tool, ";
}

void is_never_pulled_in(Examination& exam) {
    constexpr double deepest = 1.3e-3, even = 0.3e-3, step = 0.05e-3;  // [m]
    WalkSettings settings = at_rest(*exam.subject);
    settings.bone.voxel = 0.5e-3;  // surfaces are known 2 mm deep
    LawProbe probe(*exam.subject, settings);
    if (!probe.refusal().empty()) return exam.skip(probe.refusal());
    struct Fault {
        double size = 0.0;
        std::string text;
    } pulled, falling, aside;
    double largest = 0.0;
    for (const Vec3 n : all_directions()) {
        const Pressed pressed(probe.law().outline(), n);
        double before = 0.0;
        for (double depth = -0.1e-3; depth < deepest; depth += step) {
            if (!probe.evaluate(pressed.at(depth))) return;
            const Vec3 f = linear(probe.law().force_at({}));
            const double out = dot(f, n), across = length(f - out * n);
            const std::string where = face(n) + number(1e3 * depth) + " mm deep, its force is " + in_newtons(f);
            largest = std::max(largest, length(f));
            if (-out > pulled.size) pulled = {-out, where + ": bone pulls it in with " + number(-out) + " N"};
            if (n.z <= 0.0 && depth < even && before - out > falling.size)
                falling = {before - out,
                           where + ", " + number(before - out) + " N less against the bone than 0.05 mm higher"};
            if (across - out > aside.size) aside = {across - out, where + ", more along the face than against it"};
            before = out;
        }
    }
    if (pulled.size > 0.02 * largest)
        exam.fail(pulled.text + ", expected a push out of the bone.");
    else if (falling.size > 0.05 * largest)
        exam.fail(falling.text + ", expected no less.");
    else if (aside.size > 0.1 * largest)
        exam.fail(aside.text + ", expected a push along its normal.");
}

void rests_alike_on_mirrored_faces(Examination& exam) {
    constexpr double deepest = 1.3e-3, step = 0.1e-3,
                     tolerance = 0.4;  // [m], [m], [–] for points that are spread unevenly
    if (exam.subject->tool->tool->feed == KERF_FEED_SIDE) return exam.skip("the tool is fed to one side");
    WalkSettings settings = at_rest(*exam.subject);
    settings.bone.voxel = 0.5e-3;  // surfaces are known 2 mm deep
    LawProbe probe(*exam.subject, settings);
    if (!probe.refusal().empty()) return exam.skip(probe.refusal());
    const auto largest_push = [&](Vec3 n) {
        const Pressed pressed(probe.law().outline(), n);
        double largest = 0.0;
        for (double depth = 0.0; depth < deepest; depth += step)
            if (probe.evaluate(pressed.at(depth)))
                largest = std::max(largest, dot(linear(probe.law().force_at({})), n));
        return largest;
    };
    for (const Vec3 n : all_directions()) {
        if (n.x < 0.0 || n.y < 0.0 || n.z > 0.0) continue;
        const double push = largest_push(n);
        for (const Vec3 mirrored : {Vec3{-n.x, n.y, n.z}, Vec3{n.x, -n.y, n.z}, Vec3{-n.x, -n.y, n.z}})
            if (const double other = largest_push(mirrored); std::abs(push - other) > tolerance * std::max(push, other))
                return exam.fail(face(n) + "it is pushed out with up to " + number(push) + " N, and with " +
                                 number(other) + " N where it is " + name_of_direction(mirrored) +
                                 ", expected the same within 40 %: its shape is the same on both sides.");
    }
}

void does_not_know_the_grid_at_rest(Examination& exam) {
    constexpr double depth = 0.5e-3, max_ratio = 1.5;  // [m]; [–] walls of samples lie a tenth of a voxel off
    for (const Vec3 n : {Vec3{0, 0, -1}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}) {
        double smallest = 1e300, largest = 0.0;
        for (const double voxel : {0.15e-3, 0.25e-3, 0.4e-3}) {
            WalkSettings settings = at_rest(*exam.subject);
            settings.bone.voxel = voxel;
            LawProbe probe(*exam.subject, settings);
            if (!probe.refusal().empty()) return exam.skip(probe.refusal());
            if (!probe.evaluate(Pressed(probe.law().outline(), n).at(depth))) return;
            const double push = dot(linear(probe.law().force_at({})), n);
            smallest = std::min(smallest, push);
            largest = std::max(largest, push);
        }
        if (largest > max_ratio * std::max(smallest, 1.0))
            return exam.fail(face(n) + "0.5 mm deep, it is pushed out with " + number(smallest) + " N to " +
                             number(largest) + " N on grids of 0.15 mm to 0.4 mm, expected the same within 50 %.");
    }
}

/// Whether a contact's line of action meets the tool where it is in the bone. `top`: height of the face along `n`.
bool meets_the_tool(const kerf_channel& c, const ToolOutline& outline, Vec3 n, double top, double tolerance) {
    const Vec3 f{c.d[0], c.d[1], c.d[2]}, t{c.d[3], c.d[4], c.d[5]};
    const double ff = dot(f, f);
    if (ff < 1e-12) return true;
    const Vec3 nearest = (1.0 / ff) * cross(f, t), along = (1.0 / std::sqrt(ff)) * f;
    const auto hull = [&](double z) {  // radius of the convex hull of the outline
        double radius = -1.0;
        for (const kerf_profile_point& a : outline.profile)
            for (const kerf_profile_point& b : outline.profile)
                if (a.z + tolerance >= z && z >= b.z - tolerance)
                    radius = std::max(
                        radius, a.z - b.z < 1e-9
                                    ? std::max(a.radius, b.radius)
                                    : a.radius + (b.radius - a.radius) * std::clamp((a.z - z) / (a.z - b.z), 0.0, 1.0));
        return std::max(radius, outline.thread_radius);
    };
    for (double s = -60e-3; s < 60e-3; s += 0.05e-3) {
        const Vec3 p = nearest + s * along;
        if (dot(p, n) > top + tolerance) continue;
        const double radius = hull(p.z);
        if (radius >= 0.0 && std::hypot(p.x, p.y) <= radius + tolerance) return true;
    }
    return false;
}

void rests_where_it_touches(Examination& exam) {
    LawProbe probe(*exam.subject, at_rest(*exam.subject));
    if (!probe.refusal().empty()) return exam.skip(probe.refusal());
    const ToolOutline& outline = probe.law().outline();
    double reach = outline.thread_radius;
    for (const kerf_profile_point& p : outline.profile) reach = std::max(reach, p.radius);
    const double tolerance = 0.15 * reach + 0.1e-3;
    for (const Vec3 n : all_directions()) {
        if (n.z > 0.0) continue;
        const Pressed pressed(outline, n);
        for (double depth = 0.1e-3; depth < 0.95e-3; depth += 0.2e-3) {
            const Pose pose = pressed.at(depth);
            if (!probe.evaluate(pose)) return;
            for (std::size_t i = 0; i < probe.law().channels().size(); ++i) {
                const kerf_channel& c = probe.law().channels()[i];
                if (c.kind != KERF_CONTACT || c.delta * c.k < 0.1) continue;
                if (!meets_the_tool(c, outline, n, -pose.position.z, tolerance))
                    return exam.fail(face(n) + number(1e3 * depth) + " mm deep, " + name_of(c, i) +
                                     " acts along a line that does not meet the part of the tool that is in bone. "
                                     "The torque of a force is r × F, with r from the tip to where it touches.");
            }
        }
    }
}

void rests_on_its_sides(Examination& exam) {
    constexpr double push = 10.0, max_depth = 1.5e-3;  // [N], [m]
    if (exam.subject->tool->tool->drive_count == 0) return exam.skip("the tool has no drive");
    LawProbe probe(*exam.subject, at_rest(*exam.subject));
    if (!probe.refusal().empty()) return exam.skip(probe.refusal());
    if (probe.law().outline().cutting_count == 0) return exam.skip("the tool has no cutting part");
    const bool is_prism = probe.law().outline().whole.is_prism();
    for (const Vec3 n : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0.7, 0, -0.714}, Vec3{-0.7, 0, -0.714}, Vec3{0, 1, 0},
                         Vec3{0, -1, 0}, Vec3{0, 0.7, -0.714}, Vec3{0, -0.7, -0.714}}) {
        if (is_prism && n.x != 0.0) continue;  // its outline is what the blade sweeps, which at rest is less wide
        const Pressed pressed(probe.law().outline(), n);
        double out = 0.0;
        for (double depth = 0.0; depth <= max_depth && out < push; depth += 0.05e-3) {
            if (!probe.evaluate(pressed.at(depth))) return;
            out = std::max(out, dot(linear(probe.law().force_at({})), n));
        }
        if (out < push)
            return exam.fail(face(n) + number(1e3 * max_depth) + " mm deep, it is pushed out with " + number(out) +
                             " N, expected 10 N at least. Add contact on that side for a tool that does not cut.");
    }
}

constexpr int long_time = 40;  // [s] of processor time
constexpr Test tests[] = {
    {"physics.contact", 4, Scope::law, "At rest, bone pushes it out along the normal, whatever that is.",
     &is_never_pulled_in, "law.sound", long_time, KERF_DOES_NOT_REST_ON_BONE},
    {"physics.rest_mirror", 4, Scope::law, "At rest it is the same against mirrored faces.",
     &rests_alike_on_mirrored_faces, "law.sound", long_time, KERF_DOES_NOT_REST_ON_BONE},
    {"physics.rest_spacing", 4, Scope::law, "At rest, its force does not depend on the spacing of the grid.",
     &does_not_know_the_grid_at_rest, "law.sound", long_time, KERF_DOES_NOT_REST_ON_BONE},
    {"physics.rest_lever", 4, Scope::law, "At rest, its forces act where it touches bone.", &rests_where_it_touches,
     "law.sound", long_time, KERF_DOES_NOT_REST_ON_BONE},
    {"physics.rest_sides", 4, Scope::law, "At rest it rests on each side of its cutting part.", &rests_on_its_sides,
     "law.sound", long_time, KERF_DOES_NOT_REST_ON_BONE},
};

}  // namespace

std::span<const Test> physics_contact_tests() { return tests; }

}  // namespace kerf::conformance
