// SPDX-License-Identifier: Apache-2.0
#include "core/field/cut/cut_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <vector>

#include "core/field/cut/cut_log.h"
#include "core/field/cut/removed_volume.h"
#include "core/field/surface/bone_surface.h"
#include "tests/support/block.h"
#include "tests/support/mesh_checks.h"

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

double removed_by(const Body& body, const ToolSolid& tool, const Pose& from, const Pose& to) {
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
        const ToolSolid tool = test::drill_outline(r, half_angle, 20.0_mm);
        const double removed = removed_by(body, tool, test::pointing({0, 0, 1.0_mm}, {0, 0, -1}),
                                          test::pointing({0, 0, -depth}, {0, 0, -1}));
        EXPECT_NEAR(removed / exact, 1.0, 0.005) << "spacing " << h;
    }
}

// C.1, through hole tilted γ: V = πR² t / cos γ
TEST(CutField, ATiltedThroughHoleTakesItsExactVolume) {
    const double r = 2.7_mm, thickness = 6.0_mm, tilt = 30.0_deg;
    const Body body = test::block({-12.0_mm, -8.0_mm, -thickness}, {12.0_mm, 8.0_mm, 0}, 0.2_mm, {0.2, 0.6, 0.4});
    const ToolSolid tool = test::drill_outline(r, half_angle, 40.0_mm);
    const Vec3 along{std::sin(tilt), 0, -std::cos(tilt)};
    const Vec3 centre{0, 0, -0.5 * thickness};
    const double removed = removed_by(body, tool, test::pointing(centre - 15.0_mm * along, along),
                                      test::pointing(centre + 12.0_mm * along, along));
    EXPECT_NEAR(removed / (pi * r * r * thickness / std::cos(tilt)), 1.0, 0.002);
}

/// 1 m/s at a spacing of 0.5 mm: two voxels a tick. The tool is buried in a block all the way.
struct FastSweep {
    static constexpr double h = 0.5_mm, r = 2.7_mm, back = 10.0_mm, way = 12.0_mm;
    static constexpr int ticks = 12;
    Vec3 axis, along;  // of the tool, and of its motion; unit
    Body body = test::block({-14.0_mm, -14.0_mm, -14.0_mm}, {14.0_mm, 14.0_mm, 14.0_mm}, h, {0.13, 0.71, 0.37});
    ToolSolid tool = test::drill_outline(r, half_angle, back);
    CutField cut{body, 256};

    FastSweep(Vec3 tool_axis, Vec3 motion) : axis(tool_axis), along(motion) {
        CutField committed(body, 256);
        CutTracker tracker(body, tool, committed);
        tracker.restart(at(0.0));
        cut.stamp(stretch(at(0.0), at(0.0)), tool);  // it has cut its way to where it starts
        for (int tick = 1; tick <= ticks; ++tick) {
            const Pose now = at(way * tick / ticks);
            for (int i = 0, closed = tracker.advance(now, static_cast<std::uint64_t>(tick)); i < closed; ++i) {
                EXPECT_TRUE(tracker.closed(i).removes) << tick;
                cut.stamp(tracker.closed(i), tool);
            }
            tracker.commit_passed(now, true);
        }
    }
    [[nodiscard]] Pose at(double travelled) const {
        return test::pointing((travelled - 0.5 * way) * along + 0.5 * back * axis, axis);
    }
    /// Exact signed distance to everything the tool was in. The tool is convex, so its distance along the way is too.
    [[nodiscard]] double swept_distance(Vec3 p) const {
        double low = 0.0, high = way;
        const auto d = [&](double travelled) { return tool.distance(inverse(at(travelled)) * p); };
        for (int i = 0; i < 40; ++i) {
            const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
            (d(a) < d(b) ? high : low) = d(a) < d(b) ? b : a;
        }
        return d(0.5 * (low + high));
    }
};

