// SPDX-License-Identifier: Apache-2.0
#include "core/field/surface/isosurface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "kerf/units.hpp"
#include "tests/support/mesh_checks.h"

namespace kerf {
namespace {

using namespace literals;
using test::open_edges;
using test::pieces;
using test::Random;
using test::volume;

// ---- given -------------------------------------------------------------------------------------------------------

/// A field stored sample by sample, at a spacing of 1 m so that metres are voxels.
struct StoredField {
    std::array<int, 3> size{};
    std::vector<float> values;

    static StoredField filled(std::array<int, 3> size, float value) {
        return {size, std::vector<float>(static_cast<std::size_t>(size[0] * size[1] * size[2]), value)};
    }
    float& at(int i, int j, int k) { return values[static_cast<std::size_t>((k * size[1] + j) * size[0] + i)]; }
    SampleGrid grid() {
        return {
            .size = size, .spacing = 1.0, .origin = {}, .value = [this](int i, int j, int k) { return at(i, j, k); }};
    }
};

/// Noise with as many ambiguous faces as can be: `share_inside` of the samples negative, each alone decided.
StoredField noise(std::uint64_t seed, std::array<int, 3> size, double share_inside) {
    Random random(seed);
    StoredField field = StoredField::filled(size, 0.0F);
    for (float& value : field.values) value = static_cast<float>(random.next() - share_inside);
    return field;
}

/// A ball of 20 voxels about a centre off the grid: the triangles cut its volume short by about 0.6 (spacing /
/// radius)².
struct Ball {
    double spacing = 0.25_mm;
    double radius = 5_mm;
    Vec3 centre{7.11_mm, 7.23_mm, 7.31_mm};
    Vec3 origin{0.2_mm, -0.1_mm, 0.05_mm};

    SampleGrid grid() const {
        return {.size = {60, 60, 60}, .spacing = spacing, .origin = origin, .value = [*this](int i, int j, int k) {
                    const Vec3 at = origin + spacing * Vec3{double(i), double(j), double(k)};
                    return static_cast<float>(length(at - centre) - radius);
                }};
    }
};

// ---- what is asked of a mesh -------------------------------------------------------------------------------------

bool is_sound(const Mesh& mesh) {
    return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](Vec3 v) { return is_finite(v); }) &&
           std::all_of(mesh.normals.begin(), mesh.normals.end(),
                       [](Vec3 n) { return std::abs(length(n) - 1.0) < 1e-9; }) &&
           mesh.normals.size() == mesh.vertices.size();
}

void expect_same(const Mesh& a, const Mesh& b) {
    EXPECT_EQ(a.triangles, b.triangles);
    ASSERT_EQ(a.vertices.size(), b.vertices.size());
    for (std::size_t v = 0; v < a.vertices.size(); ++v) {
        EXPECT_TRUE(a.vertices[v] == b.vertices[v]) << "vertex " << v;
        EXPECT_TRUE(a.normals[v] == b.normals[v]) << "normal " << v;
    }
}

// ---- closed, whatever the field ------------------------------------------------------------------------------------

TEST(Isosurface, EveryEdgeIsUsedTwiceInOppositeDirectionsOnRandomFields) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const double share_inside = 0.1 + 0.8 * double(seed % 9) / 8.0;
        StoredField field = noise(seed, {11, 9, 13}, share_inside);
        const Mesh mesh = isosurface(field.grid());
        ASSERT_FALSE(mesh.triangles.empty());
        EXPECT_EQ(open_edges(mesh), 0) << "seed " << seed;
        EXPECT_TRUE(is_sound(mesh)) << "seed " << seed;
        EXPECT_GT(volume(mesh), 0.0) << "seed " << seed;
    }
}

