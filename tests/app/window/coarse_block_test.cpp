// SPDX-License-Identifier: Apache-2.0
// Blocks of a surface with fewer triangles: the surface stays closed.
#include "app/window/coarse_block.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/field/grid/level_set.h"
#include "run/view/surface_view.h"

namespace kerf::window {
namespace {

constexpr double radius = 12e-3, spacing = 0.5e-3;

/// Returns the viewed surface of a ball off all planes of the grid.
run::ViewedBodySurface ball() {
    const Vec3 centre{0.13e-3, -0.21e-3, 0.07e-3};
    const Grid grid = Grid::covering({-14e-3, -14e-3, -14e-3}, {14e-3, 14e-3, 14e-3}, spacing);
    Body body;
    body.id = "ball";
    body.surface = LevelSet::build(grid, [&](Vec3 p) { return length(p - centre) - radius; });
    body.materials.push_back({.id = "cortical", .density = 1850.0, .border = {}});
    PresentBone bone(body, 1);
    run::SurfaceView view;
    return view.update(bone, {true})->bodies.front();
}

std::vector<Block> blocks_of(const run::ViewedBodySurface& surface) {
    std::vector<Block> blocks;
    for (int k = 0; k < surface.bricks[2]; k += Block::edge)
        for (int j = 0; j < surface.bricks[1]; j += Block::edge)
            for (int i = 0; i < surface.bricks[0]; i += Block::edge) blocks.push_back({{i, j, k}});
    return blocks;
}

using Point = std::array<float, 3>;

/// Triangles by the positions of their corners.
struct Whole {
    std::vector<std::array<Point, 3>> triangles;

    void add(const BlockMesh& mesh) {
        for (const auto& t : mesh.triangles) {
            std::array<Point, 3> corners{};
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t i = 0; i < 3; ++i) corners[c][i] = mesh.vertices[t[c]].position[i];
            triangles.push_back(corners);
        }
    }
    /// Number of edges along which triangles do not run equally often in both directions: 0 for a closed surface.
    [[nodiscard]] std::size_t gaps() const {
        std::map<std::pair<Point, Point>, int> count;
        for (const auto& t : triangles)
            for (std::size_t c = 0; c < 3; ++c) {
                const Point &a = t[c], &b = t[(c + 1) % 3];
                if (a < b)
                    ++count[{a, b}];
                else if (b < a)
                    --count[{b, a}];
            }
        std::size_t open = 0;
        for (const auto& [edge, balance] : count) open += balance != 0 ? 1 : 0;
        return open;
    }
    [[nodiscard]] double volume() const {
        double sixfold = 0.0;
        for (const auto& [a, b, c] : triangles) {
            const auto vec = [](const Point& p) { return Vec3{p[0], p[1], p[2]}; };
            sixfold += dot(vec(a), cross(vec(b), vec(c)));
        }
        return sixfold / 6.0;
    }
};

Whole whole_with(const run::ViewedBodySurface& surface, const auto& lattice_of) {
    Whole whole;
    std::size_t number = 0;
    for (const Block& block : blocks_of(surface)) whole.add(block_mesh(surface, block, lattice_of(number++)));
    return whole;
}

constexpr double exact_volume = 4.0 / 3.0 * 3.14159265358979 * radius * radius * radius;

TEST(CoarseBlock, KeepsAllTrianglesWithoutALattice) {
    const auto surface = ball();
    const Whole fine = whole_with(surface, [](std::size_t) { return 1; });
    std::size_t triangles = 0;
    for (std::size_t b = 0; b < surface.patches.capacity(); ++b)
        if (surface.patches[b] != nullptr) triangles += surface.patches[b]->triangles.size();
    EXPECT_EQ(fine.triangles.size(), triangles);
    EXPECT_EQ(fine.gaps(), 0u);
    EXPECT_NEAR(fine.volume(), exact_volume, 3e-3 * exact_volume);
}

TEST(CoarseBlock, LeavesLessThanHalfAndNoGap) {
    const auto surface = ball();
    const Whole fine = whole_with(surface, [](std::size_t) { return 1; });
    for (const int lattice : {2, 3, 4}) {
        const Whole coarse = whole_with(surface, [&](std::size_t) { return lattice; });
        EXPECT_EQ(coarse.gaps(), 0u) << lattice;
        EXPECT_LT(coarse.triangles.size(), fine.triangles.size() / 2) << lattice;
        // A chord across a cell's diagonal lies this far inside the ball.
        const double chord = std::sqrt(2.0) * lattice * spacing, sagitta = chord * chord / (8.0 * radius);
        EXPECT_NEAR(coarse.volume(), exact_volume, 3.0 * sagitta / radius * exact_volume) << lattice;
    }
}

TEST(CoarseBlock, FitsBlocksOfOtherLattices) {
    const auto surface = ball();
    const Whole mixed = whole_with(surface, [](std::size_t block) { return 1 + static_cast<int>(block % 4); });
    EXPECT_EQ(mixed.gaps(), 0u);
    EXPECT_NEAR(mixed.volume(), exact_volume, 1e-2 * exact_volume);
}

TEST(CoarseBlock, HasUnitNormals) {
    const auto surface = ball();
    for (const Block& block : blocks_of(surface))
        for (const run::ViewedVertex& v : block_mesh(surface, block, 3).vertices)
            EXPECT_NEAR(std::hypot(v.normal[0], v.normal[1], v.normal[2]), 127.0, 2.0);
}

}  // namespace
}  // namespace kerf::window
