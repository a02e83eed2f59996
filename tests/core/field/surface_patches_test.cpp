// SPDX-License-Identifier: Apache-2.0
// The surface brick by brick: the same as cell by cell, closed, and kept up to date.
#include "core/field/surface/surface_patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "core/field/surface/bone_surface.h"
#include "core/field/surface/isosurface.h"
#include "core/field/surface/patch_table.h"
#include "tests/support/drilled_block.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/with_kernel.h"

namespace kerf {
namespace {

using namespace literals;
using test::Random;

// ---- given -------------------------------------------------------------------------------------------------------

/// Bone in a grid whose samples are decided one by one, `voxels` each, up to the grid's border.
template <class Voxels>
Body decided_by(const Voxels& voxels, std::array<int, 3> bricks) {
    const Grid grid{.bricks = bricks, .spacing = 0.5_mm, .origin = {0.1, -0.2, 0.05}};
    std::map<std::tuple<long, long, long>, double> values;
    Body body;
    body.id = "noise";
    body.surface = LevelSet::build(grid, [&](Vec3 p) {
        const Vec3 at = (p - grid.origin) / grid.spacing;
        const auto [known, is_new] = values.try_emplace({std::lround(at.x), std::lround(at.y), std::lround(at.z)}, 0.0);
        if (is_new) known->second = voxels() * grid.spacing;
        return known->second;
    });
    body.materials.push_back({"cortical", 1850.0, {}});
    return body;
}

/// All a quarter of a voxel or more from zero: every case of a cell, and every vertex on an edge that can be told.
Body noise(std::uint64_t seed, double share_inside, std::array<int, 3> bricks = {2, 3, 2}) {
    Random random(seed);
    return decided_by([&] { return (random.next() < share_inside ? -1.0 : 1.0) * (0.25 + 3.5 * random.next()); },
                      bricks);
}

CutRecord stroke(Vec3 from, Vec3 to, Vec3 along) {
    CutRecord record;
    record.from = test::pointing(from, along);
    record.to = test::pointing(to, along);
    return record;
}
const ToolSolid& drill() {
    static const ToolSolid solid = test::drill_outline(1.6_mm, 59.0_deg, 20.0_mm);
    return solid;
}

Body block_with_room() {
    Body body = test::shelled_block({-6.0_mm, -6.0_mm, -12.0_mm}, {6.0_mm, 6.0_mm, 0}, 1.0_mm, 0.4_mm);
    body.hollow = LevelSet::build(body.grid(), [](Vec3 p) { return length(p - Vec3{1.0_mm, 0, -6.0_mm}) - 3.1_mm; });
    return body;
}
/// Its faces lie on samples, or the share `off` of a voxel beside them.
Body block_in_region(double off = 0.0) {
    Body body = test::shelled_block({-6.0_mm, -6.0_mm, -12.0_mm}, {6.0_mm, 6.0_mm, 0}, 1.0_mm, 0.4_mm);
    const Grid& g = body.grid();
    const Vec3 beside = off * g.spacing * Vec3{1, 1, 1};
    body.region = {g.sample_position(12, 13, 9) + beside, g.sample_position(33, 30, 37) + beside};
    return body;
}
/// Bone in all of a grid that is one brick high.
Body full_grid() {
    const Grid grid{.bricks = {3, 2, 1}, .spacing = 0.4_mm, .origin = {}};
    Body body;
    body.surface = LevelSet::build(grid, [](Vec3) { return -1.0; });
    body.materials.push_back({"cortical", 1850.0, {}});
    return body;
}
CutField drilled(const Body& body) {
    CutField cut(body, 64);
    cut.stamp(stroke({0, 0, 1.0_mm}, {0.7_mm, 0.3_mm, -8.0_mm}, {0.1, 0.05, -1}), drill());
    return cut;
}

/// What the surface is of, sample by sample [quanta].
int bone_at(const Body& body, const CutField& cut, int i, int j, int k) {
    const Grid& g = body.grid();
    const int bone = std::max(body.surface.sample(i, j, k), cut.sample(i, j, k));
    if (!body.region.is_bounded()) return bone;
    const Vec3 p = g.sample_position(i, j, k), low = body.region.low - p, high = p - body.region.high;
    return std::max<int>(bone, quantised(std::max({low.x, low.y, low.z, high.x, high.y, high.z}), g.quantum()));
}

/// The same surface cell by cell, every cell looked at, in double precision.
Mesh slowly(const Body& body, const CutField& cut) {
    const Grid& g = body.grid();
    return isosurface(
        {.size = {g.samples(0), g.samples(1), g.samples(2)},
         .spacing = g.spacing,
         .origin = g.origin,
         .value = [&](int i, int j, int k) { return static_cast<float>(bone_at(body, cut, i, j, k)) / 8192.0F; }});
}

/// By the edges of the grid that its vertices stand on.
struct ByEdges {
    using Edge = std::array<int, 4>;                 ///< lower sample, axis
    std::map<Edge, std::pair<Vec3, Vec3>> vertices;  ///< [voxels], normal
    std::vector<std::array<Edge, 3>> triangles;

