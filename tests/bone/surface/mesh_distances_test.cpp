// SPDX-License-Identifier: Apache-2.0
// The tree that measures one point at a time is the oracle: every stored sample must be the same.
#include "bone/surface/mesh_distances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "bone/import/bone_distances.h"
#include "core/field/grid/level_set.h"
#include "documents/solids.h"
#include "kerf/units.hpp"
#include "tests/bone/surface/shapes.h"

namespace kerf::bone {
namespace {

using namespace literals;
using test::cube, test::sphere, test::together, test::turned;

Grid grid_around(const SurfaceMesh& mesh, double spacing) {
    const Box box = bounds_of(mesh);
    const Vec3 margin = 6.0 * spacing * Vec3{1, 1, 1};
    return Grid::covering(box.low - margin, box.high + margin, spacing);
}

/// How many samples differ, and whether the same bricks are stored.
void expect_same(const LevelSet& fast, const LevelSet& slow) {
    const Grid& grid = slow.grid();
    std::size_t stored = 0, different = 0;
    for (std::size_t b = 0; b < grid.brick_count(); ++b) {
        ASSERT_EQ(fast.has_border(b), slow.has_border(b)) << "brick " << b;
        ASSERT_EQ(fast.has_inside(b), slow.has_inside(b)) << "brick " << b;
        ASSERT_EQ(fast.has_outside(b), slow.has_outside(b)) << "brick " << b;
        if (!slow.has_border(b)) continue;
        ++stored;
        for (int n = 0; n < stored_samples; ++n) different += fast.stored(b)[n] != slow.stored(b)[n];
    }
    EXPECT_GT(stored, 0U);
    EXPECT_EQ(different, 0U);
}

void expect_that_of_the_tree(const SurfaceMesh& mesh, double spacing) {
    const TriangleTree tree(mesh);
    MeshDistances fast(tree);
    SignedDistance slow(tree);
    const Grid grid = grid_around(mesh, spacing);
    expect_same(LevelSet::build(grid, fast), LevelSet::build(grid, [&](Vec3 p) { return slow(p); }));
}

/// A box; its faces look outwards.
SurfaceMesh box(Vec3 extent, Vec3 centre = {}) {
    SurfaceMesh mesh = cube(1.0);
    for (Vec3& v : mesh.vertices) v = centre + Vec3{v.x * extent.x, v.y * extent.y, v.z * extent.z};
    return mesh;
}

TEST(MeshDistances, EqualsTheTreeOnShells) {
    expect_that_of_the_tree(together(sphere(8.0_mm, 4), turned(sphere(5.0_mm, 3))), 0.5_mm);
}
TEST(MeshDistances, EqualsTheTreeOnASheetThinnerThanAVoxel) {
    expect_that_of_the_tree(box({12.0_mm, 9.0_mm, 0.35_mm}, {0.1_mm, 0.2_mm, 0.03_mm}), 0.5_mm);
}
TEST(MeshDistances, EqualsTheTreeOnOverlappingShells) {
    expect_that_of_the_tree(together(sphere(6.0_mm, 3), sphere(6.0_mm, 3, {5.0_mm, 1.0_mm, 0})), 0.5_mm);
}
TEST(MeshDistances, EqualsTheTreeWhereFacesLieOnSamples) {
    // Edges of 8 mm about the middle of a voxel: the grid's samples lie on all six faces
    expect_that_of_the_tree(cube(8.0_mm), 0.5_mm);
    expect_that_of_the_tree(cube(8.0_mm, {0.25_mm, 0.25_mm, 0.25_mm}), 0.5_mm);
}
TEST(MeshDistances, EqualsTheTreeOnFacesWithoutArea) {
    SurfaceMesh mesh = cube(7.0_mm, {0.13_mm, 0.2_mm, 0.31_mm});
    mesh.vertices.push_back(0.5 * (mesh.vertices[0] + mesh.vertices[1]));
    mesh.triangles.insert(mesh.triangles.end(), {Triangle{0, 1, 8}, {8, 1, 0}, {8, 8, 8}, {0, 0, 1}});
    expect_that_of_the_tree(mesh, 0.5_mm);
}
TEST(MeshDistances, EqualsTheTreeOnNeedles) {
    // Fans of triangles 20 mm long and 0.02 mm wide on the ends of a prism of many sides
    SurfaceMesh mesh;
    constexpr std::uint32_t sides = 3000;
    mesh.vertices = {{0, 0, -3.0_mm}, {0, 0, 3.0_mm}};
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double angle = 2.0 * 3.14159265358979 * i / sides;
        for (const double z : {-3.0_mm, 3.0_mm})
            mesh.vertices.push_back({9.0_mm * std::cos(angle), 9.0_mm * std::sin(angle), z});
    }
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t a = 2 + 2 * i, b = a + 1, c = 2 + 2 * ((i + 1) % sides), d = c + 1;
        mesh.triangles.insert(mesh.triangles.end(), {Triangle{a, c, b}, {c, d, b}, {0, c, a}, {1, b, d}});
    }
    expect_that_of_the_tree(mesh, 0.5_mm);
}