/// Some directions that no grid axis is parallel to.
std::vector<Vec3> tilted_axes() {
    return {normalized(Vec3{0.2, 0.1, -1.0}), normalized(Vec3{0.5, -0.4, -1.0}), normalized(Vec3{-0.3, 0.9, 0.5})};
}
Vec3 across(Vec3 axis, double angle) {
    const Vec3 u = normalized(cross(axis, Vec3{0.3, 0.5, 0.8})), v = cross(axis, u);
    return std::cos(angle) * u + std::sin(angle) * v;
}

TEST(CutField, AFastSweepMissesNoVoxelAndTakesNoneBeside) {
    for (const Vec3 axis : tilted_axes())
        for (const Vec3 along : {axis, across(axis, 0.4), normalized(axis + across(axis, 2.0))}) {
            const FastSweep sweep(axis, along);
            const Grid& g = sweep.body.grid();
            int missed = 0, extra = 0, inside = 0;
            for (int k = 0; k < g.samples(2); ++k)
                for (int j = 0; j < g.samples(1); ++j)
                    for (int i = 0; i < g.samples(0); ++i) {
                        if (sweep.body.surface.sample(i, j, k) >= 0) continue;
                        const bool is_removed = sweep.cut.sample(i, j, k) > 0;
                        const Vec3 p = g.sample_position(i, j, k);
                        if (!is_removed && length(p) > 0.7 * FastSweep::way + FastSweep::back)
                            continue;  // far from it all
                        const double d = sweep.swept_distance(p);
                        inside += d < 0.0;
                        missed += d < -g.quantum() && !is_removed;
                        extra += d > g.quantum() && is_removed;
                    }
            EXPECT_GT(inside, 2500);
            EXPECT_EQ(missed, 0) << "axis " << axis.x << " " << axis.y << " " << axis.z;
            EXPECT_EQ(extra, 0) << "axis " << axis.x << " " << axis.y << " " << axis.z;
        }
}

// A ridge is what lies between two sub-poses and in neither: most of them where a face draws back, as behind a short
// tool that advances askew, or before one that is withdrawn.
TEST(CutField, NoRidgeStaysWhereAToolGoesToAndFroAndTurns) {
    constexpr double h = 0.25_mm;
    const Body body = test::block({-5.0_mm, -5.0_mm, -5.0_mm}, {5.0_mm, 5.0_mm, 5.0_mm}, h);
    const Grid& g = body.grid();
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const ToolSolid disc({{0.0, 1.5_mm}, {-0.3_mm, 2.0_mm}, {-0.5_mm, 2.0_mm}}),
        drop({{0.0, 0.0}, {-1.0_mm, 1.5_mm}, {-2.5_mm, 0.5_mm}});
    const ToolSolid drill = test::drill_outline(1.0_mm, 45.0_deg, 1.4_mm),
                    blade = ToolSolid::prism({{0.0, 1.5_mm}, {-1.0_mm, 1.8_mm}}, 0.6_mm);
    for (const ToolSolid* solid : {&disc, &drop, &drill, &blade}) {
        int ridges = 0, missed = 0, of_to_alone = 0;
        for (int n = 0; n < 120; ++n) {
            CutRecord record;
            const Vec3 axis = normalized(Vec3{unit(random), unit(random), unit(random)});
            record.from = test::pointing({unit(random) * 1.0_mm, unit(random) * 1.0_mm, unit(random) * 1.0_mm}, axis);
            const double along = (n % 2 == 0 ? 1.0 : -1.0) * 0.05_mm * (1 + n % 7), turn = n % 3 == 0 ? 0.05 : 0.0;
            record.to = {record.from.position + along * axis +
                             0.05_mm * (n % 4) * Vec3{unit(random), unit(random), unit(random)},
                         normalized(quat_from_rotation_vector(turn * Vec3{unit(random), unit(random), unit(random)}) *
                                    record.from.rotation)};
            CutField cut(body, 256);
            CutRecord begun = record;
            begun.to = begun.from;
            cut.stamp(begun, *solid);
            cut.stamp(record, *solid);
            const Sweep sweep(*solid, record.from, record.to, 0.25 * h, PoseStamp::band(h));
            for (int k = 0; k < g.samples(2); ++k)
                for (int j = 0; j < g.samples(1); ++j)
                    for (int i = 0; i < g.samples(0); ++i) {
                        const Vec3 p = g.sample_position(i, j, k);
                        if (body.surface.sample(i, j, k) >= 0 || length(p - record.to.position) > 4.0_mm) continue;
                        const bool is_held = sweep.contains(p, g.quantum());
                        missed += is_held && cut.sample(i, j, k) <= 0;
                        ridges += is_held && cut.sample(i, j, k) == 1;
                        of_to_alone += is_held && solid->distance(inverse(record.to) * p) > g.quantum();
                    }
        }
        EXPECT_EQ(missed, 0);
        EXPECT_GT(of_to_alone, 100) << "what was left behind is looked at";
        EXPECT_GT(ridges, 10);
    }
}