    ByEdges(const Mesh& mesh, const Grid& grid) {
        std::vector<Edge> edges;
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
            const Vec3 at = (mesh.vertices[v] - grid.origin) / grid.spacing;
            const std::array<double, 3> along{at.x, at.y, at.z};
            Edge edge{};
            double most = -1.0;
            for (std::size_t n = 0; n < 3; ++n) {
                edge[n] = static_cast<int>(std::lround(along[n]));
                const double off = std::abs(along[n] - edge[n]);
                if (off > most) {
                    most = off;
                    edge[3] = static_cast<int>(n);
                }
            }
            const auto axis = static_cast<std::size_t>(edge[3]);
            edge[axis] = static_cast<int>(std::floor(along[axis]));
            edges.push_back(edge);
            EXPECT_TRUE(vertices.emplace(edge, std::pair{at, mesh.normals[v]}).second) << "two vertices on one edge";
        }
        for (const auto& t : mesh.triangles) {
            std::array<Edge, 3> triangle{edges[t[0]], edges[t[1]], edges[t[2]]};
            std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
            triangles.push_back(triangle);
        }
        std::sort(triangles.begin(), triangles.end());
    }
};

void expect_same_surface(const Body& body, const CutField& cut) {
    const Mesh fast_mesh = bone_surface(body, cut), slow_mesh = slowly(body, cut);
    ASSERT_FALSE(slow_mesh.triangles.empty());
    EXPECT_EQ(test::open_edges(fast_mesh), 0);
    const ByEdges fast(fast_mesh, body.grid()), slow(slow_mesh, body.grid());
    EXPECT_EQ(fast.triangles, slow.triangles);
    ASSERT_EQ(fast.vertices.size(), slow.vertices.size());
    for (const auto& [edge, vertex] : slow.vertices) {
        ASSERT_TRUE(fast.vertices.contains(edge));
        const auto& [at, normal] = fast.vertices.at(edge);
        EXPECT_LT(length(at - vertex.first), 1e-4 /* voxels: two roundings to single precision, at 0.2 m */);
        EXPECT_LT(length(normal - vertex.second), 1e-4 /* where the slopes at both ends all but cancel */);
    }
}

bool are_same_bits(const Mesh& a, const Mesh& b) {
    const auto same = [](const std::vector<Vec3>& p, const std::vector<Vec3>& q) {
        return std::equal(p.begin(), p.end(), q.begin(), q.end(), [](Vec3 v, Vec3 w) { return v == w; });
    };
    return same(a.vertices, b.vertices) && same(a.normals, b.normals) && a.tissue == b.tissue &&
           a.triangles == b.triangles;
}

// ---- the same surface as cell by cell
// ----------------------------------------------------------------------------------

TEST(BrickSurface, OfNoiseIsThatOfTheSlowWayTriangleByTriangle) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const Body body = noise(seed, 0.1 + 0.8 * double(seed % 7) / 6.0);
        SCOPED_TRACE(seed);
        expect_same_surface(body, CutField(body, 16));
    }
}
TEST(BrickSurface, OfNoiseInOneBrickTooWhoseSidesAreAllTheGrids) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const Body body = noise(seed, 0.5, {1, 1, 1});
        expect_same_surface(body, CutField(body, 16));
    }
}
TEST(BrickSurface, OfADrilledBlockARoomARegionAndAFullGridToo) {
    for (const Body& body : {test::shelled_block({-6.0_mm, -6.0_mm, -12.0_mm}, {6.0_mm, 6.0_mm, 0}, 1.0_mm, 0.4_mm),
                             block_with_room(), block_in_region(0.37)})
        expect_same_surface(body, drilled(body));
    const Body full = full_grid();
    expect_same_surface(full, CutField(full, 16));
}

