// SPDX-License-Identifier: Apache-2.0
#include "documents/solid_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include "documents/solids.h"

namespace kerf::documents {
namespace {

/// Returns the volume within a mesh; positive if its triangles face outwards.
double volume_of(const Mesh& mesh) {
    double volume = 0.0;
    for (const auto& [a, b, c] : mesh.triangles)
        volume += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c])) / 6.0;
    return volume;
}

/// Returns the number of edges without a neighbour. Vertices at one point count as one, to a nanometre.
std::size_t open_edges(const Mesh& mesh) {
    using Key = std::tuple<long, long, long>;
    const auto key = [&](std::uint32_t vertex) {
        const Vec3 p = mesh.vertices[vertex];
        return Key{std::lround(p.x * 1e9), std::lround(p.y * 1e9), std::lround(p.z * 1e9)};
    };
    std::map<std::pair<Key, Key>, int> balance;
    for (const auto& triangle : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const Key from = key(triangle[i]), to = key(triangle[(i + 1) % 3]);
            from < to ? ++balance[{from, to}] : --balance[{to, from}];
        }
    std::size_t open = 0;
    for (const auto& [edge, count] : balance) open += count != 0 ? 1 : 0;
    return open;
}

struct Case {
    const char* name;
    Solid solid;
    double volume;  ///< [mm³]
};

class SolidMesh : public testing::TestWithParam<Case> {};

TEST_P(SolidMesh, IsClosedAndHasItsVolume) {
    const Mesh mesh = mesh_of({GetParam().solid});
    EXPECT_EQ(open_edges(mesh), 0u);
    // A prism of 32 sides has 0.6 % less area than its circle, a sphere of 32 by 16 parts 1.6 % less volume.
    EXPECT_NEAR(volume_of(mesh) * 1e9, GetParam().volume, 0.02 * GetParam().volume);
}

TEST_P(SolidMesh, HasItsVerticesOnTheSurfaceAndNormalsOutwards) {
    const Solid& solid = GetParam().solid;
    const Mesh mesh = mesh_of({solid});
    ASSERT_EQ(mesh.normals.size(), mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        EXPECT_NEAR(distance_to(solid, mesh.vertices[i]), 0.0, 1e-9) << i;
        EXPECT_GT(distance_to(solid, mesh.vertices[i] + 1e-4 * mesh.normals[i]), 5e-5) << i;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Of, SolidMesh,
    testing::Values(Case{"box", BoxSolid{{1e-3, 2e-3, 3e-3}, {4e-3, 5e-3, 6e-3}}, 120.0},
                    Case{"tube", TubeSolid{{1e-3, 0, 0}, {1e-3, 6e-3, 8e-3}, 2e-3}, 40.0 * 3.14159265},
                    Case{"upright", TubeSolid{{0, 0, 9e-3}, {0, 0, -1e-3}, 2e-3}, 40.0 * 3.14159265},
                    Case{"elliptic", EllipticTubeSolid{{0, 0, 0}, {10e-3, 0, 0}, 8e-3, 4e-3, {0, 0, 1}},
                         80.0 * 3.14159265},
                    Case{"sphere", SphereSolid{{-2e-3, 1e-3, 0}, 3e-3}, 36.0 * 3.14159265}),
    [](const auto& one) { return one.param.name; });

TEST(SolidMeshes, AreListedInOrder) {
    const SphereSolid sphere{{0, 0, 0}, 1e-3};
    const BoxSolid box{{5e-3, 0, 0}, {1e-3, 1e-3, 1e-3}};
    EXPECT_EQ(mesh_of({sphere, box}).triangles.size(),
              mesh_of({sphere}).triangles.size() + mesh_of({box}).triangles.size());
    EXPECT_TRUE(mesh_of({}).triangles.empty());
}

}  // namespace
}  // namespace kerf::documents
