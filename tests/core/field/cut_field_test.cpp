// SPDX-License-Identifier: Apache-2.0
#include "core/field/cut_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/field/bone_surface.h"
#include "core/field/removed_volume.h"
#include "tests/support/block.h"

namespace kerf {
namespace {

using namespace literals;

constexpr double half_angle = 59.0_deg;

CutRecord stretch(const Pose& from, const Pose& to) {
    CutRecord record;
    record.from = from;
    record.to = to;
    return record;
}

double removed_by(const Body& body, const RevolutionSolid& tool, const Pose& from, const Pose& to) {
    CutField cut(body, 256);
    cut.stamp(stretch(from, to), tool);
    RemovedVolume volume(body);
    volume.update(cut);
    return volume.total();
}

// C.1, blind hole: V = πR²(h − ⅔ R cot p)
TEST(CutField, ABlindHoleTakesItsExactVolume) {
    const double r = 1.6_mm, depth = 5.0_mm;
    const double exact = pi * r * r * (depth - 2.0 / 3.0 * r / std::tan(half_angle));
    for (const double h : {0.1_mm, 0.2_mm}) {
        const Body body = test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, h, {0.3, 0.7, 0.11});
        const RevolutionSolid tool = test::drill_outline(r, half_angle, 20.0_mm);
        const double removed = removed_by(body, tool, test::pointing({0, 0, 1.0_mm}, {0, 0, -1}),
                                          test::pointing({0, 0, -depth}, {0, 0, -1}));
        EXPECT_NEAR(removed / exact, 1.0, 0.005) << "spacing " << h;
    }
}

// C.1, through hole tilted γ: V = πR² t / cos γ
TEST(CutField, ATiltedThroughHoleTakesItsExactVolume) {
    const double r = 2.7_mm, thickness = 6.0_mm, tilt = 30.0_deg;
    const Body body = test::block({-12.0_mm, -8.0_mm, -thickness}, {12.0_mm, 8.0_mm, 0}, 0.2_mm, {0.2, 0.6, 0.4});
    const RevolutionSolid tool = test::drill_outline(r, half_angle, 40.0_mm);
    const Vec3 along{std::sin(tilt), 0, -std::cos(tilt)};
    const Vec3 centre{0, 0, -0.5 * thickness};
    const double removed = removed_by(body, tool, test::pointing(centre - 15.0_mm * along, along),
                                      test::pointing(centre + 12.0_mm * along, along));
    EXPECT_NEAR(removed / (pi * r * r * thickness / std::cos(tilt)), 1.0, 0.002);
}

TEST(CutField, AFastSweepMissesNoVoxelAndTakesNoneBeside) {
    // 1 m/s for 12 ticks, at a spacing of 0.5 mm: two voxels a tick
    const double h = 0.5_mm, r = 2.7_mm;
    const Body body = test::block({-8.0_mm, -8.0_mm, -16.0_mm}, {8.0_mm, 8.0_mm, 0}, h, {0.13, 0.71, 0.37});
    const RevolutionSolid tool = test::drill_outline(r, half_angle, 30.0_mm);
    const Vec3 along = normalized(Vec3{0.2, 0.1, -1.0});
    CutField cut(body, 256);
    for (int tick = 0; tick < 12; ++tick)
        cut.stamp(stretch(test::pointing(tick * 1.0_mm * along, along), test::pointing((tick + 1) * 1.0_mm * along, along)), tool);

    // The union of the swept tool is the tool at its end, as it only went forward.
    const Pose tool_from_body = inverse(test::pointing(12.0_mm * along, along));
    const Grid& g = body.grid();
    int missed = 0, extra = 0, inside = 0;
    for (int k = 0; k < g.samples(2); ++k)
        for (int j = 0; j < g.samples(1); ++j)
            for (int i = 0; i < g.samples(0); ++i) {
                if (body.surface.sample(i, j, k) >= 0) continue;
                const double d = tool.distance(tool_from_body * g.sample_position(i, j, k));
                inside += d < 0.0;
                missed += d < -0.01 * h && cut.sample(i, j, k) <= 0;
                extra += d > 0.01 * h && cut.sample(i, j, k) > 0;
            }
    EXPECT_GT(inside, 1500);
    EXPECT_EQ(missed, 0);
    EXPECT_EQ(extra, 0);
}

TEST(CutField, StampingAgainOrInAnotherOrderChangesNothing) {
    const Body body = test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.25_mm);
    const RevolutionSolid tool = test::drill_outline(1.6_mm, half_angle, 3.0_mm);
    std::vector<CutRecord> records;
    for (int i = 0; i < 20; ++i)
        records.push_back(stretch(test::pointing({0, 0, -0.2_mm * i}, {0, 0, -1}),
                                  test::pointing({0.02_mm * i, 0, -0.2_mm * (i + 1)}, {0.01 * i, 0, -1})));