TEST(Isosurface, EveryCaseOfOneCellIsClosed) {
    for (unsigned inside = 1; inside < 256; ++inside) {
        StoredField field = StoredField::filled({2, 2, 2}, 1.0F);
        for (int c = 0; c < 8; ++c)
            if ((inside >> c & 1U) != 0) field.at(c & 1, c >> 1 & 1, c >> 2 & 1) = -1.0F;
        const Mesh mesh = isosurface(field.grid());
        EXPECT_EQ(open_edges(mesh), 0) << "case " << inside;
        EXPECT_GT(volume(mesh), 0.0) << "case " << inside;
    }
}

TEST(Isosurface, EveryPairOfNeighbouringCellsIsClosed) {
    for (unsigned inside = 0; inside < 4096; ++inside) {
        StoredField field = StoredField::filled({3, 2, 2}, 1.0F);
        for (unsigned n = 0; n < 12; ++n)
            if ((inside >> n & 1U) != 0) field.values[n] = -1.0F;
        EXPECT_EQ(open_edges(isosurface(field.grid())), 0) << "case " << inside;
    }
}

TEST(Isosurface, SamplesOfExactlyZeroAreOutsideAndLeaveNoHole) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        Random random(seed);
        StoredField field = StoredField::filled({8, 8, 8}, 0.0F);
        for (float& value : field.values) value = static_cast<float>(std::floor(3.0 * random.next()) - 1.0);
        const Mesh mesh = isosurface(field.grid());
        EXPECT_EQ(open_edges(mesh), 0) << "seed " << seed;
        EXPECT_TRUE(is_sound(mesh)) << "seed " << seed;
    }
    StoredField zero = StoredField::filled({4, 4, 4}, 0.0F);
    EXPECT_TRUE(isosurface(zero.grid()).triangles.empty());
    StoredField minus_zero = StoredField::filled({4, 4, 4}, -0.0F);
    EXPECT_TRUE(isosurface(minus_zero.grid()).triangles.empty());
}

TEST(Isosurface, NotANumberAndInfinityLeaveNoHole) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    StoredField field = noise(5, {8, 8, 8}, 0.5);
    for (std::size_t n = 0; n < field.values.size(); n += 7) field.values[n] = std::nanf("");
    for (std::size_t n = 3; n < field.values.size(); n += 11) field.values[n] = -infinity;
    for (std::size_t n = 5; n < field.values.size(); n += 13) field.values[n] = infinity;
    const Mesh mesh = isosurface(field.grid());
    EXPECT_EQ(open_edges(mesh), 0);
    EXPECT_TRUE(is_sound(mesh));
}

TEST(Isosurface, ASolidThatReachesTheBorderIsClosedThere) {
    StoredField solid = StoredField::filled({5, 4, 3}, -1.0F);
    const Mesh mesh = isosurface(solid.grid());
    EXPECT_EQ(open_edges(mesh), 0);
    EXPECT_EQ(pieces(mesh), 1);
    // Half a voxel beyond the outermost samples: 5 × 4 × 3, less the edges and corners cut off half a voxel deep.
    EXPECT_LT(volume(mesh), 60.0);
    EXPECT_GT(volume(mesh), 50.0);
}

TEST(Isosurface, AFaceThatClosesTheBorderLooksStraightOut) {
    StoredField solid = StoredField::filled({6, 6, 6}, -1e-3F);  // as thin a field as a voxel is small
    const Mesh mesh = isosurface(solid.grid());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Vec3 n = mesh.normals[v], from_centre = mesh.vertices[v] - Vec3{2.5, 2.5, 2.5};
        EXPECT_EQ(std::abs(n.x) + std::abs(n.y) + std::abs(n.z), 1.0);
        EXPECT_GT(dot(n, from_centre), 2.4);
    }
}

TEST(Isosurface, AnEmptyGridHasNoSurface) {
    EXPECT_TRUE(
        isosurface({.size = {0, 4, 4}, .spacing = 1.0, .origin = {}, .value = [](int, int, int) { return -1.0F; }})
            .vertices.empty());
}

// ---- pieces ------------------------------------------------------------------------------------------------------

