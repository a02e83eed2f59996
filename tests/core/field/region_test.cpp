// SPDX-License-Identifier: Apache-2.0
// Resolutions B8: beyond the region bone goes on, solid, and cannot be cut.
#include "core/field/grid/region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/field/cut/body_query.h"
#include "core/field/cut/removed_volume.h"
#include "core/field/surface/bone_surface.h"
#include "tests/support/block.h"
#include "tests/support/mesh_checks.h"

namespace kerf {
namespace {

using namespace literals;

constexpr double h = 0.5_mm, inf = std::numeric_limits<double>::infinity(),
                 nan = std::numeric_limits<double>::quiet_NaN();
constexpr Vec3 low{-4.0_mm, -4.0_mm, -6.0_mm}, high{4.0_mm, 4.0_mm, 3.0_mm};

/// A block of 16 × 16 × 12 mm under z = 0, of which 8 × 8 × 6 mm are the region. Samples lie on every half millimetre.
Body looked_at() {
    Body body = test::block({-8.0_mm, -8.0_mm, -12.0_mm}, {8.0_mm, 8.0_mm, 0}, h);
    const Grid& g = body.grid();
    const auto sample = [&](Vec3 p) {
        const Vec3 at = (1.0 / h) * (p - g.origin);
        return g.sample_position(static_cast<int>(at.x + 0.5), static_cast<int>(at.y + 0.5),
                                 static_cast<int>(at.z + 0.5));
    };
    body.region = {sample(low), sample(high)};
    return body;
}

/// A drill straight down along z, to `depth`, and what it leaves.
struct Drilled {
    Body body = looked_at();
    ToolSolid tool = test::drill_outline(1.6_mm, 59.0_deg, 20.0_mm);
    CutField committed{body, 64}, exact{body, 64};
    CutTracker tracker{body, tool, committed};
    BodyQuery view{body, committed, tracker};

    explicit Drilled(double depth) {
        tracker.restart(at(-1.0_mm));
        const int steps = static_cast<int>((depth + 1.0_mm) / 20.0_um);
        for (int i = 1; i <= steps; ++i) {
            const Pose now = at(-1.0_mm + 20.0_um * i);
            for (int c = 0, closed = tracker.advance(now, static_cast<std::uint64_t>(i)); c < closed; ++c)
                if (tracker.closed(c).removes) exact.stamp(tracker.closed(c), tool);
            tracker.commit_passed(now, true);
        }
    }
    static Pose at(double depth) { return test::pointing({0, 0, -depth}, {0, 0, -1}); }
    [[nodiscard]] kerf_bone_sample sample(Vec3 p) const {
        kerf_bone_sample s;
        view.sample(&p, 1, {0, 0, -1}, &s);
        return s;
    }
    [[nodiscard]] kerf_surface_point nearest(Vec3 p) const {
        kerf_surface_point s;
        view.nearest(&p, 1, &s);
        return s;
    }
};

TEST(Region, SaysHowFarOutsideAPointIs) {
    const Body body = looked_at();
    EXPECT_EQ(outside_region(body, {0, 0, 0}), 0.0);
    EXPECT_EQ(outside_region(body, body.region.low), 0.0) << "on the face";
    EXPECT_NEAR(outside_region(body, {0, 0, -7.5_mm}), 1.5_mm, 1e-15);
    EXPECT_NEAR(outside_region(body, {7.0_mm, 0, 7.0_mm}), 5.0_mm, 1e-15) << "3 and 4 mm beyond an edge";
    EXPECT_EQ(outside_region(body, {inf, 0, 0}), inf);
    EXPECT_EQ(outside_region(body, {nan, 0, 0}), 0.0) << "nothing is pushed by a point that is nowhere";
    EXPECT_NEAR(outside_region(body, {0, nan, -7.5_mm}), 1.5_mm, 1e-15);
}

TEST(Region, WithoutOneNothingIsOutside) {
    const Body body = test::block({-8.0_mm, -8.0_mm, -12.0_mm}, {8.0_mm, 8.0_mm, 0}, h);
    for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{1.0, -2.0, 3.0}, Vec3{1e300, inf, -inf}, Vec3{nan, nan, nan}})
        EXPECT_EQ(outside_region(body, p), 0.0);
}

