// SPDX-License-Identifier: Apache-2.0
// Requests that no host sends, each wrong in one way: a status and a reason, no crash.
#include <cmath>
#include <functional>
#include <limits>

#include "tests/bone/surface/shapes.h"
#include "tests/plugins/burring/displace/displacing.h"

namespace kerf {
namespace {

using namespace literals;
using chart::ball_burr, chart::burr_at;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

struct Animal {
    const char* name;
    std::function<void(bone::RemeshRequest&)> spoil;
    kerf_status status;
    const char* why;
};

const ToolSolid& empty_tool() {
    static const ToolSolid none;
    return none;
}
const ToolSolid& needle() {
    static const ToolSolid thin({{0.0, 0.0}, {-1.0_mm, 0.0}});
    return thin;
}

std::vector<Animal> animals() {
    return {
        {"no faces", [](bone::RemeshRequest& r) { r.base = {}; }, KERF_REMESH_REFUSED, "the mesh has no faces"},
        {"a vertex that is no number", [](bone::RemeshRequest& r) { r.base.mesh.vertices[3].y = nan_value; },
         KERF_REMESH_REFUSED, "a vertex of the mesh is no number"},
        {"an infinite vertex", [](bone::RemeshRequest& r) { r.base.mesh.vertices[3].y = HUGE_VAL; },
         KERF_REMESH_REFUSED, "a vertex of the mesh is no number"},
        {"a face beyond the vertices", [](bone::RemeshRequest& r) { r.base.mesh.triangles[5][1] = 1'000'000; },
         KERF_REMESH_REFUSED, "face 5 has a vertex that does not exist"},
        {"a face with a vertex twice",
         [](bone::RemeshRequest& r) { r.base.mesh.triangles[5][1] = r.base.mesh.triangles[5][0]; }, KERF_REMESH_REFUSED,
         "face 5 has a vertex twice"},
        {"an edge of three faces",
         [](bone::RemeshRequest& r) {
             const bone::Triangle t = r.base.mesh.triangles.front();
             r.base.mesh.triangles.push_back({t[0], t[1], 100});
             r.base.tags.push_back(KERF_FACE_SURFACE);
         },
         KERF_REMESH_REFUSED, "the mesh is not 2-manifold"},
        {"a face the wrong way round",
         [](bone::RemeshRequest& r) { std::swap(r.base.mesh.triangles[5][1], r.base.mesh.triangles[5][2]); },
         KERF_REMESH_REFUSED, "the mesh is not 2-manifold"},
        {"a tolerance of 0", [](bone::RemeshRequest& r) { r.tolerance = 0.0; }, KERF_REMESH_REFUSED,
         "the tolerance is no length"},
        {"a tolerance that is no number", [](bone::RemeshRequest& r) { r.tolerance = nan_value; }, KERF_REMESH_REFUSED,
         "the tolerance is no length"},
        {"a tool that does not exist", [](bone::RemeshRequest& r) { r.cuts.front().solid = 7; }, KERF_REMESH_REFUSED,
         "a cut has a tool that does not exist"},
        {"a pose that is no number", [](bone::RemeshRequest& r) { r.cuts.front().to.position.x = nan_value; },
         KERF_REMESH_DECLINED, "a pose of the tool is no number"},
        {"an empty tool", [](bone::RemeshRequest& r) { r.solids = {&empty_tool()}; }, KERF_REMESH_DECLINED,
         "the tool has no outline"},
        {"a tool without volume", [](bone::RemeshRequest& r) { r.solids = {&needle()}; }, KERF_REMESH_DECLINED,
         "the tool has no volume"},
        {"inside out", [](bone::RemeshRequest& r) { r.base.mesh = test::turned(r.base.mesh); }, KERF_REMESH_DECLINED,
         "inside the swept burr the surface does not look at its axis everywhere: another wall is in the way"},
        {"a burr that swallows the bone",
         [](bone::RemeshRequest& r) {
             static const ToolSolid huge = ball_burr(20.0_mm);
             r.solids = {&huge};
             r.cuts.front() = {burr_at({0, 0, -26.0_mm}), burr_at({0, 0, -26.0_mm}), 0};
         },
         KERF_REMESH_DECLINED,
         "inside the swept burr the surface does not look at its axis everywhere: another wall is in the way"},
        {"no cut", [](bone::RemeshRequest& r) { r.cuts.clear(); }, KERF_REMESH_UNCHANGED, ""},
        {"in the air",
         [](bone::RemeshRequest& r) {
             r.cuts.front() = {burr_at({0, 0, 9.0_mm}), burr_at({0, 0, 9.0_mm}), 0};
         },
         KERF_REMESH_UNCHANGED, ""},
        {"far away",
         [](bone::RemeshRequest& r) {
             r.cuts.front() = {burr_at({1e6, 0, 0}), burr_at({1e6, 0, 0}), 0};
         },
         KERF_REMESH_UNCHANGED, ""},
    };
}

using BadRequests = test::Displacing;

TEST_F(BadRequests, GetAStatusAndAReason) {
    const ToolSolid burr = ball_burr(2.0_mm);
    for (const Animal& animal : animals()) {
        bone::RemeshRequest request;
        request.base = bone::tagged(test::sphere(6.0_mm, 4));
        request.solids = {&burr};
        request.cuts = {{burr_at({0, 0, 5.0_mm}), burr_at({0.5_mm, 0, 5.0_mm}), 0}};
        request.tolerance = 20e-6;
        ASSERT_EQ(displace(request).status, KERF_OK) << "without the flaw it is cut";
        animal.spoil(request);
        const bone::RemeshResult result = displace(request);
        EXPECT_EQ(result.status, animal.status) << animal.name;
        EXPECT_EQ(result.message, animal.why) << animal.name;
    }
}

}  // namespace
}  // namespace kerf