TEST(BrickSurface, SamplesOfZeroLeaveNoHole) {
    Random random(7);
    const double quantum = clamp_voxels / 32767.0;
    const Body body = decided_by([&] { return (std::floor(3.0 * random.next()) - 1.0) * quantum; }, {2, 2, 2});
    const Mesh mesh = bone_surface(body, CutField(body, 1));
    EXPECT_GT(mesh.triangles.size(), 1000U);
    EXPECT_EQ(test::open_edges(mesh), 0);
    for (const Vec3 n : mesh.normals) ASSERT_NEAR(length(n), 1.0, 1e-6);
}

TEST(BrickSurface, AFaceThatClosesTheGridLooksStraightOut) {
    const Body body = full_grid();
    const Mesh mesh = bone_surface(body, CutField(body, 1));
    EXPECT_EQ(test::pieces(mesh), 1);
    const Vec3 middle = 0.5 * 0.4_mm * Vec3{23, 15, 7};
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Vec3 n = mesh.normals[v];
        ASSERT_EQ(std::abs(n.x) + std::abs(n.y) + std::abs(n.z), 1.0);
        ASSERT_GT(dot(n, mesh.vertices[v] - middle), 0.0);
    }
}

TEST(BrickSurface, NormalsOfABallLookAwayFromItsMiddle) {
    Body body = test::block({-6.0_mm, -6.0_mm, -6.0_mm}, {6.0_mm, 6.0_mm, 6.0_mm}, 0.3_mm, {0.31, 0.17, 0.73});
    body.surface = LevelSet::build(body.grid(), [](Vec3 p) { return length(p) - 5.0_mm; });
    const Mesh mesh = bone_surface(body, CutField(body, 1));
    const double exact = 4.0 / 3.0 * pi * 125.0e-9;
    EXPECT_NEAR(test::volume(mesh), exact, 0.005 * exact);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        ASSERT_GT(dot(mesh.normals[v], normalized(mesh.vertices[v])), std::cos(0.2_deg));
        ASSERT_NEAR(length(mesh.vertices[v]), 5.0_mm, 0.01 * 0.3_mm);
    }
}

TEST(BrickSurface, TissueIsWhatLiesAStepInwards) {
    const Body body = block_with_room();
    const Mesh mesh = bone_surface(body, drilled(body));
    std::array<int, 2> count{};
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        double weight[KERF_MAX_TISSUES];
        material_weights(body, locate(body.grid(), mesh.vertices[v] - 0.5 * body.grid().spacing * mesh.normals[v]),
                         weight);
        if (std::abs(weight[0] - weight[1]) < 1e-3) continue;  // rounding may decide
        ASSERT_EQ(mesh.tissue[v], weight[0] > weight[1] ? 0 : 1);
        ++count[mesh.tissue[v]];
    }
    EXPECT_GT(count[0], 100);
    EXPECT_GT(count[1], 100);
}

TEST(BrickSurface, IsTheSameBitByBitWithAnyKernel) {
    if (avx2_kernel() == nullptr) GTEST_SKIP() << "one kernel only";
    for (const Body& body : {noise(3, 0.5), noise(4, 0.2), block_with_room(), block_in_region()}) {
        const CutField cut = drilled(body);
        SurfacePatches fast(body), portable(body);
        {
            const test::WithKernel with(*avx2_kernel());
            fast.update_all(cut);
        }
        {
            const test::WithKernel with(portable_kernel());
            portable.update_all(cut);
        }
        for (std::size_t b = 0; b < body.grid().brick_count(); ++b) {
            ASSERT_EQ(fast.patch(b) == nullptr, portable.patch(b) == nullptr);
            if (fast.patch(b) == nullptr) continue;
            ASSERT_TRUE(fast.patch(b)->is_same_as(portable.patch(b)->view())) << b;
        }
    }
}

// ---- patches and their seams
// -------------------------------------------------------------------------------------------

