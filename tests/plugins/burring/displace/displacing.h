// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bone/remesh/accept.h"
#include "bone/remesh/local_cutting.h"
#include "bone/remesh/remesh_module.h"
#include "bone/surface/edges.h"
#include "kerf/units.hpp"
#include "studies/chart/surfaces/burr_on_slab.h"

namespace kerf::test {

inline constexpr const char* burring_module = KERF_BUILD_DIR "/lib/kerf/kerf_burring.so";

/// Euler's characteristic: 2 for a closed surface without a hole through it, 0 for one with one.
inline long euler_of(const bone::SurfaceMesh& mesh) {
    long edges = 0;
    bone::for_each_edge(bone::half_edges_of(mesh), [&](const bone::HalfEdge*, const bone::HalfEdge*) { ++edges; });
    return static_cast<long>(mesh.vertices.size()) - edges + static_cast<long>(mesh.triangles.size());
}

/// Opens the modules, and cuts.
class Displacing : public testing::Test {
protected:
    static void SetUpTestSuite() {
        std::string error;
        burring_ = bone::RemeshModule::open(burring_module, error);
        ASSERT_NE(burring_, nullptr) << error;
        cgal_ = bone::RemeshModule::open(KERF_BUILD_DIR "/lib/kerf/kerf_remesh_cgal.so", error);
        ASSERT_NE(cgal_, nullptr) << error;
    }
    static void TearDownTestSuite() {
        burring_.reset();
        cgal_.reset();
    }
    static bone::RemeshResult displace(const bone::RemeshRequest& request) {
        return bone::remesh_here(*burring_->find("displace"), request);
    }
    static bone::RemeshResult with_cgal(const char* strategy, const bone::RemeshRequest& request) {
        return bone::remesh_here(*cgal_->find(strategy), request);
    }
    /// Cuts by `displace` alone.
    static bone::LocalCutting cutting(const bone::TaggedMesh& mesh, const ToolSolid& tool, double tolerance = 20e-6) {
        return {mesh, {&tool}, tolerance, displace};
    }
    /// Cuts by `displace`, and by `local` what that declines.
    static bone::LocalCutting cutting_with_local(const bone::TaggedMesh& mesh, const ToolSolid& tool) {
        return {mesh, {&tool}, 20e-6, displace, [](const bone::RemeshRequest& request) {
                    return with_cgal("local", request);
                }};
    }
    /// What is wrong with the surface in the end; empty if nothing is.
    static std::string flaw_of(const bone::TaggedMesh& base, const bone::LocalCutting& cutting) {
        for (const auto& stale : cutting.stale()) return "stale: " + stale.why;
        bone::RemeshRequest request;
        request.base = base;
        return bone::flaw_of_result(request, cutting.surface().mesh());
    }
    /// What the strategy `exact` removes [m³].
    static double exactly_removed(const bone::TaggedMesh& base, const ToolSolid& tool,
                                  const std::vector<bone::CutStretch>& cuts) {
        bone::RemeshRequest request;
        request.base = base;
        request.solids = {&tool};
        request.cuts = cuts;
        request.tolerance = 1e-6;
        const bone::RemeshResult result = with_cgal("exact", request);
        EXPECT_EQ(result.status, KERF_OK) << result.message;
        return bone::signed_volume_of(base.mesh) - bone::signed_volume_of(result.mesh.mesh);
    }

    /// What the strategy `local` removes, with fine polygons for the burr [m³]: many cuts in less time.
    static double locally_removed(const bone::TaggedMesh& base, const ToolSolid& tool,
                                  const std::vector<bone::CutStretch>& cuts) {
        bone::LocalCutting cut(base, {&tool}, 1e-6,
                               [](const bone::RemeshRequest& request) { return with_cgal("local", request); });
        for (const bone::CutStretch& one : cuts) cut.cut(one);
        EXPECT_EQ(flaw_of(base, cut), "");
        return cut.removed();
    }

    static inline std::unique_ptr<bone::RemeshModule> burring_, cgal_;
};

}  // namespace kerf::test