TEST(MeshDistances, DoesNotDependOnTheOrderOfTriangles) {
    const SurfaceMesh mesh = together(sphere(7.0_mm, 3), cube(4.0_mm, {9.0_mm, 0, 0}));
    SurfaceMesh shuffled = mesh;
    std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), std::mt19937(3));
    const TriangleTree tree(mesh), other_tree(shuffled);
    MeshDistances one(tree), other(other_tree);
    const Grid grid = grid_around(mesh, 0.4_mm);
    expect_same(LevelSet::build(grid, one), LevelSet::build(grid, other));
}

TEST(MeshDistances, HasTheSignsOfTheExactWindingNumber) {
    const SurfaceMesh mesh = together(sphere(8.0_mm, 3), turned(sphere(5.0_mm, 2)));
    const TriangleTree tree(mesh);
    MeshDistances fast(tree);
    const Grid grid = grid_around(mesh, 0.6_mm);
    const LevelSet field = LevelSet::build(grid, fast);
    std::size_t wrong = 0;
    for (int k = 0; k < grid.samples(2); ++k)
        for (int j = 0; j < grid.samples(1); ++j)
            for (int i = 0; i < grid.samples(0); ++i) {
                const std::int16_t sample = field.sample(i, j, k);
                if (sample == 0) continue;
                wrong += (sample < 0) != (tree.exact_winding(grid.sample_position(i, j, k)) > 0.5);
            }
    EXPECT_EQ(wrong, 0U);
}

// ---- put together out of others

/// A bone with a room, seen in a part of it, with a shell: as import makes one.
struct Parts {
    SurfaceMesh outside = sphere(9.0_mm, 4), inside = sphere(4.0_mm, 3, {2.0_mm, 0, 0});
    TriangleTree tree{outside}, room_tree{inside};
    Region region{{-6.0_mm, -20.0_mm, -5.0_mm}, {20.0_mm, 4.0_mm, 20.0_mm}};
    Grid grid = grid_around(outside, 0.5_mm);
};

TEST(BoneDistances, AreThoseOfEachPoint) {
    Parts parts;
    documents::Tissue cortical;
    cortical.thickness = 3.0_mm;
    cortical.solids = {documents::SphereSolid{{-3.0_mm, 0, 0}, 7.0_mm}};
    MeshDistances fast(parts.tree);
    NearestSurface fast_room({MeshDistances(parts.room_tree)});
    InRegion outer(fast, parts.region), room(fast_room, parts.region);
    WithoutCavities bone(outer, room);
    TissueBorder border(outer, cortical);

    SignedDistance slow(parts.tree), slow_room(parts.room_tree);
    const auto outer_at = [&](Vec3 p) { return slow(parts.region.nearest(p)); };
    const auto bone_at = [&](Vec3 p) { return std::max(outer_at(p), -slow_room(parts.region.nearest(p))); };
    const auto border_at = [&](Vec3 p) { return distance_to(cortical, -outer_at(p), p); };
    expect_same(LevelSet::build(parts.grid, bone), LevelSet::build(parts.grid, bone_at));
    expect_same(LevelSet::build(parts.grid, border), LevelSet::build(parts.grid, border_at));
}

