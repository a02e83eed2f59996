// SPDX-License-Identifier: Apache-2.0
// The strategy `local`: closed and free of crossings after every step, the volume that exact arithmetic gives.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "bone/remesh/accept.h"
#include "bone/remesh/local_cutting.h"
#include "bone/remesh/remesh_module.h"
#include "bone/surface/edges.h"
#include "kerf/units.hpp"
#include "tests/bone/surface/shapes.h"
#include "tests/support/sawn_tube.h"

namespace kerf {
namespace {

using namespace literals;
using test::bent_bone, test::blade_at, test::cut_across, test::slot_blade;

class Local : public testing::Test {
protected:
    static void SetUpTestSuite() {
        std::string error;
        module() = bone::RemeshModule::open(KERF_BUILD_DIR "/lib/kerf/kerf_remesh_cgal.so", error);
        ASSERT_NE(module(), nullptr) << error;
    }
    static void TearDownTestSuite() { module().reset(); }
    static std::unique_ptr<bone::RemeshModule>& module() {
        static std::unique_ptr<bone::RemeshModule> opened;
        return opened;
    }
    static bone::LocalCutting cutting(const bone::TaggedMesh& mesh, const ToolSolid& blade) {
        return {mesh, {&blade}, 20e-6, [](const bone::RemeshRequest& request) {
                    return bone::remesh_here(*module()->find("local"), request);
                }};
    }
    /// What is wrong with the surface in the end; empty if nothing is.
    static std::string flaw_of(const bone::TaggedMesh& base, const bone::LocalCutting& cutting) {
        for (const auto& stale : cutting.stale()) return "stale: " + stale.why;
        bone::RemeshRequest request;
        request.base = base;
        return bone::flaw_of_result(request, cutting.surface().mesh());
    }
    static std::uint32_t pieces_in(const bone::LocalCutting& cutting) {
        const bone::SurfaceMesh mesh = cutting.surface().mesh().mesh;
        return bone::pieces_of(mesh, bone::half_edges_of(mesh)).count;
    }
};

TEST_F(Local, PartsABoneStepByStep) {
    const bone::TaggedMesh bone = bone::tagged(bent_bone(8000.0));
    ASSERT_EQ(flaw_of(bone, cutting(bone, slot_blade())), "");
    const ToolSolid blade = slot_blade();
    bone::LocalCutting saw = cutting(bone, blade);
    for (const bone::CutStretch& step : cut_across(0.0, -13.0_mm, 13.0_mm, 0.5_mm, 3.0_mm)) EXPECT_TRUE(saw.cut(step));
    EXPECT_EQ(flaw_of(bone, saw), "");
    EXPECT_EQ(pieces_in(saw), 2U);
    const double removed = bone::signed_volume_of(bone.mesh) - bone::signed_volume_of(saw.surface().mesh().mesh);
    EXPECT_NEAR(saw.removed(), removed, 1e-6 * removed);

    bone::RemeshRequest exact;
    exact.base = bone;
    exact.solids = {&blade};
    exact.cuts = {{blade_at(0.0, -13.0_mm), blade_at(0.0, 13.0_mm), 0}};
    const bone::RemeshResult reference = bone::remesh_here(*module()->find("exact"), exact);
    ASSERT_EQ(reference.status, KERF_OK) << reference.message;
    const double exactly = bone::signed_volume_of(bone.mesh) - bone::signed_volume_of(reference.mesh.mesh);
    EXPECT_NEAR(removed, exactly, 5e-4 * exactly);
}

TEST_F(Local, SurvivesATremblingHand) {
    const bone::TaggedMesh bone = bone::tagged(bent_bone(8000.0));
    const ToolSolid blade = slot_blade();
    bone::LocalCutting saw = cutting(bone, blade);
    std::mt19937 random(5);
    std::normal_distribution<double> tremor(0.0, 20e-6);
    Pose last = blade_at(0.0, -13.0_mm);
    for (int i = 1; i <= 60; ++i) {
        const Pose next = blade_at(0.0, -13.0_mm + 0.4_mm * i, i % 2 == 0 ? 0.0 : 3.0_mm,
                                   {tremor(random), tremor(random), tremor(random)});
        saw.cut({last, next, 0});
        last = next;
    }
    EXPECT_EQ(saw.refusals(), 0);
    EXPECT_EQ(flaw_of(bone, saw), "");
    EXPECT_EQ(pieces_in(saw), 2U);
}

// ---- where methods fail -------------------------------------------------------------------------------------------

/// One way of sawing that has broken a mesh cutter. The stroke is 0, so that edges are parallel.
struct Scenario {
    const char* name;
    std::vector<bone::CutStretch> cuts;  ///< solid 0: the blade; 1: one 2 µm thinner a side; 2: a drill
    std::uint32_t pieces;
    bool is_hollow = false;
};

std::vector<bone::CutStretch> then(std::vector<bone::CutStretch> a, const std::vector<bone::CutStretch>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}
std::vector<bone::CutStretch> with(std::uint16_t solid, std::vector<bone::CutStretch> cuts) {
    for (bone::CutStretch& cut : cuts) cut.solid = solid;
    return cuts;
}
std::vector<bone::CutStretch> moved(Vec3 by, std::vector<bone::CutStretch> cuts) {
    for (bone::CutStretch& cut : cuts) {
        cut.from.position = cut.from.position + by;
        cut.to.position = cut.to.position + by;
    }
    return cuts;
}

std::vector<Scenario> scenarios() {
    const auto steps = [](double from, double to, double feed) { return cut_across(0.0, from, to, feed, 0.0); };
    const auto through = steps(-13.0_mm, 13.0_mm, 1.0_mm), half = steps(-13.0_mm, 0.0, 1.0_mm);
    const Pose before = blade_at(0.0, -13.0_mm), behind = blade_at(0.0, 13.0_mm);
    const Vec3 normal = rotate(before.rotation, {0, 1, 0});
    std::vector<bone::CutStretch> tilting;
    for (int i = 0; i < 26; ++i) {
        const auto at = [&](int n) {
            Pose pose = blade_at(0.0, -13.0_mm + n * 1.0_mm);
            pose.rotation = pose.rotation * quat_from_rotation_vector({0.004 * n, 0, 0});
            return pose;
        };
        tilting.push_back({at(i), at(i + 1), 0});
    }
    // The wall of the slot through a vertex of the mesh near its middle
    const bone::SurfaceMesh bone = bent_bone(8000.0);
    Vec3 vertex = bone.vertices.front();
    for (const Vec3 v : bone.vertices)
        if (length(v) < length(vertex)) vertex = v;
    const Vec3 onto = dot(vertex - before.position, normal) * normal - 0.2_mm * normal;
    const Pose drill{{0, 3.0_mm, 12.0_mm}, quat_between({0, 0, 1}, {0, 0, -1})};
    const std::vector<bone::CutStretch> at_once{{before, behind, 0}}, back{{behind, before, 0}};
    const std::vector<bone::CutStretch> hole{{drill, {{0, 3.0_mm, -12.0_mm}, drill.rotation}, 2}};
    const auto nearly = steps(-13.0_mm, -2.0_mm, 1.0_mm);
    return {
        {"flush steps", through, 2},
        {"one step", at_once, 2},
        {"the same pass twice", then(through, through), 2},
        {"withdrawn, and over the whole depth again", then(half, at_once), 2},
        {"again with a thinner blade", then(half, with(1, through)), 2},
        {"again 0.13 mm beside", then(half, moved(0.13_mm * normal, through)), 2},
        {"there and back", then(through, back), 2},
        {"50 steps of 0.01 mm", then(nearly, steps(-2.0_mm, -1.5_mm, 0.01_mm)), 1},
        {"20 steps of 0.001 mm", then(nearly, steps(-2.0_mm, -1.98_mm, 0.001_mm)), 1},
        {"grazing", steps(-13.0_mm, -5.9_mm, 0.05_mm), 1},
        {"through a thin shell", through, 2, true},
        {"through a drilled hole", then(hole, through), 2},
        {"a blade that tilts", tilting, 2},
        {"a wall of 1e-6 mm between two slots", then(through, moved((0.4_mm + 1e-9) * normal, through)), 3},
        {"a wall through a vertex", moved(onto, through), 2},
    };
}

/// A bone and its copy 0.3 mm inside it, or nearly so, inside out.
bone::SurfaceMesh hollow(const bone::SurfaceMesh& bone) {
    bone::SurfaceMesh inner = bone;
    for (Vec3& v : inner.vertices) v = {0.99 * v.x, 0.965 * (v.y - 2.0_mm) + 2.0_mm, 0.965 * v.z};
    return test::together(bone, test::turned(inner));
}

class LocalScenarios : public Local, public testing::WithParamInterface<std::size_t> {};

TEST_P(LocalScenarios, StayClosedAndFreeOfCrossings) {
    const Scenario scenario = scenarios()[GetParam()];
    const bone::TaggedMesh bone = bone::tagged(scenario.is_hollow ? hollow(bent_bone(8000.0)) : bent_bone(8000.0));
    const ToolSolid blade = slot_blade(), thinner = ToolSolid::prism(slot_blade().outline(), 0.396_mm),
                    drill({{0.0, 2.0_mm}, {-1.0_mm, 2.0_mm}});
    bone::LocalCutting saw(bone, {&blade, &thinner, &drill}, 20e-6, [](const bone::RemeshRequest& request) {
        return bone::remesh_here(*module()->find("local"), request);
    });
    for (const bone::CutStretch& cut : scenario.cuts) saw.cut(cut);
    EXPECT_EQ(flaw_of(bone, saw), "") << scenario.name;
    EXPECT_EQ(pieces_in(saw), scenario.is_hollow ? 2U : scenario.pieces) << scenario.name;
    RecordProperty("refusals", saw.refusals());
}
INSTANTIATE_TEST_SUITE_P(, LocalScenarios, testing::Range<std::size_t>(0, 15));

}  // namespace
}  // namespace kerf