    CutField forward(body, 256), shuffled(body, 1);
    for (const auto& record : records) forward.stamp(record, tool);
    std::shuffle(records.begin(), records.end(), std::mt19937(3));
    for (const auto& record : records) shuffled.stamp(record, tool);
    for (const auto& record : records) shuffled.stamp(record, tool);

    EXPECT_TRUE(forward.same_bits(shuffled));
    EXPECT_FALSE(forward.same_bits(CutField(body, 1)));
}

TEST(CutField, NeighbouringBricksAgreeOnTheSamplesTheyShare) {
    const Body body = test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.25_mm);
    const RevolutionSolid tool = test::drill_outline(1.6_mm, half_angle, 20.0_mm);
    CutField cut(body, 256);
    cut.stamp(stretch(test::pointing({0, 0, 0}, {0.1, 0.2, -1}), test::pointing({0.3_mm, 0, -5.0_mm}, {0.1, 0.2, -1})), tool);
    const Grid& g = body.grid();
    int compared = 0;
    for (int k = 0; k < g.bricks[2]; ++k)
        for (int j = 0; j < g.bricks[1]; ++j)
            for (int i = 0; i + 1 < g.bricks[0]; ++i) {
                const auto *a = cut.stored(g.brick_index(i, j, k)), *b = cut.stored(g.brick_index(i + 1, j, k));
                if (a == nullptr || b == nullptr) continue;
                for (int row = 0; row < stored_edge * stored_edge; ++row) {
                    EXPECT_EQ(a[row * stored_edge + brick_edge], b[row * stored_edge]);
                    ++compared;
                }
            }
    EXPECT_GT(compared, 1000);
}

TEST(BoneSurface, IsClosedAndEnclosesWhatIsLeft) {
    // A through hole of 3.2 mm in a 10 × 10 × 4 mm slab
    const Body body = test::block({-5.0_mm, -5.0_mm, -4.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.25_mm);
    const RevolutionSolid tool = test::drill_outline(1.6_mm, half_angle, 20.0_mm);
    CutField cut(body, 256);
    cut.stamp(stretch(test::pointing({0, 0, 1.0_mm}, {0, 0, -1}), test::pointing({0, 0, -8.0_mm}, {0, 0, -1})), tool);

    const Mesh mesh = bone_surface(body, cut);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    double volume = 0.0;
    for (const auto& t : mesh.triangles) {
        for (std::size_t c = 0; c < 3; ++c) edges.emplace_back(t[c], t[(c + 1) % 3]);
        volume += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]])) / 6.0;
    }

    std::sort(edges.begin(), edges.end());
    for (const auto& [a, b] : edges) {
        const auto opposite = std::equal_range(edges.begin(), edges.end(), std::pair{b, a});
        ASSERT_EQ(opposite.second - opposite.first, 1);
    }
    const double exact = 400.0 - pi * 1.6 * 1.6 * 4.0;  // [mm³]
    EXPECT_NEAR(volume * 1e9 / exact, 1.0, 0.01);
}

}  // namespace
}  // namespace kerf