/// The vertices on one side of a patch, by the place of their edge in that side.
std::map<std::array<int, 4>, SurfaceVertex> on_side(const BrickPatch& patch, int axis, int at) {
    std::map<std::array<int, 4>, SurfaceVertex> found;
    const PatchView view = patch.view();
    for (std::size_t v = 0; v < view.vertices.size(); ++v) {
        const int edge = view.edges[v];
        std::array<int, 4> key{edge & 15, edge >> 4 & 15, edge >> 8 & 15, edge >> 12};
        if (key[3] == axis || key[static_cast<std::size_t>(axis)] != at + 1) continue;
        key[static_cast<std::size_t>(axis)] = 0;
        found.emplace(key, view.vertices[v]);
    }
    return found;
}

TEST(SurfacePatches, NeighboursHaveTheSameVerticesOnTheirSeamBitByBit) {
    for (const Body& body : {noise(5, 0.5, {3, 3, 3}), block_with_room(), block_in_region()}) {
        SurfacePatches patches(body);
        patches.update_all(drilled(body));
        const Grid& g = body.grid();
        int compared = 0;
        for (int k = 0; k < g.bricks[2]; ++k)
            for (int j = 0; j < g.bricks[1]; ++j)
                for (int i = 0; i < g.bricks[0]; ++i)
                    for (int axis = 0; axis < 3; ++axis) {
                        std::array<int, 3> next{i, j, k};
                        if (++next[static_cast<std::size_t>(axis)] == g.bricks[static_cast<std::size_t>(axis)])
                            continue;
                        const auto &a = patches.patch(g.brick_index(i, j, k)),
                                   &b = patches.patch(g.brick_index(next[0], next[1], next[2]));
                        const auto low =
                            a == nullptr ? on_side(BrickPatch(PatchView{}), axis, 8) : on_side(*a, axis, 8);
                        const auto high =
                            b == nullptr ? on_side(BrickPatch(PatchView{}), axis, 0) : on_side(*b, axis, 0);
                        ASSERT_EQ(low.size(), high.size());
                        for (auto p = low.begin(), q = high.begin(); p != low.end(); ++p, ++q) {
                            ASSERT_EQ(p->first, q->first);
                            ASSERT_EQ(std::memcmp(&p->second, &q->second, sizeof p->second), 0);
                            ++compared;
                        }
                    }
        EXPECT_GT(compared, 500);
    }
}

TEST(SurfacePatches, WeldToTheMeshThatIsMadeAtOnce) {
    for (const Body& body : {noise(6, 0.4), block_with_room(), block_in_region()}) {
        const CutField cut = drilled(body);
        SurfacePatches patches(body);
        patches.update_all(cut);
        EXPECT_TRUE(are_same_bits(patches.welded(), bone_surface(body, cut)));
    }
}

// ---- kept up to date
// -----------------------------------------------------------------------------------------------------

TEST(SurfacePatches, AfterAnyCutsAreThoseOfAFreshSurface) {
    for (const Body& body : {block_with_room(), block_in_region(),
                             test::block({-6.0_mm, -6.0_mm, -12.0_mm}, {6.0_mm, 6.0_mm, 0}, 0.35_mm)}) {
        // Given a surface from before any cut
        CutField cut(body, 64);
        SurfacePatches patches(body);
        patches.update_all(cut);
        cut.take_changed();
        Random random(11);
        const auto between = [&](double low, double high) { return low + (high - low) * random.next(); };

        for (int round = 0; round < 25; ++round) {
            // When a drill cuts somewhere, a little or a lot
            const Vec3 from{between(-7.0_mm, 7.0_mm), between(-7.0_mm, 7.0_mm), between(-8.0_mm, 1.0_mm)};
            const double reach = round % 3 == 0 ? 3.0_mm : 0.1_mm;
            const Vec3 by{between(-reach, reach), between(-reach, reach), between(-reach, 0.0)};
            cut.stamp(stroke(from, from + by, {between(-1, 1), between(-1, 1), -1.0}), drill());
            std::vector<std::shared_ptr<const BrickPatch>> before;
            for (std::size_t b = 0; b < body.grid().brick_count(); ++b) before.push_back(patches.patch(b));
            const std::vector<std::size_t> changed = cut.take_changed();
            const auto published = patches.update(cut, changed);

            // Then every patch is what it would be if made now, and what is published is what has changed
            SurfacePatches fresh(body);
            fresh.update_all(cut);
            std::vector<std::size_t> differing, named;
            for (std::size_t b = 0; b < body.grid().brick_count(); ++b) {
                const PatchView now = fresh.patch(b) == nullptr ? PatchView{} : fresh.patch(b)->view();
                ASSERT_EQ(patches.patch(b) == nullptr, fresh.patch(b) == nullptr)
                    << "brick " << b << " round " << round;
                const auto is_as_now = [&](const auto& patch) {
                    return patch == nullptr ? now.vertices.empty() : patch->is_same_as(now);
                };
                ASSERT_TRUE(is_as_now(patches.patch(b))) << "brick " << b << " round " << round;
                if (!is_as_now(before[b])) differing.push_back(b);
            }
            for (const auto& p : published) {
                named.push_back(p.brick);
                ASSERT_EQ(p.patch, patches.patch(p.brick));
            }
            ASSERT_EQ(named, differing);
        }
        EXPECT_EQ(test::open_edges(patches.welded()), 0);
    }
}

