// SPDX-License-Identifier: Apache-2.0
// Which outlines a tool may have: those whose sweep the carver makes exactly. Held against brute force, sample by
// sample: many poses on the way, and the exact distance to the outline at each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/field/cut/cut_field.h"
#include "core/field/cut/tool_solid.h"
#include "tests/support/block.h"

namespace kerf {
namespace {

using namespace literals;
using Outline = std::vector<kerf_profile_point>;

/// Distance to a profile turned about z, by its segments alone [m]; negative inside.
double brute_distance(const Outline& o, Vec3 p) {
    const double r = std::hypot(p.x, p.y);
    double nearest = 1e300;
    const auto to_segment = [&](double r0, double z0, double r1, double z1) {
        const double dr = r1 - r0, dz = z1 - z0, l2 = dr * dr + dz * dz;
        const double t = l2 > 0.0 ? std::clamp(((r - r0) * dr + (p.z - z0) * dz) / l2, 0.0, 1.0) : 0.0;
        nearest = std::min(nearest, std::hypot(r - r0 - t * dr, p.z - z0 - t * dz));
    };
    to_segment(0.0, o.front().z, o.front().radius, o.front().z);
    to_segment(0.0, o.back().z, o.back().radius, o.back().z);
    double width = -1.0;
    for (std::size_t i = 1; i < o.size(); ++i) {
        to_segment(o[i - 1].radius, o[i - 1].z, o[i].radius, o[i].z);
        if (p.z <= o[i - 1].z && p.z > o[i].z)
            width = o[i - 1].radius + (o[i].radius - o[i - 1].radius) * (o[i - 1].z - p.z) / (o[i - 1].z - o[i].z);
    }
    return r < width ? -nearest : nearest;
}
/// The same with a bore, and with gaps.
double brute_distance(const Outline& o, double bore, const std::vector<ToolSolid::Gap>& gaps, Vec3 p) {
    double off = brute_distance(o, p);
    if (bore > 0.0) off = std::max(off, bore - std::hypot(p.x, p.y));
    for (const ToolSolid::Gap& gap : gaps) off = std::max(off, std::min(gap.front - p.z, p.z - gap.back));
    return off;
}

struct Wrong {
    int missed = 0, extra = 0, inside = 0;
    double missed_depth = 0.0, extra_height = 0.0;
};

/// One stroke in steps of about two fifths of a voxel, as the loop makes them, against brute force.
Wrong stroke(const Outline& outline, double bore, const std::vector<ToolSolid::Gap>& gaps, Vec3 axis, Vec3 along,
             double way, double turn) {
    constexpr double h = 0.3_mm;
    const Body body = test::block({-4.0_mm, -4.0_mm, -4.0_mm}, {4.0_mm, 4.0_mm, 4.0_mm}, h, {0.13, 0.71, 0.37});
    const Grid& g = body.grid();
    const ToolSolid solid = ToolSolid::parts(outline, bore, gaps);
    CutField cut(body, 512);
    const auto at = [&](double t) {
        const Pose straight = test::pointing((t - 0.5) * way * along, axis);
        return Pose{straight.position,
                    normalized(quat_from_rotation_vector(t * turn * Vec3{0.6, 0.0, 0.8}) * straight.rotation)};
    };
    constexpr int records = 12, instants = 5;
    for (int i = 0; i < records; ++i) {
        CutRecord record;
        record.from = at(static_cast<double>(i) / records);
        record.to = at(static_cast<double>(i + 1) / records);
        if (i == 0) {
            CutRecord begun = record;
            begun.to = begun.from;
            cut.stamp(begun, solid);
        }
        cut.stamp(record, solid);
    }
    std::vector<Pose> tool_from_body;
    for (int i = 0; i <= records * instants; ++i)
        tool_from_body.push_back(inverse(at(static_cast<double>(i) / (records * instants))));
    const double between = (way + turn * 5.0_mm) / (records * instants);  // what lies between two instants
    Wrong wrong;
    for (int k = 0; k < g.samples(2); ++k)
        for (int j = 0; j < g.samples(1); ++j)
            for (int i = 0; i < g.samples(0); ++i) {
                if (body.surface.sample(i, j, k) >= 0) continue;
                const Vec3 p = g.sample_position(i, j, k);
                if (length(p) > 3.6_mm) continue;
                double d = 1e300;
                for (const Pose& pose : tool_from_body) d = std::min(d, brute_distance(outline, bore, gaps, pose * p));
                const bool is_gone = cut.sample(i, j, k) > 0;
                const double error = between + 2.0 * g.quantum();
                wrong.inside += d < 0.0;
                if (d < -error && !is_gone) {
                    ++wrong.missed;
                    wrong.missed_depth = std::max(wrong.missed_depth, -d);
                }
                if (d > error && is_gone) {
                    ++wrong.extra;
                    wrong.extra_height = std::max(wrong.extra_height, d);
                }
            }
    return wrong;
}

/// A ball of `radius`, cut off at `part` of its diameter, then a shank.
Outline ball(double radius, double part, double shank) {
    Outline o;
    for (int i = 0; i <= 12; ++i) {
        const double a = pi * part * i / 12;
        o.push_back({-radius * (1.0 - std::cos(a)), radius * std::sin(a)});
    }
    if (shank > 0.0) {
        o.push_back({o.back().z - 0.1_mm, shank});
        o.push_back({o.back().z - 2.0_mm, shank});
    }
    return o;
}

struct Shape {
    const char* name;
    Outline outline;
    double bore = 0.0;
    std::vector<ToolSolid::Gap> gaps{};
};

const Shape shapes[] = {
    {"drill", {{0.0, 0.0}, {-0.9_mm, 1.5_mm}, {-3.0_mm, 1.5_mm}}},
    {"half_ball", ball(1.5_mm, 0.5, 0.0)},
    {"ball", ball(1.5_mm, 0.85, 0.0)},
    {"ball_on_a_shank", ball(1.5_mm, 0.85, 0.5_mm)},
    {"drop", {{0.0, 0.0}, {-1.0_mm, 1.5_mm}, {-2.5_mm, 0.5_mm}}},
    {"inverted_cone", {{0.0, 1.5_mm}, {-2.0_mm, 0.6_mm}}},
    {"disc_on_a_shank", {{0.0, 1.5_mm}, {-0.5_mm, 1.5_mm}, {-0.6_mm, 0.4_mm}, {-2.5_mm, 0.4_mm}}},
    {"step", {{0.0, 0.0}, {-0.5_mm, 0.8_mm}, {-1.5_mm, 0.8_mm}, {-1.6_mm, 1.5_mm}, {-3.0_mm, 1.5_mm}}},
    {"concave_nose", {{0.0, 0.0}, {-1.5_mm, 0.3_mm}, {-2.5_mm, 1.5_mm}, {-3.0_mm, 1.5_mm}}},
    {"hour_glass", {{0.0, 0.2_mm}, {-0.6_mm, 1.4_mm}, {-1.5_mm, 0.5_mm}, {-2.4_mm, 1.4_mm}, {-3.0_mm, 0.8_mm}}},
    {"zigzag",
     {{0.0, 0.0},
      {-0.4_mm, 1.2_mm},
      {-0.8_mm, 0.5_mm},
      {-1.2_mm, 1.4_mm},
      {-1.6_mm, 0.5_mm},
      {-2.0_mm, 1.5_mm},
      {-2.4_mm, 0.3_mm}}},
    {"thin_disc", {{0.0, 1.5_mm}, {-0.1_mm, 1.5_mm}}},
    {"needle", {{0.0, 0.0}, {-0.3_mm, 0.25_mm}, {-3.0_mm, 0.25_mm}}},
    {"trephine", {{0.0, 1.5_mm}, {-3.0_mm, 1.5_mm}}, 0.9_mm},
    {"tapered_trephine", {{0.0, 1.2_mm}, {-0.8_mm, 1.8_mm}, {-2.5_mm, 1.4_mm}}, 0.7_mm},
    {"two_heads",
     {{0.0, 0.0},
      {-0.6_mm, 1.2_mm},
      {-1.0_mm, 1.2_mm},
      {-1.1_mm, 0.5_mm},
      {-1.9_mm, 0.5_mm},
      {-2.0_mm, 1.5_mm},
      {-3.0_mm, 1.5_mm}},
     0.0,
     {{-1.0_mm, -2.0_mm}}},
    {"three_rings", {{0.0, 1.5_mm}, {-3.0_mm, 1.5_mm}}, 0.6_mm, {{-0.6_mm, -1.2_mm}, {-1.8_mm, -2.4_mm}}},
    {"closed_behind", {{0.0, 0.0}, {-1.0_mm, 1.5_mm}, {-2.0_mm, 0.0}}},
    {"waist_of_nothing", {{0.0, 0.0}, {-0.7_mm, 1.2_mm}, {-1.4_mm, 0.0}, {-2.1_mm, 1.2_mm}, {-2.8_mm, 0.0}}},
};

TEST(OutlineSweep, CutsExactlyWhatTheOutlineSweeps) {
    const Vec3 axis = normalized(Vec3{0.2, 0.1, -1.0}), side = normalized(cross(axis, Vec3{0.3, 0.5, 0.8}));
    for (const Shape& shape : shapes)
        for (const auto& [along, turn] : {std::pair<Vec3, double>{axis, 0.0},
                                          {-1.0 * axis, 0.0},
                                          {side, 0.0},
                                          {normalized(axis + side), 0.3},
                                          {normalized(side - axis), 0.3}}) {
            const Wrong wrong = stroke(shape.outline, shape.bore, shape.gaps, axis, along, 1.5_mm, turn);
            EXPECT_GT(wrong.inside, 10) << shape.name;
            EXPECT_EQ(wrong.missed, 0) << shape.name << ", deepest " << wrong.missed_depth * 1e3 << " mm of "
                                       << wrong.inside;
            EXPECT_EQ(wrong.extra, 0) << shape.name << ", highest " << wrong.extra_height * 1e3 << " mm of "
                                      << wrong.inside;
        }
}

}  // namespace
}  // namespace kerf
