// SPDX-License-Identifier: Apache-2.0
// The strategy `exact` against volumes that can be worked out by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "bone/remesh/accept.h"
#include "bone/remesh/remesh_child.h"
#include "bone/remesh/remesh_module.h"
#include "bone/surface/edges.h"
#include "kerf/units.hpp"
#include "tests/bone/surface/shapes.h"
#include "tests/support/block.h"

namespace kerf {
namespace {

using namespace literals;
using test::cube, test::sphere, test::together, test::turned;

constexpr const char* module_file = KERF_BUILD_DIR "/lib/kerf/kerf_remesh_cgal.so";
constexpr double taper_share = 3e-4;  // [–] of a volume: 0.1 µm at all sides of a stretch's beginning

class Exact : public testing::Test {
protected:
    static void SetUpTestSuite() {
        std::string error;
        module() = bone::RemeshModule::open(module_file, error);
        ASSERT_NE(module(), nullptr) << error;
    }
    static void TearDownTestSuite() { module().reset(); }

    bone::RemeshRequest request;

    void begin_with(bone::SurfaceMesh mesh) {
        request = {};
        request.base.mesh = std::move(mesh);
        request.base.tags.assign(request.base.mesh.triangles.size(), KERF_FACE_SURFACE);
        request.tolerance = 1e-6;
    }
    void cut(const ToolSolid& solid, const Pose& from, const Pose& to) {
        request.cuts.push_back({from, to, static_cast<std::uint16_t>(request.solids.size())});
        request.solids.push_back(&solid);
    }
    [[nodiscard]] bone::RemeshResult remesh() const { return bone::remesh_here(*module()->find("exact"), request); }
    /// The result, which the host accepts.
    [[nodiscard]] bone::TaggedMesh accepted() const {
        bone::RemeshResult result = remesh();
        EXPECT_EQ(result.status, KERF_OK) << result.message;
        EXPECT_EQ(bone::flaw_of_result(request, result.mesh), "");
        return std::move(result.mesh);
    }
    static std::unique_ptr<bone::RemeshModule>& module() {
        static std::unique_ptr<bone::RemeshModule> opened;
        return opened;
    }
};

double volume_of(const bone::TaggedMesh& mesh) { return bone::signed_volume_of(mesh.mesh); }
std::uint32_t pieces_in(const bone::TaggedMesh& mesh) {
    return bone::pieces_of(mesh.mesh, bone::half_edges_of(mesh.mesh)).count;
}
double wall_area_of(const bone::TaggedMesh& mesh) {
    double area = 0.0;
    for (std::size_t f = 0; f < mesh.tags.size(); ++f) {
        if (mesh.tags[f] != KERF_FACE_WALL) continue;
        const auto [a, b, c] = mesh.mesh.corners(mesh.mesh.triangles[f]);
        area += 0.5 * length(cross(b - a, c - a));
    }
    return area;
}

/// 24 mm wide, 1.2 mm thick: wider than the cube.
ToolSolid wide_blade() { return ToolSolid::prism({{0.0, 12.0_mm}, {-1.0_mm, 12.0_mm}}, 1.2_mm); }

/// The tool's z along +z of the cube, at this height of its tip.
Pose at(double x, double y, double z) { return {{x, y, z}, {1, 0, 0, 0}}; }

TEST_F(Exact, ASlotPartsACube) {
    begin_with(cube(10.0_mm));
    const ToolSolid blade = wide_blade();
    cut(blade, at(0, 0, -7.0_mm), at(0, 0, 7.0_mm));
    const bone::TaggedMesh left = accepted();
    EXPECT_EQ(pieces_in(left), 2U);
    EXPECT_NEAR(volume_of(left), 1000e-9 - 120e-9, taper_share * 120e-9);
    EXPECT_NEAR(wall_area_of(left), 200e-6, 1e-3 * 200e-6);
}

TEST_F(Exact, ASlotHalfWayLeavesOnePieceWithAFloor) {
    begin_with(cube(10.0_mm));
    const ToolSolid blade = wide_blade();
    cut(blade, at(0, 0, -7.0_mm), at(0, 0, 1.0_mm));  // 6 mm deep
    const bone::TaggedMesh left = accepted();
    EXPECT_EQ(pieces_in(left), 1U);
    EXPECT_NEAR(volume_of(left), 1000e-9 - 72e-9, taper_share * 72e-9);
    EXPECT_NEAR(wall_area_of(left), (120.0 + 12.0) * 1e-6, 1e-3 * 132e-6);
}

TEST_F(Exact, AHoleThroughTheCubeIsACylinder) {
    begin_with(cube(10.0_mm));
    const ToolSolid drill({{0.0, 2.0_mm}, {-12.0_mm, 2.0_mm}});
    cut(drill, at(1.0_mm, 0.5_mm, -6.0_mm), at(1.0_mm, 0.5_mm, 6.0_mm));
    const double exact = std::numbers::pi * 4.0 * 10.0 * 1e-9;
    EXPECT_NEAR(1000e-9 - volume_of(accepted()), exact, taper_share * exact);
}

TEST_F(Exact, ABlindHoleEndsInACone) {
    begin_with(cube(10.0_mm));
    const double radius = 2.0_mm, half_angle = 60.0_deg, depth = 6.0_mm;
    const ToolSolid drill = test::drill_outline(radius, half_angle, 30.0_mm);
    cut(drill, at(0, 0, -7.0_mm), at(0, 0, -5.0_mm + depth));
    const double exact = std::numbers::pi * radius * radius * (depth - 2.0 / 3.0 * radius / std::tan(half_angle));
    EXPECT_NEAR(1000e-9 - volume_of(accepted()), exact, taper_share * exact);
}

TEST_F(Exact, AStepDrillIsTwoCylinders) {
    begin_with(cube(10.0_mm));
    const ToolSolid drill({{0.0, 1.0_mm}, {-5.0_mm, 1.0_mm}, {-5.001_mm, 2.0_mm}, {-20.0_mm, 2.0_mm}});
    cut(drill, at(0, 0, -6.0_mm), at(0, 0, 6.0_mm));  // the wide part ends 1 mm above the middle
    const double exact = std::numbers::pi * (1.0 * 4.0 + 4.0 * 6.0) * 1e-9;
    EXPECT_NEAR(1000e-9 - volume_of(accepted()), exact, 2.0 * taper_share * exact);
}

TEST_F(Exact, ACavityStaysACavity) {
    begin_with(together(cube(10.0_mm), turned(cube(4.0_mm, {0, 2.0_mm, 0}))));
    const ToolSolid blade = wide_blade();
    cut(blade, at(0, -2.0_mm, -7.0_mm), at(0, -2.0_mm, 7.0_mm));
    const bone::TaggedMesh left = accepted();
    EXPECT_EQ(pieces_in(left), 3U);
    EXPECT_NEAR(volume_of(left), (1000.0 - 64.0 - 120.0) * 1e-9, taper_share * 120e-9);
}

TEST_F(Exact, StretchesJoinWithoutALedge) {
    begin_with(cube(10.0_mm));
    const ToolSolid blade = wide_blade();
    for (int i = 0; i < 14; ++i) cut(blade, at(0, 0, -7.0_mm + i * 1.0_mm), at(0, 0, -6.0_mm + i * 1.0_mm));
    const bone::TaggedMesh left = accepted();
    EXPECT_EQ(pieces_in(left), 2U);
    EXPECT_NEAR(volume_of(left), 880e-9, taper_share * 120e-9);
}

TEST_F(Exact, SurvivesWhatLiesInOnePlane) {
    const ToolSolid blade = wide_blade(), thin = ToolSolid::prism({{0.0, 12.0_mm}, {-1.0_mm, 12.0_mm}}, 0.8_mm);
    const Pose before = at(0, 0, -7.0_mm), behind = at(0, 0, 7.0_mm);
    struct Case {
        const char* what;
        std::vector<std::pair<Pose, Pose>> ways;
        double removed;  // [mm³]
    };
    const Case cases[] = {
        {"the same pass twice", {{before, behind}, {before, behind}}, 120.0},
        {"there and back", {{before, behind}, {behind, before}}, 120.0},
        {"re-entry over the whole depth", {{before, at(0, 0, 0)}, {before, behind}}, 120.0},
        {"a wall through vertices of the mesh", {{at(0, 4.4_mm, -7.0_mm), at(0, 4.4_mm, 7.0_mm)}}, 120.0},
        {"flush beside the first", {{before, behind}, {at(0, 1.2_mm, -7.0_mm), at(0, 1.2_mm, 7.0_mm)}}, 240.0},
        {"a wall of 1e-6 mm left between",
         {{before, behind}, {at(0, 1.2_mm + 1e-9, -7.0_mm), at(0, 1.2_mm + 1e-9, 7.0_mm)}},
         240.0},
    };
    for (const Case& one : cases) {
        begin_with(cube(10.0_mm));
        for (const auto& [from, to] : one.ways) cut(blade, from, to);
        std::string flaw = "none tried";
        bone::TaggedMesh left;
        for (request.nudge_seed = 0; request.nudge_seed < 5 && !flaw.empty(); ++request.nudge_seed) {
            bone::RemeshResult result = remesh();
            flaw = result.status == KERF_OK ? bone::flaw_of_result(request, result.mesh) : "refused: " + result.message;
            left = std::move(result.mesh);
        }
        EXPECT_EQ(flaw, "") << one.what;
        EXPECT_NEAR(1000.0 - volume_of(left) * 1e9, one.removed, 2.0 * taper_share * one.removed) << one.what;
    }
}

TEST_F(Exact, InTheAirNothingChanges) {
    begin_with(sphere(5.0_mm, 3));
    const ToolSolid blade = wide_blade();
    cut(blade, at(0, 8.0_mm, -7.0_mm), at(0, 8.0_mm, 7.0_mm));
    EXPECT_EQ(remesh().status, KERF_REMESH_UNCHANGED);
}

TEST_F(Exact, RefusesABaseThatIsNotClosed) {
    bone::SurfaceMesh open = sphere(5.0_mm, 3);
    open.triangles.pop_back();
    begin_with(std::move(open));
    const ToolSolid blade = wide_blade();
    cut(blade, at(0, 0, -7.0_mm), at(0, 0, 7.0_mm));
    const bone::RemeshResult result = remesh();
    EXPECT_EQ(result.status, KERF_REMESH_REFUSED);
    EXPECT_NE(result.message.find("open"), std::string::npos) << result.message;
}

TEST_F(Exact, MakesTheSameBitsHereAndInAProcessOfItsOwn) {
    begin_with(sphere(5.0_mm, 4));
    const ToolSolid blade = wide_blade();
    const Pose tilted{{0.1_mm, 0.2_mm, -7.0_mm}, quat_from_rotation_vector({0.2, 0.1, 0.3})};
    cut(blade, tilted, {tilted.position + Vec3{0, 0, 14.0_mm}, tilted.rotation});
    const bone::RemeshResult one = remesh(), two = remesh();
    std::string error;
    const auto child =
        bone::RemeshChild::start({KERF_BUILD_DIR "/libexec/kerf/kerf-remesh", module_file, "exact"}, error);
    ASSERT_NE(child, nullptr) << error;
    const bone::RemeshResult there = child->remesh(request, std::chrono::seconds(60));
    ASSERT_EQ(one.status, KERF_OK) << one.message;
    for (const bone::RemeshResult* other : {&two, &there}) {
        ASSERT_EQ(other->status, KERF_OK) << other->message;
        EXPECT_EQ(other->mesh.mesh.triangles, one.mesh.mesh.triangles);
        EXPECT_TRUE(std::equal(one.mesh.mesh.vertices.begin(), one.mesh.mesh.vertices.end(),
                               other->mesh.mesh.vertices.begin(), other->mesh.mesh.vertices.end(),
                               [](Vec3 a, Vec3 b) { return a == b; }));
    }
}

TEST_F(Exact, LeavesTheRoundingModeAsItWas) {
    begin_with(cube(10.0_mm));
    const ToolSolid blade = wide_blade();
    cut(blade, at(0, 0, -7.0_mm), at(0, 0, 7.0_mm));
    const int before = std::fegetround();
    std::fesetround(FE_UPWARD);
    const kerf_status status = remesh().status;
    const int after = std::fegetround();
    std::fesetround(before);
    EXPECT_EQ(status, KERF_OK);
    EXPECT_EQ(after, FE_UPWARD);
}

}  // namespace
}  // namespace kerf
