// SPDX-License-Identifier: Apache-2.0
// Who of the edges takes how much: by how they move, and by how far they are behind.
#include "plugins/drilling/drill_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "plugins/drilling/drill_force.h"
#include "tests/support/drill_rig.h"

namespace kerf::drilling {
namespace {

using namespace literals;

constexpr double edge_depth = 4.0_um;

TEST(EvenChip, WhoLiesBehindTakesSoMuchLess) {
    const EvenChip even(100.0_um, edge_depth);
    EXPECT_EQ(even.taken(1.0, 0.0).chip, 1.0);
    EXPECT_EQ(even.taken(1.0, 0.0).edge, 1.0);
    EXPECT_DOUBLE_EQ(even.taken(1.0, 25.0_um).chip, 0.75);
    // 2 µm of chip are left, half of t_e; of a whole chip all of the edge force has built up, to 1e-11
    EXPECT_NEAR(even.taken(1.0, 98.0_um).chip, 0.02, 1e-12);
    EXPECT_NEAR(even.taken(1.0, 98.0_um).edge, 1.0 - std::exp(-0.5), 1e-9);
    EXPECT_EQ(even.taken(1.0, 100.0_um).chip, 0.0);
    EXPECT_EQ(even.taken(1.0, 1.0_mm).chip, 0.0);
    EXPECT_DOUBLE_EQ(even.taken(2.0, 25.0_um).chip, 1.75);
    EXPECT_EQ(even.taken(2.0, 25.0_um).edge, 1.0);
}

TEST(EvenChip, WithoutFeedAnEdgeReachesAsFarAsItIsRound) {
    const EvenChip even(0.0, edge_depth);
    EXPECT_DOUBLE_EQ(even.taken(1.0, 2.0_um).chip, 0.5);
    EXPECT_NEAR(even.taken(1.0, 2.0_um).edge, (1.0 - std::exp(-0.5)) / (1.0 - std::exp(-1.0)), 1e-12);
    EXPECT_EQ(even.taken(1.0, edge_depth).chip, 0.0);
}

/// Bone everywhere, and the drill at its front.
kerf_bone_query whole_bone() {
    kerf_bone_query query{};
    query.size = sizeof query;
    query.tissue_count = 1;
    query.sample = [](const kerf_bone*, const kerf_vec3*, std::uint32_t n, const kerf_vec3*, std::uint32_t,
                      kerf_bone_sample* out) {
        for (std::uint32_t i = 0; i < n; ++i) out[i] = {1.0, 0.0, {1.0, 0, 0, 0}, {1850.0, 0, 0, 0}, 0, 0};
    };
    return query;
}

/// The default drill in it, its first lip along x.
struct Lips {
    ToolSetup setup = test::twist_drill();
    kerf_bone_query query = whole_bone();
    DrillCutting law = value_of<DrillCutting>(setup.force_parameters);
    TwistDrill drill = value_of<TwistBit>(setup.tool_parameters, setup.drives).drill();
    EdgeLayout places{drill, law, BoneQuery(query)};
    std::unique_ptr<Edges> edges = std::make_unique<Edges>(drill, places, law, BoneQuery(query), 0.0);
    static constexpr double n = 1000.0_rpm;

