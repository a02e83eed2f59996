// SPDX-License-Identifier: Apache-2.0
// What the host finds of a strategy that leaves bone, takes too much or moves the mesh.
#include "bone/remesh/removal.h"

#include <gtest/gtest.h>

#include "kerf/units.hpp"
#include "tests/bone/surface/shapes.h"

namespace kerf::bone {
namespace {

using namespace literals;

/// A cube of 20 mm about the origin, and a blade of 2 mm that goes 5 mm deep into its top, through its whole width.
struct SawnCube {
    ToolSolid blade = ToolSolid::prism({{0.0, 30.0_mm}, {-40.0_mm, 30.0_mm}}, 2.0_mm);
    RemeshRequest request;

    SawnCube() {
        request.base = tagged(test::cube(20.0_mm));
        const Quat down{0.0, 1.0, 0.0, 0.0};
        request.solids = {&blade};
        request.cuts = {{{{0, 0, 11.0_mm}, down}, {{0, 0, 5.0_mm}, down}, 0}};
        request.tolerance = 20e-6;
    }
    [[nodiscard]] double allowed() const { return allowed_for(request, 0.0); }
    /// The cube with a slot from −half to half of its width, down to `bottom`.
    [[nodiscard]] TaggedMesh with_slot(double half, double bottom) const {
        constexpr double edge = 10.0_mm;
        TaggedMesh mesh;
        const auto prism = [&](std::initializer_list<std::array<double, 2>> section) {  // (y, z), along x
            const std::vector<std::array<double, 2>> s(section);
            const auto first = static_cast<std::uint32_t>(mesh.mesh.vertices.size()),
                       n = static_cast<std::uint32_t>(s.size());
            for (const double x : {-edge, edge})
                for (const auto& [y, z] : s) mesh.mesh.vertices.push_back({x, y, z});
            for (std::uint32_t i = 0; i < n; ++i) {
                const std::uint32_t j = (i + 1) % n;
                mesh.mesh.triangles.push_back({first + i, first + n + j, first + j});
                mesh.mesh.triangles.push_back({first + i, first + n + i, first + n + j});
            }
        };
        prism({{-edge, -edge},
               {edge, -edge},
               {edge, edge},
               {half, edge},
               {half, bottom},
               {-half, bottom},
               {-half, edge},
               {-edge, edge}});
        mesh.tags.assign(mesh.mesh.triangles.size(), KERF_FACE_WALL);
        return mesh;  // without its two ends, which no law here needs
    }
};

TEST(Removal, TakesWhatTheBladeLeaves) {
    const SawnCube cube;
    EXPECT_EQ(flaw_of_removal(cube.request, cube.with_slot(1.0_mm, 5.0_mm), 1.0), "") << "with any tolerance";
    EXPECT_EQ(flaw_of_removal(cube.request, cube.with_slot(1.0_mm, 5.0_mm), cube.allowed()).find("bone is left"),
              std::string::npos);
}

TEST(Removal, FindsBoneInThePathOfTheBlade) {
    const SawnCube cube;
    EXPECT_EQ(
        flaw_of_removal(cube.request, cube.with_slot(1.0_mm, 5.2_mm), cube.allowed()).find("bone is left in the path"),
        0u);
    EXPECT_EQ(
        flaw_of_removal(cube.request, cube.with_slot(0.8_mm, 5.0_mm), cube.allowed()).find("bone is left in the path"),
        0u);
    EXPECT_EQ(flaw_of_removal(cube.request, cube.request.base, cube.allowed()).find("bone is left in the path"), 0u);
}

TEST(Removal, FindsANewFaceBesideThePath) {
    const SawnCube cube;
    EXPECT_EQ(
        flaw_of_removal(cube.request, cube.with_slot(1.0_mm, 4.8_mm), cube.allowed()).find("a new face lies neither"),
        0u);
    EXPECT_EQ(
        flaw_of_removal(cube.request, cube.with_slot(1.2_mm, 5.0_mm), cube.allowed()).find("a new face lies neither"),
        0u);
}

TEST(Removal, FindsBoneThatIsGoneBesideThePath) {
    const SawnCube cube;
    EXPECT_EQ(flaw_of_removal(cube.request, {}, cube.allowed()).find("bone is missing that the tool did not sweep"),
              0u);
}

TEST(Removal, DoesNotBelieveUnchanged) {
    SawnCube cube;
    EXPECT_NE(flaw_of_unchanged(cube.request, cube.allowed()), "");
    cube.request.cuts[0].from.position.z = cube.request.cuts[0].to.position.z = 11.0_mm;  // in air
    EXPECT_EQ(flaw_of_unchanged(cube.request, cube.allowed()), "");
}

TEST(Removal, AllowsWhatAStrategyStates) {
    const SawnCube cube;
    EXPECT_NEAR(allowed_for(cube.request, 0.0), 62e-6, 1e-12);
    EXPECT_NEAR(allowed_for(cube.request, 0.1e-3), 142e-6, 1e-12);
}

}  // namespace
}  // namespace kerf::bone
