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

#include "core/import/surface/edges.h"
#include "core/remesh/accept.h"
#include "core/remesh/local_cutting.h"
#include "core/remesh/remesh_module.h"
#include "kerf/units.hpp"
#include "tests/core/import/surface/shapes.h"
#include "tests/support/sawn_tube.h"

namespace kerf {
namespace {

using namespace literals;
using test::bent_bone, test::blade_at, test::cut_across, test::slot_blade;

class Local : public testing::Test {
protected:
    static void SetUpTestSuite() {
        std::string error;
        module() = RemeshModule::open(KERF_BUILD_DIR "/lib/kerf-remesh/kerf_remesh_cgal.so", error);
        ASSERT_NE(module(), nullptr) << error;
    }
    static void TearDownTestSuite() { module().reset(); }
    static std::unique_ptr<RemeshModule>& module() {
        static std::unique_ptr<RemeshModule> opened;
        return opened;
    }
    static TaggedMesh tagged(SurfaceMesh mesh) {
        TaggedMesh all{std::move(mesh), {}};
        all.tags.assign(all.mesh.triangles.size(), KERF_FACE_SURFACE);
        return all;
    }
    static LocalCutting cutting(const TaggedMesh& mesh, const ToolSolid& blade) {
        return {mesh, {&blade}, 20e-6, [](const RemeshRequest& request) {
                    return remesh_here(*module()->find("local"), request);
                }};
    }
    /// What is wrong with the surface in the end; empty if nothing is.
    static std::string flaw_of(const TaggedMesh& base, const LocalCutting& cutting) {
        for (const auto& stale : cutting.stale()) return "stale: " + stale.why;
        RemeshRequest request;
        request.base = base;
        return flaw_of_result(request, cutting.surface().mesh());
    }
    static std::uint32_t pieces_in(const LocalCutting& cutting) {
        const SurfaceMesh mesh = cutting.surface().mesh().mesh;
        return pieces_of(mesh, half_edges_of(mesh)).count;
    }
};

TEST_F(Local, PartsABoneStepByStep) {
    const TaggedMesh bone = tagged(bent_bone(8000.0));
    ASSERT_EQ(flaw_of(bone, cutting(bone, slot_blade())), "");
    const ToolSolid blade = slot_blade();
    LocalCutting saw = cutting(bone, blade);
    for (const CutStretch& step : cut_across(0.0, -13.0_mm, 13.0_mm, 0.5_mm, 3.0_mm)) EXPECT_TRUE(saw.cut(step));
    EXPECT_EQ(flaw_of(bone, saw), "");
    EXPECT_EQ(pieces_in(saw), 2U);
    const double removed = signed_volume_of(bone.mesh) - signed_volume_of(saw.surface().mesh().mesh);
    EXPECT_NEAR(saw.removed(), removed, 1e-6 * removed);

    RemeshRequest exact;
    exact.base = bone;
    exact.solids = {&blade};
    exact.cuts = {{blade_at(0.0, -13.0_mm), blade_at(0.0, 13.0_mm), 0}};
    const RemeshResult reference = remesh_here(*module()->find("exact"), exact);
    ASSERT_EQ(reference.status, KERF_OK) << reference.message;
    const double exactly = signed_volume_of(bone.mesh) - signed_volume_of(reference.mesh.mesh);
    EXPECT_NEAR(removed, exactly, 5e-4 * exactly);
}

TEST_F(Local, SurvivesATremblingHand) {
    const TaggedMesh bone = tagged(bent_bone(8000.0));
    const ToolSolid blade = slot_blade();
    LocalCutting saw = cutting(bone, blade);
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

}  // namespace
}  // namespace kerf