    const Edges& going(const Vec6& rate) {
        edges->divide_feed({std::max(0.0, rate[2]), rate}, n, edges->min_gap(), edge_depth);
        return *edges;
    }
};

TEST(ShareOfTheFeed, StraightAheadEveryPieceTakesTheSame) {
    Lips lips;
    const Edges& edges = lips.going({0, 0, 1.0_mm_per_s, 0, 0, 0});
    for (std::size_t i = 0; i < edges.count; ++i) EXPECT_EQ(edges.takes[i].chip, 1.0) << i;
}

TEST(ShareOfTheFeed, AsideTheLipThatLeadsTakesWhatTheOtherLeaves) {
    Lips lips;
    const double along = 1.0_mm_per_s, aside = 0.5_mm_per_s;
    const Edges& edges = lips.going({aside, 0, along, 0, 0, 0});
    for (std::size_t i = 0; i < edges.layout.lip.count; ++i) {
        const LipElement& el = edges.layout.lip.element[i];
        const Vec3 at = edges.point[i];
        const double more = el.normal_radial * aside * at.x / std::hypot(at.x, at.y) / (el.normal_axial * along);
        EXPECT_GT(more, 0.0);
        EXPECT_NEAR(edges.takes[i].chip, 1.0 + more, 1e-12) << i;
        EXPECT_NEAR(edges.takes[i].chip + edges.takes[edges.layout.lip.count + i].chip, 2.0, 1e-12)
            << "together they take the feed";
    }
}

TEST(ShareOfTheFeed, ALipThatGoesAwayTakesNothing) {
    Lips lips;
    const Edges& edges = lips.going({10.0_mm_per_s, 0, 1.0_mm_per_s, 0, 0, 0});
    const std::size_t corner = edges.layout.lip.count - 1;
    EXPECT_EQ(edges.takes[edges.layout.lip.count + corner].chip, 0.0);
    EXPECT_EQ(edges.takes[corner].chip, 2.0) << "no more: that a drill goes mostly sideways is felt elsewhere";
    EXPECT_GT(edge_forces(edges, lips.law, Lips::n, 1.0_mm_per_s).normal[0], 0.0) << "so the bone pushes the other way";
}

TEST(ShareOfTheFeed, DrawnBackOrHeldStillAnyWobbleLeavesItEven) {
    for (const double along : {-5.0_mm_per_s, 0.0_mm_per_s}) {
        Lips lips;
        const Edges& edges = lips.going({3.0_mm_per_s, -2.0_mm_per_s, along, 0.1, 0.2, 0});
        for (std::size_t i = 0; i < edges.count; ++i) EXPECT_EQ(edges.takes[i].chip, 1.0) << along << ' ' << i;
    }
}

TEST(ShareOfTheFeed, TurningAboutTheTipTheSideThatSinksTakesMore) {
    Lips lips;
    const Edges& edges = lips.going({0, 0, 1.0_mm_per_s, 0, -0.2, 0});  // x sinks at 0.2 m/s per metre
    const std::size_t corner = edges.layout.lip.count - 1;
    EXPECT_GT(edges.takes[corner].chip, 1.1);
    EXPECT_LT(edges.takes[edges.layout.lip.count + corner].chip, 0.9);
}

// In whole bone what pushes aside cancels, and the thrust is that of all edges.
TEST(EdgeForces, InWholeBoneOnlyThrustAndTorqueAreLeft) {
    Lips lips;
    const EdgeForces forces = edge_forces(lips.going({0, 0, 2.0_mm_per_s, 0, 0, 0}), lips.law, Lips::n, 2.0_mm_per_s);
    EXPECT_NEAR(forces.thrust(), 129.1 + 567.4 * 0.12, 1.0) << "the line of [macavelia-2012]";
    for (const std::size_t other : {0u, 1u, 3u, 4u}) EXPECT_NEAR(forces.normal[other], 0.0, 1e-9) << other;
    for (const std::size_t other : {0u, 1u, 2u, 3u, 4u}) EXPECT_NEAR(forces.cutting[other], 0.0, 1e-9) << other;
}

// With bone on one side the normal force points where the lip's normal does: a rate along the cut surface does no work
// on it.
TEST(EdgeForces, OneLipPushesAlongItsOwnNormal) {
    Lips lips;
    for (std::size_t i = 0; i < lips.edges->count; ++i)
        if (i >= lips.edges->layout.lip.count) lips.edges->resistance[i] = 0.0;
    const Edges& edges = lips.going({0, 0, 2.0_mm_per_s, 0, 0, 0});
    const EdgeForces forces = edge_forces(edges, lips.law, Lips::n, 2.0_mm_per_s);
    double radial = 0.0, axial = 0.0;
    for (std::size_t i = 0; i < edges.layout.lip.count; ++i) {
        const LipElement& el = edges.layout.lip.element[i];
        const Vec3 at = edges.point[i];
        radial += el.width * el.normal_radial * at.x / std::hypot(at.x, at.y);
        axial += el.width * el.normal_axial;
    }
    EXPECT_NEAR(forces.normal[0] / forces.normal[2], radial / axial, 0.002) << "chips differ a little along it";
    EXPECT_EQ(forces.cutting[2], 0.0);
}

}  // namespace
}  // namespace kerf::drilling
