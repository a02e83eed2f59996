// SPDX-License-Identifier: Apache-2.0
#include "run/view/tool_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/run/view/viewed_mesh_checks.h"
#include "tests/support/drill_rig.h"

namespace kerf::run {
namespace {

using namespace literals;
using test::vector_of;
constexpr double turn = 2.0 * std::numbers::pi;

/// A solid of revolution that removes no bone and has no parameters.
Tool turned(std::vector<kerf_profile_point> profile) {
    Tool tool;
    tool.outline.profile = profile;
    tool.outline.cutting = tool.outline.whole = ToolSolid(std::move(profile));
    return tool;
}

/// A screw without parameters, with a core of 3 mm, a crest of 6 mm, and a thread from z = −4 mm to −4 mm − `length`.
Tool screw(double length, double lead) {
    Tool tool = turned({{0.0, 0.0}, {-4.0_mm, 1.5_mm}, {-4.0_mm - length, 1.5_mm}});
    ToolOutline& outline = tool.outline;
    outline.cutting_count = outline.thread_count = outline.stay_count = 3;
    outline.thread_radius = 3.0_mm;
    outline.thread_lead = lead;
    return tool;
}

/// A tool of a plugin. Nothing comes back if its parameters conflict.
std::optional<Tool> shipped(const ComponentInfo& info, const std::map<std::string, double>& set) {
    Tool tool;
    tool.setup.tool = test::plugins().find(info.plugin, KERF_KIND_TOOL, info.id);
    tool.setup.tool_parameters = test::values(info.parameters, set);
    tool.setup.drives = test::values(info.drives, set);
    std::string why;
    if (!outline_of(tool.setup, tool.outline, why)) return std::nullopt;
    return tool;
}
Tool shipped(const std::string& id, const std::map<std::string, double>& set = {}) {
    for (const ComponentInfo& info : test::plugins().catalog())
        if (info.kind == KERF_KIND_TOOL && info.id == id) return shipped(info, set).value();
    throw std::runtime_error("no tool " + id);
}
std::vector<ComponentInfo> all_tools() {
    std::vector<ComponentInfo> tools = test::plugins().catalog();
    std::erase_if(tools, [](const ComponentInfo& info) { return info.kind != KERF_KIND_TOOL; });
    return tools;
}

double radius_of(const std::array<float, 3>& p) { return std::hypot(vector_of(p).x, vector_of(p).y); }

/// Returns the largest distance of a point outside the tool [m].
double farthest_outside(const ViewedMesh& mesh, const ToolOutline& outline) {
    double farthest = -1.0;
    for (const auto& position : mesh.positions) {
        const Vec3 p = vector_of(position);
        double distance = std::min(outline.whole.distance(p), outline.cutting.distance(p));
        if (outline.has_thread()) distance = std::min(distance, outline.crest.distance(p));
        farthest = std::max(farthest, distance);
    }
    return farthest;
}

/// Returns the mean of the unit vectors at the angle φ − turn z / `lead` of some points [–]: 1 if they lie on a
/// right-hand helix.
template <class Is>
double on_helix(const ViewedMesh& mesh, double lead, const Is& is) {
    double x = 0.0, y = 0.0, count = 0.0;
    for (const auto& position : mesh.positions) {
        const Vec3 p = vector_of(position);
        if (!is(p)) continue;
        const double phase = std::atan2(p.y, p.x) - turn * p.z / lead;
        x += std::cos(phase);
        y += std::sin(phase);
        count += 1.0;
    }
    return std::hypot(x, y) / count;
}

TEST(TurnedShape, CylinderHasAreaAndVolumeOfAPrism) {
    // A regular prism with 48 sides: half of 48 sin(7.5°) is 3.13263.
    const ViewedMesh mesh = tool_shape(turned({{0.0, 5.0_mm}, {-20.0_mm, 5.0_mm}}));
    const double base = 3.13263 * 25e-6, side = 2.0 * 5.0_mm * std::sin(turn / 96.0);

    EXPECT_NEAR(test::volume(mesh) / (base * 20.0_mm), 1.0, 3e-6);
    EXPECT_NEAR(test::area(mesh) / (2.0 * base + 48.0 * side * 20.0_mm), 1.0, 3e-6);
    EXPECT_EQ(mesh.triangles.size(), 4u * 48u);
    EXPECT_EQ(mesh.positions.size(), 4u * 48u + 2u);  // each rim twice, and the middles of the ends
    EXPECT_EQ(test::open_edges(mesh), 0);
}

TEST(TurnedShape, SmoothsCornersBelow30Degrees) {
    // The profile turns by 20° at −10 mm, and by 40° at −20 mm.
    const double narrow = 5.0_mm - 10.0_mm * std::tan(20.0_deg);
    const ViewedMesh mesh = tool_shape(turned(
        {{0.0, 5.0_mm}, {-10.0_mm, 5.0_mm}, {-20.0_mm, narrow}, {-20.5_mm, narrow - 0.5_mm * std::tan(60.0_deg)}}));
    const auto normals_at = [&](double z) {
        std::set<std::array<float, 3>> all;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            if (std::abs(vector_of(mesh.positions[i]).z - z) < 1.0_um && mesh.positions[i][1] == 0.0f &&
                mesh.positions[i][0] > 0.0f)
                all.insert(mesh.normals[i]);
        return all;
    };

    ASSERT_EQ(normals_at(-10.0_mm).size(), 1u);
    const Vec3 smooth = vector_of(*normals_at(-10.0_mm).begin());
    EXPECT_GT(-smooth.z, std::sin(5.0_deg));
    EXPECT_LT(-smooth.z, std::sin(15.0_deg));
    EXPECT_EQ(normals_at(-20.0_mm).size(), 2u);
}

TEST(TurnedShape, TubeIsOpenAtTheTip) {
    // 10 mm of tube in front of 5 mm of rod.
    Tool tool = turned({{0.0, 4.0_mm}, {-10.0_mm, 4.0_mm}, {-15.0_mm, 4.0_mm}});
    tool.outline.cutting = ToolSolid::hollow({{0.0, 4.0_mm}, {-10.0_mm, 4.0_mm}}, 3.0_mm);
    tool.outline.cutting_count = 2;
    const ViewedMesh mesh = tool_shape(tool);

    EXPECT_NEAR(test::volume(mesh) / (3.13263 * (16e-6 * 15.0_mm - 9e-6 * 10.0_mm)), 1.0, 3e-6);
    EXPECT_EQ(test::open_edges(mesh), 0);
    EXPECT_GT(test::worst_side(mesh), 0.99);
}

TEST(ThreadShape, HasTheVolumeOfItsSweptSection) {
    // The section of the ridge, h = 1.5 mm high: two flanks of 30°, each 0.866 mm long, and a crest of
    // 0.12 · 4 mm. Its area is a rectangle and two triangles, whose centroids are h/2 and h/3 above the core.
    const double pitch = 4.0_mm, core = 1.5_mm, h = 1.5_mm, flank = h * std::tan(30.0_deg), crest = 0.12 * pitch;
    const double moment = crest * h * (core + 0.5 * h) + flank * h * (core + h / 3.0);
    const double per_length = turn * moment / pitch + 0.5 * turn * core * core;
    const double polygon = std::sin(turn / 48.0) / (turn / 48.0);  // of the area of a circle

    const double longer = test::volume(tool_shape(screw(40.0_mm, pitch))),
                 shorter = test::volume(tool_shape(screw(24.0_mm, pitch)));

    EXPECT_NEAR((longer - shorter) / (polygon * per_length * 16.0_mm), 1.0, 5e-3 /* facets of 7.5° */);
}

TEST(ThreadShape, IsRightHandedUpToItsCrest) {
    const ViewedMesh mesh = tool_shape(screw(40.0_mm, 2.5_mm));
    const auto is_crest = [](Vec3 p) { return std::hypot(p.x, p.y) > 2.9999_mm; };

    double widest = 0.0;
    for (const auto& p : mesh.positions) widest = std::max(widest, radius_of(p));
    EXPECT_NEAR(widest, 3.0_mm, 1e-9);
    EXPECT_NEAR(on_helix(mesh, 2.5_mm, is_crest), std::cos(0.06 * turn), 1e-3);  // two edges, 0.12 turns apart
    EXPECT_LT(on_helix(mesh, -2.5_mm, is_crest), 0.05);
}

TEST(ThreadShape, EndsOnItsCore) {
    const ViewedMesh mesh = tool_shape(screw(30.0_mm, 2.5_mm));

    for (const auto& p : mesh.positions)
        if (std::abs(vector_of(p).z + 4.0_mm) < 1.0_um || std::abs(vector_of(p).z + 34.0_mm) < 1.0_um) {
            EXPECT_LT(radius_of(p), 1.5_mm + 1e-9);
        }
    EXPECT_EQ(test::open_edges(mesh), 0);
}

TEST(ThreadShape, TapersWithItsParameter) {
    const Tool implant = shipped("dental_implant", {{"outer_diameter", 4.0_mm}, {"outer_taper", 0.6_mm}});
    const double half = 0.5 * implant.outline.profile[2].z;
    double widest = 0.0;
    for (const auto& p : tool_shape(implant).positions)
        if (std::abs(vector_of(p).z - half) < 0.4_mm) widest = std::max(widest, radius_of(p));

    EXPECT_NEAR(widest, 2.0_mm - 0.15_mm, 0.02_mm /* by its taper over 0.4 mm */);
}

TEST(ThreadShape, TapHasFlutesBelowItsCore) {
    const Tool tap = shipped("tap");
    double deepest = 1.0;
    for (const auto& p : tool_shape(tap).positions)
        if (std::abs(vector_of(p).z + 20.0_mm) < 2.0_mm) deepest = std::min(deepest, radius_of(p));

    EXPECT_LT(deepest, 0.8 * 1.5_mm);
    EXPECT_GT(deepest, 0.7 * 1.5_mm);
}

TEST(StayingShape, IsTheScrewWithoutItsDriver) {
    const Tool screw = shipped("bone_screw", {{"thread_length", 30.0_mm}, {"head_diameter", 8.0_mm}});
    const ViewedMesh whole = tool_shape(screw), staying = staying_shape(screw);
    const auto lowest = [](const ViewedMesh& mesh) {
        double z = 0.0;
        for (const auto& p : mesh.positions) z = std::min(z, vector_of(p).z);
        return z;
    };

    EXPECT_NEAR(lowest(staying), -36.0_mm, 1.0_um);  // the head is 6 mm high
    EXPECT_LT(lowest(whole), -100.0_mm);
    EXPECT_EQ(test::open_edges(staying), 0);
    EXPECT_TRUE(staying_shape(shipped("tap")).triangles.empty());
    EXPECT_TRUE(staying_shape(shipped("twist_drill")).triangles.empty());
}

TEST(DrillShape, HasTwoRightHandFlutes) {
    // The pitch of a helix of 45° at the diameter is its circumference, 10.05 mm.
    const ViewedMesh mesh = tool_shape(shipped("twist_drill", {{"diameter", 3.2_mm}, {"helix_angle", 45.0_deg}}));
    const auto is_bottom = [](Vec3 p) {  // of one flute or the other: the angle counts twice
        return std::hypot(p.x, p.y) < 0.2201 * 1.6_mm && p.z < -2.0_mm && p.z > -20.0_mm;
    };
    double x = 0.0, y = 0.0, count = 0.0;
    for (const auto& position : mesh.positions) {
        const Vec3 p = vector_of(position);
        if (!is_bottom(p)) continue;
        const double phase = 2.0 * (std::atan2(p.y, p.x) - p.z / 1.6_mm);
        x += std::cos(phase);
        y += std::sin(phase);
        count += 1.0;
    }

    ASSERT_GT(count, 50.0);
    EXPECT_GT(std::hypot(x, y) / count, 0.99);
}

TEST(DrillShape, LeavesItsPointOnTheCone) {
    // Each point in front of the corners lies on the cone of 118°, or in a flute.
    const Tool drill = shipped("twist_drill", {{"diameter", 4.0_mm}});
    const double slope = std::tan(59.0_deg);
    int on_cone = 0, in_flute = 0;
    for (const auto& position : tool_shape(drill).positions) {
        const double z = vector_of(position).z, off = radius_of(position) + z * slope;
        if (z > -1.2_mm) ++(off > -1.0_um ? on_cone : in_flute);
        if (z > -0.25_mm) {
            EXPECT_GT(off, -1.0_um) << "at the web";
        }
    }

    EXPECT_GT(on_cone, 50);
    EXPECT_GT(in_flute, 50);
}

TEST(DrillShape, AwlIsSmooth) {
    // With its spindle off, the outline is turned: its volume is that of cones and cylinders.
    const Tool awl = shipped("profile_drill", {{"spindle_speed", 0.0}, {"diameter", 4.0_mm}});
    const std::vector<kerf_profile_point>& profile = awl.outline.profile;
    double expected = 0.0;
    for (std::size_t i = 1; i < profile.size(); ++i) {
        const double a = profile[i - 1].radius, b = profile[i].radius;
        expected += 3.13263 / 3.0 * (a * a + a * b + b * b) * (profile[i - 1].z - profile[i].z);
    }

    EXPECT_NEAR(test::volume(tool_shape(awl)) / expected, 1.0, 1e-5);
}

TEST(BurrShape, HasShallowFlutesInItsHead) {
    // Given a ball of 4 mm with 8 blades
    const Tool burr = shipped("round_burr", {{"diameter", 4.0_mm}, {"blades", 8.0}});
    const ViewedMesh mesh = tool_shape(burr);

    // Then it has 8 edges around its equator, the rest is deeper by a fifth at most, and the neck is round
    std::set<long> edges;
    for (const auto& position : mesh.positions) {
        const Vec3 p = vector_of(position);
        if (std::abs(p.z + 2.0_mm) < 0.15_mm && radius_of(position) > 1.99_mm)
            edges.insert(std::lround(std::atan2(p.y, p.x) / 20.0_deg));
        if (std::abs(p.z + 2.0_mm) < 0.15_mm) {
            EXPECT_GT(radius_of(position), 0.78 * 2.0_mm);
        }
        if (p.z < -5.0_mm && radius_of(position) > 0.0) {
            EXPECT_NEAR(radius_of(position), 0.8_mm, 1.0_um);
        }
    }
    EXPECT_EQ(edges.size(), 8u);
}

TEST(BladeShape, HasTeethToTheEdgesOfItsKerf) {
    // 10 mm of edge at a pitch of 1 mm: ten teeth, 1 mm high, in a kerf of 1 mm.
    const ViewedMesh mesh = tool_shape(shipped("reciprocating_blade", {{"blade_length", 10.0_mm},
                                                                       {"stroke", 0.5_mm},
                                                                       {"tooth_pitch", 1.0_mm},
                                                                       {"tooth_height", 0.8_mm},
                                                                       {"blade_thickness", 0.8_mm},
                                                                       {"tooth_set", 0.1_mm}}));
    std::map<double, std::set<float>> tips;  // by x: values of y
    double left = 0.0, right = 0.0;
    for (const auto& position : mesh.positions) {
        const Vec3 p = vector_of(position);
        if (p.z == 0.0) tips[std::round(1e6 * p.x)].insert(position[1]);
        if (p.z < -0.7_mm) {
            EXPECT_NEAR(std::abs(p.y), 0.4_mm, 1e-9);
        }
        left = std::max(left, p.y);
        right = std::min(right, p.y);
    }

    EXPECT_NEAR(static_cast<double>(tips.size()), 10.0, 1.0) << "the stroke is part of the outline";
    for (const auto& [x, y] : tips) EXPECT_EQ(y.size(), 2u) << x;
    EXPECT_NEAR(left, 0.5_mm, 1e-9);
    EXPECT_NEAR(right, -0.5_mm, 1e-9);
    EXPECT_EQ(test::open_edges(mesh), 0);
}

TEST(BladeShape, ChiselHasAPlainEdge) {
    Tool chisel;
    chisel.outline.profile = {{0.0, 5.0_mm}, {-20.0_mm, 5.0_mm}};
    chisel.outline.cutting = chisel.outline.whole = ToolSolid::prism(chisel.outline.profile, 2.0_mm);
    chisel.outline.cutting_count = 2;
    const ViewedMesh mesh = tool_shape(chisel);

    EXPECT_NEAR(test::volume(mesh), 10.0_mm * 20.0_mm * 2.0_mm, 1e-12);
    EXPECT_NEAR(test::area(mesh), 2.0 * (200e-6 + 40e-6 + 20e-6), 1e-9);
    EXPECT_EQ(test::open_edges(mesh), 0);
}

TEST(EachToolShape, IsClosedAndWithinItsOutline) {
    for (const ComponentInfo& info : all_tools()) {
        const Tool tool = shipped(info, {}).value();
        for (const bool is_staying : {false, true}) {
            const ViewedMesh mesh = is_staying ? staying_shape(tool) : tool_shape(tool);
            SCOPED_TRACE(info.id + (is_staying ? ", staying" : ""));
            EXPECT_EQ(mesh.triangles.empty(), is_staying && !tool.outline.is_implant());
            if (mesh.triangles.empty()) continue;

            EXPECT_LE(mesh.triangles.size(), max_tool_triangles);
            EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
            EXPECT_LT(test::worst_length(mesh), 1e-5);
            EXPECT_GT(test::worst_side(mesh), 0.3);
            EXPECT_GT(test::volume(mesh), 0.0);
            EXPECT_EQ(test::open_edges(mesh), 0);
            EXPECT_LE(farthest_outside(mesh, tool.outline), 1.0_um);
        }
    }
}

TEST(EachToolShape, KeepsItsLimitsAtTheEndsOfAllRanges) {
    int made = 0;
    for (const ComponentInfo& info : all_tools())
        for (const ParameterInfo& parameter : info.parameters)
            for (const double value : {parameter.min, parameter.max}) {
                const auto tool = shipped(info, {{parameter.id, value}});
                if (!tool) continue;
                const ViewedMesh mesh = tool_shape(*tool);
                EXPECT_LE(mesh.triangles.size(), max_tool_triangles) << info.id << " " << parameter.id << " " << value;
                EXPECT_GT(test::volume(mesh), 0.0) << info.id << " " << parameter.id << " " << value;
                EXPECT_LE(farthest_outside(mesh, tool->outline), 1.0_um)
                    << info.id << " " << parameter.id << " " << value;
                EXPECT_GT(test::worst_side(mesh), 0.0) << info.id << " " << parameter.id << " " << value;
                ++made;
            }
    EXPECT_GT(made, 100);
}

TEST(EachToolShape, KeepsItsLimitForTheFinestOutlines) {
    // 64 points, the most that an outline has: a drill whose radius rises and falls at each, a thread of 10 000 turns.
    std::vector<kerf_profile_point> zigzag, smooth;
    for (int i = 0; i < 64; ++i) {
        zigzag.push_back({-1.0_mm * i, i % 2 == 0 ? 1.0_mm + 0.0 : 5.0_mm + 0.0});
        smooth.push_back({-1.0_mm * i, i == 0 ? 0.0 : 2.0_mm + 0.0});
    }
    Tool drill = shipped("twist_drill");
    drill.outline.profile = zigzag;
    drill.outline.cutting = drill.outline.whole = ToolSolid(zigzag);
    drill.outline.cutting_count = 64;
    Tool thread = turned(smooth);
    thread.outline.cutting_count = thread.outline.thread_count = 64;
    thread.outline.thread_radius = 3.0_mm;
    thread.outline.thread_lead = 6.3_um;

    for (const Tool* tool : {&drill, &thread}) {
        const ViewedMesh mesh = tool_shape(*tool);
        EXPECT_LE(mesh.triangles.size(), max_tool_triangles);
        EXPECT_GT(mesh.triangles.size(), 1000u);
        EXPECT_EQ(test::open_edges(mesh), 0);
    }
}

TEST(EachToolShape, NeedleOfNoWidthIsEmpty) {
    Tool needle = shipped("twist_drill");
    needle.outline.profile = {{0.0, 0.0}, {-20.0_mm, 0.0}};
    needle.outline.cutting = needle.outline.whole = ToolSolid(needle.outline.profile);
    needle.outline.cutting_count = 2;

    EXPECT_TRUE(tool_shape(needle).triangles.empty());
    EXPECT_TRUE(tool_shape(Tool{}).triangles.empty());
}

}  // namespace
}  // namespace kerf::run
