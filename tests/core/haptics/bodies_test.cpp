// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/field/surface/bone_surface.h"
#include "tests/support/milled_bar.h"

namespace kerf {
namespace {

using namespace literals;

using test::Milled;

double volume_of(const Mesh& mesh) {
    double sum = 0.0;
    for (const auto& [a, b, c] : mesh.triangles)
        sum += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c])) / 6.0;
    return sum;
}
bool is_closed(const Mesh& mesh) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges, back;
    for (const auto& t : mesh.triangles)
        for (std::size_t n = 0; n < 3; ++n) {
            edges.emplace_back(t[n], t[(n + 1) % 3]);
            back.emplace_back(t[(n + 1) % 3], t[n]);
        }
    std::sort(edges.begin(), edges.end());
    std::sort(back.begin(), back.end());
    return edges == back && std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

TEST(Bodies, ASeveredBarBecomesTwoWithAllTheBoneThatWasNotCut) {
    Milled milled;
    const double before = bone_volume(milled.body, milled.simulation.exact());
    milled.simulation.find_pieces(1e-9 /* 1 mm³ */);
    std::vector<Separation> separations;
    std::uint64_t mark_adopted = 0;
    while (milled.x < 4.0_mm) {
        milled.go();
        for (auto& s : milled.simulation.take_separations()) {
            separations.push_back(std::move(s));
            mark_adopted = milled.simulation.ticks();
        }
    }
    milled.simulation.finish();

    ASSERT_EQ(separations.size(), 1u);
    EXPECT_EQ(mark_adopted, separations[0].tick + Simulation::adoption_delay);
    ASSERT_EQ(milled.simulation.bodies().size(), 2u);
    double left = 0.0;
    for (std::size_t b = 0; b < 2; ++b) {
        EXPECT_TRUE(milled.simulation.committed(b).same_bits(milled.simulation.exact(b))) << "body " << b;
        const double volume = bone_volume(milled.body, milled.simulation.exact(b));
        const Mesh mesh = bone_surface(milled.body, milled.simulation.exact(b));
        EXPECT_TRUE(is_closed(mesh)) << "body " << b;
        EXPECT_NEAR(volume_of(mesh) / volume, 1.0, 0.02 /* marching cubes cut the edges off */) << "body " << b;
        left += volume;
    }
    EXPECT_NEAR((left + milled.simulation.present().removed() + milled.simulation.present().crumb_volume()) / before,
                1.0, 1e-3);
    // 14 mm long, cut at y = 2 mm by 1.2 mm: 8.4 mm and 4.4 mm of 9 mm² stay
    EXPECT_NEAR(bone_volume(milled.body, milled.simulation.exact(0)), 8.4 * 9e-9, 0.02 * 8.4 * 9e-9);
    EXPECT_NEAR(bone_volume(milled.body, milled.simulation.exact(1)), 4.4 * 9e-9, 0.02 * 4.4 * 9e-9);
}

TEST(Bodies, TheToolFeelsBothPiecesWhereTheyAre) {
    // Given a severed bar, its end moved away by 3 mm
    Milled milled;
    milled.simulation.find_pieces(1e-9);
    while (milled.x < 4.0_mm) {
        milled.go();
    }
    ASSERT_EQ(milled.simulation.bodies().size(), 2u);
    const auto felt = [&](double y) {
        const Vec3 point = inverse(milled.simulation.world_from_tool()) * Vec3{0, y, 1.2_mm};
        kerf_surface_point answer;
        milled.simulation.bone().nearest(&point, 1, &answer);
        return answer;
    };
    // When asked 0.3 mm under the bar's upper face, 1 mm from the cut, on both sides of it
    const auto stump = felt(0.4_mm), end = felt(3.6_mm);
    // Then each body answers for itself
    EXPECT_LT(stump.distance, 0.0);
    EXPECT_EQ(stump.body, 0);
    EXPECT_LT(end.distance, 0.0);
    EXPECT_EQ(end.body, 1);
    // and what was moved away is where it went
    milled.simulation.place_body(1, {{0, 3.0_mm, 0}, {1, 0, 0, 0}});
    EXPECT_EQ(felt(3.6_mm).body, -1);
    EXPECT_EQ(felt(6.6_mm).body, 1);
    milled.simulation.show_body(1, false);
    EXPECT_EQ(felt(6.6_mm).body, -1);
}

TEST(Bodies, ACutThroughTwoBodiesAtOnceIsRecordedInEachFrame) {
    Milled milled;
    milled.simulation.find_pieces(1e-9);
    while (milled.x < 4.0_mm) {
        milled.go();
    }
    ASSERT_EQ(milled.simulation.bodies().size(), 2u);
    // Given the end 1 mm nearer to the stump, 0.2 mm from it, so that one way of the mill takes from both
    milled.simulation.place_body(1, {{0, -1.0_mm, 0}, {1, 0, 0, 0}});
    const double before[2] = {bone_volume(milled.body, milled.simulation.exact(0)),
                              bone_volume(milled.body, milled.simulation.exact(1))};
    int records[2] = {0, 0};
    // When the mill comes back between them
    for (double x = milled.x; x > -3.0_mm; x -= 2.0_um) {
        milled.simulation.tick({test::mill_at(x, 1.5_mm)});
        for (const CutRecord& record : milled.simulation.closed())
            if (record.removes) ++records[record.body];
    }
    milled.simulation.finish();
    // Then it took from both
    EXPECT_GT(records[0], 10);
    EXPECT_GT(records[1], 10);
    for (std::size_t b = 0; b < 2; ++b) {
        EXPECT_LT(bone_volume(milled.body, milled.simulation.exact(b)), before[b] - 0.5e-9) << "body " << b;
        EXPECT_TRUE(milled.simulation.committed(b).same_bits(milled.simulation.exact(b))) << "body " << b;
    }
}

}  // namespace
}  // namespace kerf