/// Counts how often a brick is sampled.
class CountedDistance final : public DistanceSource {
public:
    explicit CountedDistance(DistanceSource& distance) : distance_(&distance) {}
    [[nodiscard]] double at(Vec3 p, DistanceRange needed) override { return distance_->at(p, needed); }
    void fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) override {
        ++bricks;
        distance_->fill(lattice, needed, distances);
    }
    int bricks = 0;

private:
    DistanceSource* distance_;
};

TEST(BoneDistances, AreSampledOnceABrickForAllFields) {
    Parts parts;
    documents::Tissue cortical;
    cortical.thickness = 1.0_mm;
    const double clamp = parts.grid.clamp();
    MeshDistances fast(parts.tree);
    CountedDistance counted(fast);
    RememberedBrick bone(counted, {-(cortical.thickness + clamp), clamp});
    TissueBorder border(bone, cortical);

    // Built together, a brick with both borders is sampled once
    const std::array<DistanceSource*, 2> sources{&bone, &border};
    const std::vector<LevelSet> together = LevelSet::build(parts.grid, sources);
    const int bricks_together = std::exchange(counted.bricks, 0);
    expect_same(together[0], LevelSet::build(parts.grid, fast));
    expect_same(together[1], LevelSet::build(parts.grid, border));
    int stored = 0;
    for (std::size_t b = 0; b < parts.grid.brick_count(); ++b)
        stored += together[0].has_border(b) || together[1].has_border(b);
    EXPECT_EQ(bricks_together, stored);

    // Beyond the range that is always sampled, nothing is remembered
    const BrickLattice lattice = BrickLattice::of(parts.grid, 1, 1, 1);
    std::array<double, stored_samples> distances{};
    counted.bricks = 0;
    for (int times = 0; times < 2; ++times) bone.fill(lattice, {-clamp, 2.0 * clamp}, distances);
    EXPECT_EQ(counted.bricks, 2);
}

TEST(BoneDistances, AreExactWithinTheRangeAndBeyondItOutsideIt) {
    Parts parts;
    MeshDistances fast(parts.tree);
    SignedDistance slow(parts.tree);
    const DistanceRange range{-1.0_mm, 2.5_mm};
    std::vector<double> distances(stored_samples);
    std::size_t exact = 0, beyond = 0;
    for (int j = 0; j < parts.grid.bricks[1]; ++j)
        for (int i = 0; i < parts.grid.bricks[0]; ++i) {
            const int k = parts.grid.bricks[2] / 2;
            fast.fill(BrickLattice::of(parts.grid, i, j, k), range, BrickDistances(distances));
            for (int n = 0; n < stored_samples; ++n) {
                const int x = n % stored_edge, y = n / stored_edge % stored_edge, z = n / (stored_edge * stored_edge);
                const double d = slow(parts.grid.sample_position(8 * i + x, 8 * j + y, 8 * k + z));
                const double found = distances[static_cast<std::size_t>(n)];
                if (d >= range.low && d <= range.high) {
                    ASSERT_EQ(found, d);
                    ++exact;
                } else {
                    ASSERT_TRUE(d < range.low ? found < range.low : found > range.high) << d << " as " << found;
                    ++beyond;
                }
            }
        }
    EXPECT_GT(exact, 100U);
    EXPECT_GT(beyond, 100U);
}

}  // namespace
}  // namespace kerf::bone
