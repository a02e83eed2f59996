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
inline long euler_of(const SurfaceMesh& mesh) {
    long edges = 0;
    for_each_edge(half_edges_of(mesh), [&](const HalfEdge*, const HalfEdge*) { ++edges; });
    return static_cast<long>(mesh.vertices.size()) - edges + static_cast<long>(mesh.triangles.size());
}

/// Opens the modules, and cuts.
class Displacing : public testing::Test {
protected:
    static void SetUpTestSuite() {
        std::string error;
        burring_ = RemeshModule::open(burring_module, error);
        ASSERT_NE(burring_, nullptr) << error;
        cgal_ = RemeshModule::open(KERF_BUILD_DIR "/lib/kerf/kerf_remesh_cgal.so", error);
        ASSERT_NE(cgal_, nullptr) << error;
    }
    static void TearDownTestSuite() {
        burring_.reset();
        cgal_.reset();
    }
    static RemeshResult displace(const RemeshRequest& request) {
        return remesh_here(*burring_->find("displace"), request);
    }
    static RemeshResult with_cgal(const char* strategy, const RemeshRequest& request) {
        return remesh_here(*cgal_->find(strategy), request);
    }
    /// Cuts by `displace` alone.
    static LocalCutting cutting(const TaggedMesh& mesh, const ToolSolid& tool, double tolerance = 20e-6) {
        return {mesh, {&tool}, tolerance, displace};
    }
    /// Cuts by `displace`, and by `local` what that declines.
    static LocalCutting cutting_with_local(const TaggedMesh& mesh, const ToolSolid& tool) {
        return {
            mesh, {&tool}, 20e-6, displace, [](const RemeshRequest& request) { return with_cgal("local", request); }};
    }
    /// What is wrong with the surface in the end; empty if nothing is.
    static std::string flaw_of(const TaggedMesh& base, const LocalCutting& cutting) {
        for (const auto& stale : cutting.stale()) return "stale: " + stale.why;
        RemeshRequest request;
        request.base = base;
        return flaw_of_result(request, cutting.surface().mesh());
    }
    /// What the strategy `exact` removes [m³].
    static double exactly_removed(const TaggedMesh& base, const ToolSolid& tool, const std::vector<CutStretch>& cuts) {
        RemeshRequest request;
        request.base = base;
        request.solids = {&tool};
        request.cuts = cuts;
        request.tolerance = 1e-6;
        const RemeshResult result = with_cgal("exact", request);
        EXPECT_EQ(result.status, KERF_OK) << result.message;
        return signed_volume_of(base.mesh) - signed_volume_of(result.mesh.mesh);
    }

    /// What the strategy `local` removes, with fine polygons for the burr [m³]: many cuts in less time.
    static double locally_removed(const TaggedMesh& base, const ToolSolid& tool, const std::vector<CutStretch>& cuts) {
        LocalCutting cut(base, {&tool}, 1e-6, [](const RemeshRequest& request) { return with_cgal("local", request); });
        for (const CutStretch& one : cuts) cut.cut(one);
        EXPECT_EQ(flaw_of(base, cut), "");
        return cut.removed();
    }

    static inline std::unique_ptr<RemeshModule> burring_, cgal_;
};

}  // namespace kerf::test