TEST(Region, BeyondItBoneGoesOnAsAtItsFace) {
    const Drilled bone(-1.0_mm);
    for (const auto& [beyond, face] : {std::pair{Vec3{20.0_mm, 1.0_mm, -3.0_mm}, Vec3{4.0_mm, 1.0_mm, -3.0_mm}},
                                       std::pair{Vec3{1.0, -0.4, -3.0}, Vec3{4.0_mm, -4.0_mm, -6.0_mm}},
                                       std::pair{Vec3{20.0_mm, 1.0_mm, 0.2_mm}, Vec3{4.0_mm, 1.0_mm, 0.2_mm}},
                                       std::pair{Vec3{20.0_mm, 1.0_mm, 1.0}, Vec3{4.0_mm, 1.0_mm, 3.0_mm}}}) {
        EXPECT_EQ(bone.sample(beyond).engagement, bone.sample(face).engagement);
        EXPECT_EQ(bone.nearest(beyond).distance, bone.nearest(face).distance);
        EXPECT_EQ(bone.sample(beyond).weight[0], bone.sample(face).weight[0]);
    }
    EXPECT_EQ(bone.sample({20.0_mm, 1.0_mm, -3.0_mm}).engagement, 1.0) << "even outside the grid";
    EXPECT_EQ(bone.sample({20.0_mm, 1.0_mm, 1.0}).engagement, 0.0) << "above the bone is air, there as here";
}

TEST(Region, AtNotANumberThereIsAirAndFarAwayBone) {
    const Drilled bone(-1.0_mm);
    for (const Vec3 p : {Vec3{nan, 0, -3.0_mm}, Vec3{0, nan, -3.0_mm}, Vec3{0, 0, nan}}) {
        EXPECT_EQ(bone.sample(p).engagement, 0.0);
        EXPECT_EQ(bone.nearest(p).body, -1);
    }
    EXPECT_EQ(bone.sample({0, 0, -1e300}).engagement, 1.0);
    EXPECT_EQ(bone.sample({0, 0, -inf}).engagement, 0.0) << "turned into the body's frame it is not a number";
}

TEST(Region, BeyondItNothingIsEverCut) {
    // Given a hole that is drilled on to 4 mm below the region
    Drilled bone(10.0_mm);

    // Then there is bone below the face, in front of every edge, however near
    for (const double below : {1.0_um, 0.5_mm, 3.0_mm}) {
        const kerf_bone_sample s = bone.sample({0, 0, -6.0_mm - below});
        EXPECT_EQ(s.engagement, 1.0) << below;
        EXPECT_EQ(s.gap, 0.0) << "no pending record takes it either";
        EXPECT_LT(bone.nearest({0, 0, -6.0_mm - below}).distance, -h) << below;
    }
    EXPECT_EQ(bone.sample({0, 0, -4.0_mm}).engagement, 0.0) << "the hole is there";
    bone.tracker.flush();
    EXPECT_TRUE(bone.committed.same_bits(bone.exact));
    const Grid& g = bone.body.grid();
    int cut = 0;
    for (int k = 0; k < g.samples(2); ++k)
        for (int j = 0; j < g.samples(1); ++j)
            for (int i = 0; i < g.samples(0); ++i) {
                if (bone.exact.sample(i, j, k) == -32767) continue;
                ASSERT_TRUE(bone.body.region.contains(g.sample_position(i, j, k)));
                ++cut;
            }
    EXPECT_GT(cut, 100);
}

TEST(Region, MeshAndVolumesKeepToIt) {
    Drilled bone(10.0_mm);
    RemovedVolume removed(bone.body);
    removed.update(bone.exact);
    // The hole goes down to the last sample above the face, and half a voxel beyond.
    const double hole = pi * 1.6_mm * 1.6_mm * (6.0_mm - 0.5 * h);
    EXPECT_NEAR(removed.total() / hole, 1.0, 0.03 /* 13 voxels' area is little */);

    const Mesh mesh = bone_surface(bone.body, bone.exact);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& t : mesh.triangles)
        for (std::size_t c = 0; c < 3; ++c) edges.emplace_back(t[c], t[(c + 1) % 3]);
    std::sort(edges.begin(), edges.end());
    for (const auto& [a, b] : edges) ASSERT_TRUE(std::binary_search(edges.begin(), edges.end(), std::pair{b, a}));
    for (const Vec3& v : mesh.vertices) ASSERT_LT(outside_region(bone.body, v), 1e-9);

    const Mesh whole = bone_surface(bone.body, CutField(bone.body, 1));
    EXPECT_NEAR((test::volume(whole) - test::volume(mesh)) / hole, 1.0,
                0.1 /* its rim is cut off like the box's edges, 3 %; its bottom is round */);
    const double box = 8.0_mm * 8.0_mm * 6.0_mm, edge_length = 4.0 * (8.0_mm + 8.0_mm + 6.0_mm);
    EXPECT_NEAR(test::volume(whole), box - 0.5 * h * h * edge_length, 0.005 * box)
        << "its edges are cut off by a voxel";
}

}  // namespace
}  // namespace kerf