TEST(SurfacePatches, AHeldPatchStaysAsItWas) {
    // Given a reader who holds the patches around a place
    const Body body = block_with_room();
    CutField cut(body, 64);
    SurfacePatches patches(body);
    const auto held = patches.update_all(cut);
    const Mesh before = patches.welded();

    // When that place is cut
    cut.stamp(stroke({0, 0, 1.0_mm}, {0, 0, -8.0_mm}, {0, 0, -1}), drill());
    ASSERT_FALSE(patches.update(cut, cut.take_changed()).empty());

    // Then what the reader holds is the surface of before
    ASSERT_FALSE(are_same_bits(patches.welded(), before));
    std::size_t triangles = 0;
    for (const auto& p : held) triangles += p.patch->triangles().size();
    EXPECT_EQ(triangles, before.triangles.size());
}

TEST(PatchTable, AHeldOneStaysAsItWasAndTheNextIsTheSurfaceOfNow) {
    // Given a reader who holds the table of a surface
    const Body body = block_with_room();
    const std::size_t bricks = body.grid().brick_count();
    CutField cut(body, 64);
    SurfacePatches patches(body);
    const PatchTable held = PatchTable(bricks).with(patches.update_all(cut));
    std::vector<std::shared_ptr<const BrickPatch>> before;
    for (std::size_t b = 0; b < bricks; ++b) before.push_back(patches.patch(b));
    cut.take_changed();

    // When a hole is drilled through, which makes patches where there were none, changes some and takes others away
    PatchTable table = held;
    for (double depth = 0.0; depth < 12.0_mm; depth += 1.0_mm) {
        cut.stamp(stroke({0, 0, -depth}, {0, 0, -depth - 1.0_mm}, {0, 0, -1}), drill());
        table = table.with(patches.update(cut, cut.take_changed()));
        for (std::size_t b = 0; b < bricks; ++b)
            ASSERT_EQ(table[b], patches.patch(b)) << "brick " << b << " at " << depth;
    }

    // Then what the reader holds has not changed
    std::size_t different = 0;
    for (std::size_t b = 0; b < bricks; ++b) {
        ASSERT_EQ(held[b], before[b]);
        different += table[b] != before[b];
    }
    EXPECT_GT(different, 20u);
}

TEST(SurfacePatches, NothingChangedPublishesNothing) {
    const Body body = block_with_room();
    const CutField cut = drilled(body);
    SurfacePatches patches(body);
    patches.update_all(cut);
    EXPECT_TRUE(patches.update(cut, {}).empty());
    EXPECT_TRUE(patches.update_all(cut).empty());
}

TEST(LevelSet, KnowsOfEachBrickWhichSignsItHas) {
    const Body body = block_with_room();
    const Grid& g = body.grid();
    std::array<int, 3> count{};
    for (std::size_t b = 0; b < g.brick_count(); ++b) {
        const std::int16_t uniform = body.surface.uniform_value(b), *stored = body.surface.stored(b);
        const std::int16_t *first = stored != nullptr ? stored : &uniform,
                           *last = stored != nullptr ? stored + stored_samples : &uniform + 1;
        const bool has_inside = std::any_of(first, last, [](std::int16_t s) { return s < 0; });
        const bool has_outside = std::any_of(first, last, [](std::int16_t s) { return s >= 0; });
        ASSERT_EQ(body.surface.has_inside(b), has_inside);
        ASSERT_EQ(body.surface.has_outside(b), has_outside);
        ++count[static_cast<std::size_t>(has_inside + 2 * has_outside - 1)];
    }
    for (const int c : count) EXPECT_GT(c, 0);
}

}  // namespace
}  // namespace kerf