TEST(Isosurface, TwoCornersThatTouchAcrossAFaceStaySeparate) {
    StoredField field = StoredField::filled({4, 4, 4}, 1.0F);
    field.at(1, 1, 1) = field.at(2, 2, 1) = -1.0F;
    const Mesh mesh = isosurface(field.grid());
    EXPECT_EQ(pieces(mesh), 2);
    EXPECT_EQ(open_edges(mesh), 0);
}

TEST(Isosurface, TwoCornersThatTouchAcrossACellStaySeparate) {
    StoredField field = StoredField::filled({4, 4, 4}, 1.0F);
    field.at(1, 1, 1) = field.at(2, 2, 2) = -1.0F;
    EXPECT_EQ(pieces(isosurface(field.grid())), 2);
}

TEST(Isosurface, TwoNeighbouringSamplesAreOnePiece) {
    StoredField field = StoredField::filled({4, 4, 4}, 1.0F);
    field.at(1, 1, 1) = field.at(2, 1, 1) = -1.0F;
    EXPECT_EQ(pieces(isosurface(field.grid())), 1);
}

// ---- where the surface is ------------------------------------------------------------------------------------------

TEST(Isosurface, ABallHasItsVolumeAndItsRoundness) {
    const Ball ball;
    const Mesh mesh = isosurface(ball.grid());
    const double exact = 4.0 / 3.0 * pi * ball.radius * ball.radius * ball.radius;
    EXPECT_EQ(open_edges(mesh), 0);
    EXPECT_EQ(pieces(mesh), 1);
    EXPECT_NEAR(volume(mesh), exact, 0.005 * exact);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Vec3 outwards = normalized(mesh.vertices[v] - ball.centre);
        EXPECT_GT(dot(mesh.normals[v], outwards), std::cos(2.0_deg));
    }
}

TEST(Isosurface, TrianglesOfABallRunAnticlockwiseSeenFromOutside) {
    const Ball ball;
    const Mesh mesh = isosurface(ball.grid());
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 at = mesh.vertices[a];
        const Vec3 area = cross(mesh.vertices[b] - at, mesh.vertices[c] - at);
        if (length(area) < 1e-12) continue;  // no direction: thinner than 0.001 mm × 0.001 mm
        EXPECT_GT(dot(area, at - ball.centre), 0.0);
    }
}

TEST(Isosurface, ATiltedPlaneStandsWithinA256thOfAVoxel) {
    const Vec3 normal = normalized(Vec3{0.31, -0.52, 0.79});
    const double offset = 7.37;
    const Mesh mesh =
        isosurface({.size = {16, 16, 16}, .spacing = 1.0, .origin = {}, .value = [&](int i, int j, int k) {
                        return static_cast<float>(dot(normal, {double(i), double(j), double(k)}) - offset);
                    }});
    const auto is_on_border = [](double x) { return x < 0.0 || x > 15.0; };
    int counted = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Vec3 p = mesh.vertices[v];
        if (is_on_border(p.x) || is_on_border(p.y) || is_on_border(p.z)) continue;
        EXPECT_LE(std::abs(dot(normal, p) - offset), 1.0 / 256.0);
        EXPECT_GT(dot(normal, mesh.normals[v]), std::cos(0.01_deg)) << "a plane has one normal, up to the border";
        ++counted;
    }
    EXPECT_GT(counted, 200);
}

// ---- the same, always ----------------------------------------------------------------------------------------------

TEST(Isosurface, TheSameFieldGivesTheSameMesh) {
    StoredField field = noise(3, {20, 18, 22}, 0.4);
    expect_same(isosurface(field.grid()), isosurface(field.grid()));
}

TEST(Isosurface, EachSampleIsAskedForOnce) {
    SampleGrid grid = Ball{}.grid();
    grid.size = {61, 62, 63};
    int asked = 0;
    grid.value = [&asked, value = grid.value](int i, int j, int k) { return ++asked, value(i, j, k); };
    EXPECT_FALSE(isosurface(grid).triangles.empty());
    EXPECT_EQ(asked, 61 * 62 * 63);
}

}  // namespace
}  // namespace kerf