// Every line along the motion meets a convex solid in one piece, which the motion lengthens by the way s. So
//
//     V = V₀ + s A,    V₀ = πR²(L − c) + πR²c/3,    c = R cot p
//
// with A the solid's shadow along the motion: the disc πR² along the axis, and across it the outline seen from the
// side, 2R(L − c) + Rc.
TEST(CutField, AFastSweepTakesItsExactVolume) {
    constexpr double r = FastSweep::r, s = FastSweep::way;
    const double cone = r / std::tan(half_angle), shaft = FastSweep::back - cone;
    const double still = pi * r * r * (shaft + cone / 3.0);
    for (const Vec3 axis : tilted_axes())
        for (const bool is_sideways : {false, true}) {
            FastSweep sweep(axis, is_sideways ? across(axis, 0.4) : axis);
            RemovedVolume volume(sweep.body);
            volume.update(sweep.cut);
            const double exact = still + s * (is_sideways ? 2.0 * r * shaft + r * cone : pi * r * r);
            EXPECT_NEAR(volume.total() / exact, 1.0, 0.005) << (is_sideways ? "sideways, " : "along, ") << axis.x;
        }
}

TEST(CutField, StampingAgainOrInAnotherOrderChangesNothing) {
    const Body body = test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.25_mm);
    const ToolSolid tool = test::drill_outline(1.6_mm, half_angle, 3.0_mm);
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
    const ToolSolid tool = test::drill_outline(1.6_mm, half_angle, 20.0_mm);
    CutField cut(body, 256);
    cut.stamp(stretch(test::pointing({0, 0, 0}, {0.1, 0.2, -1}), test::pointing({0.3_mm, 0, -5.0_mm}, {0.1, 0.2, -1})),
              tool);
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
    const ToolSolid tool = test::drill_outline(1.6_mm, half_angle, 20.0_mm);
    CutField cut(body, 256);
    cut.stamp(stretch(test::pointing({0, 0, 1.0_mm}, {0, 0, -1}), test::pointing({0, 0, -8.0_mm}, {0, 0, -1})), tool);

    const Mesh mesh = bone_surface(body, cut);
    EXPECT_EQ(test::open_edges(mesh), 0);
    const double exact = 400.0 - pi * 1.6 * 1.6 * 4.0;  // [mm³]
    EXPECT_NEAR(test::volume(mesh) * 1e9 / exact, 1.0, 0.01);
}

// ---- more than can be counted
// -----------------------------------------------------------------------------------------

TEST(Fields, MoreBricksThanCanBeCountedAreRefusedBeforeMemoryIsTaken) {
    const Grid grid{{150, 150, 150}, 1e-3, {}};  // 3.4 million bricks; their samples would take 5 GB
    EXPECT_THROW((void)LevelSet::build(grid, [](Vec3) { return 0.0; }), std::length_error);
    EXPECT_THROW((void)DensityField::build(
                     grid, [](std::size_t) { return true; }, [](Vec3) { return 1.0; }),
                 std::length_error);
    Body body;
    body.surface = LevelSet::build(grid, [](Vec3) { return -1.0; });
    EXPECT_LT(body.surface.memory_bytes(), 20'000'000u);  // a table: it is the same everywhere
    EXPECT_THROW(CutField(body, 1), std::length_error);
}

}  // namespace
}  // namespace kerf
