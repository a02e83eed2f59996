// SPDX-License-Identifier: Apache-2.0
// A saw takes the right angle off a real mandible: KERF_DATA/meshes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bone/remesh/accept.h"
#include "bone/remesh/base_mesh.h"
#include "bone/remesh/local_cutting.h"
#include "bone/remesh/remesh_module.h"
#include "bone/surface/edges.h"
#include "bone/surface/read_surface.h"
#include "kerf/units.hpp"

namespace kerf {
namespace {

using namespace literals;

/// Its front, 60 mm wide, leaves a slot of 1 mm.
ToolSolid blade() { return ToolSolid::prism({{0.0, 30.0_mm}, {-2.0_mm, 30.0_mm}}, 1.0_mm); }

/// From the cheek inwards, across the corner between ramus and body, 8 mm before the right gonion.
Pose blade_at(double x) {
    const double half = std::sqrt(0.5);
    const Vec3 gonion{-58.2_mm, 65.8_mm, -187.0_mm}, out{0, half, -half};
    // Tool z inwards, its width along the cut, its thickness towards the corner.
    const Quat inwards = quat_between({0, 0, 1}, {1, 0, 0});
    const Quat upright = quat_between(rotate(inwards, {0, 1, 0}), out);
    return {Vec3{x, gonion.y, gonion.z} - 8.0_mm * out, upright * inwards};
}

TEST(RealMandible, LosesAnAngleToASaw) {
    const char* folder = std::getenv("KERF_DATA");
    const std::filesystem::path file =
        std::filesystem::path(folder != nullptr ? folder : "") / "meshes/mandible_harvard02_isosurface.obj";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "KERF_DATA names no folder with meshes/.";
    text::Diagnostics diagnostics;
    auto read = bone::read_surface(file.string()).take(diagnostics);
    ASSERT_TRUE(read) << text::to_text(diagnostics);
    for (Vec3& v : read->mesh.vertices) v = 1e-3 * v;
    bone::remove_flat_faces(read->mesh);
    ASSERT_EQ(bone::flaw_of_base(read->mesh), "");
    const bone::TaggedMesh bone = bone::tagged(read->mesh);
    std::string error;
    const auto module = bone::RemeshModule::open(KERF_BUILD_DIR "/lib/kerf/kerf_remesh_cgal.so", error);
    ASSERT_NE(module, nullptr) << error;

    const ToolSolid saw = blade();
    std::vector<bone::CutStretch> steps;
    for (double x = -80.0_mm; x < -40.0_mm; x += 1.0_mm) steps.push_back({blade_at(x), blade_at(x + 1.0_mm), 0});
    bone::LocalCutting cutting(bone, {&saw}, 20e-6, [&](const bone::RemeshRequest& request) {
        return bone::remesh_here(*module->find("local"), request);
    });
    for (const bone::CutStretch& step : steps) ASSERT_TRUE(cutting.cut(step)) << cutting.stale().front().why;
    const bone::TaggedMesh cut = cutting.surface().mesh();

    bone::RemeshRequest whole;
    whole.base = bone;
    whole.solids = {&saw};
    whole.cuts = steps;
    EXPECT_EQ(bone::flaw_of_result(whole, cut), "");
    const bone::RemeshResult exact = bone::remesh_here(*module->find("exact"), whole);
    ASSERT_EQ(exact.status, KERF_OK) << exact.message;
    EXPECT_EQ(bone::flaw_of_result(whole, exact.mesh), "");
    const double removed = bone::signed_volume_of(bone.mesh) - bone::signed_volume_of(exact.mesh.mesh);
    EXPECT_GT(removed, 50e-9);
    EXPECT_NEAR(cutting.removed(), removed, 5e-4 * removed);

    // The angle is a part of its own.
    const auto parts_in = [](const bone::SurfaceMesh& mesh) {
        return bone::pieces_of(mesh, bone::half_edges_of(mesh)).count;
    };
    EXPECT_GT(parts_in(cut.mesh), parts_in(bone.mesh));
    EXPECT_EQ(parts_in(cut.mesh), parts_in(exact.mesh.mesh));
    RecordProperty("removed_mm3", std::to_string(removed * 1e9));
    RecordProperty("faces", std::to_string(cut.tags.size()));
}

}  // namespace
}  // namespace kerf
