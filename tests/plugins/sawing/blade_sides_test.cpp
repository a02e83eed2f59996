// SPDX-License-Identifier: Apache-2.0
// Stiffness of a blade along its length, and the sums of the forces on it, channel by channel.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "plugins/sawing/blade_torque.h"
#include "plugins/sawing/saw_contact.h"
#include "plugins/sawing/saw_cutting.h"
#include "tests/support/saw_rig.h"

namespace kerf::sawing {
namespace {

using namespace literals;

constexpr double young = 193e9, contact = 500e3;  // [N/m²], [N/m]

template <class Blade>
TouchingPoints points_of(const Blade& blade) {
    kerf_bone_query query{};
    query.reach = 1.0_mm;
    SawParameters law{};
    law.contact_stiffness = contact;
    return touching_points(blade, law, BoneQuery(query), true);
}

constexpr StraightBlade ten_high{.length = 50.0_mm,
                                 .height = 10.0_mm,
                                 .travel = 3.0_mm,
                                 .pitch = 2.0_mm,
                                 .tooth_count = 25,
                                 .thickness = 0.8_mm,
                                 .set = 0.1_mm,
                                 .tooth_height = 1.0_mm};

// 50 × 10 × 0.8 mm: I = 0.4267 mm⁴, J = 1.7067 mm⁴. The clamp is at x = −25 mm.
TEST(StraightBlade, BendsFromItsClampedEnd) {
    const double second_moment = 10.0e-3 * 0.512e-9 / 12.0, torsion = 4.0 * second_moment;
    const TouchingPoints points = points_of(ten_high);
    double softest = HUGE_VAL, stiffest = 0.0;
    for (std::size_t i = 0; i < points.side_count; ++i) {
        const std::size_t at = points.of_sides[i].index;
        const Vec3 p = points.all.at(at);
        const double l = p.x + 25.0_mm, arm = p.z + 5.0_mm;
        if (l < 5.0_mm) continue;  // in the clamp
        const double compliance = l * l * l / (3.0 * young * second_moment) + arm * arm * l / (young / 2.6 * torsion);
        EXPECT_NEAR(points.all.stiffness(at) * (compliance + 1.0 / contact), 1.0, 1e-6) << p.x << ' ' << p.z;
        softest = std::min(softest, points.all.stiffness(at));
        stiffest = std::max(stiffest, points.all.stiffness(at));
    }
    EXPECT_GT(stiffest, 20.0 * softest);
}

// A blade of 30 mm radius, 10 mm wide and 0.5 mm thick, clamped at the axis of its swing.
TEST(SawBlade, BendsFromTheAxisOfItsSwing) {
    const SawBlade blade{.radius = 30.0_mm,
                         .arc = 0.1,
                         .pitch = 1.0_mm,
                         .tooth_count = 10,
                         .thickness = 0.5_mm,
                         .set = 0.1_mm,
                         .tooth_height = 1.0_mm};
    const double second_moment = 10.0e-3 * 0.125e-9 / 12.0;
    const TouchingPoints points = points_of(blade);
    ASSERT_GT(points.side_count, 12u);
    for (std::size_t i = 0; i < points.side_count; ++i) {
        const std::size_t at = points.of_sides[i].index;
        const Vec3 p = points.all.at(at);
        const double l = 30.0_mm + p.z;
        EXPECT_NEAR(points.all.stiffness(at) * (l * l * l / (3.0 * young * second_moment) + 1.0 / contact), 1.0, 1e-6)
            << p.z;
        EXPECT_NEAR(std::abs(p.y), 0.25_mm, 1e-15);
        EXPECT_EQ(points.all.outwards(at).y, p.y > 0.0 ? 1.0 : -1.0);
    }
}

/// Bone of the reference density on the +y side of the blade.
struct BoneOnOneSide {
    kerf_bone_query query{};

    BoneOnOneSide() {
        query.tissue_count = 1;
        query.reach = 1.0_mm;
        query.sample = [](const kerf_bone*, const kerf_vec3* points, std::uint32_t count, const kerf_vec3*,
                          std::uint32_t, kerf_bone_sample* out) {
            for (std::uint32_t i = 0; i < count; ++i) {
                out[i] = {};
                out[i].engagement = points[i].y > 0.0 ? 1.0 : 0.0;
                out[i].weight[0] = 1.0;
                out[i].density[0] = 1850.0;
            }
        };
    }
};

// 25 teeth of 1 mm, of which half are set to each side: 12.5 mm of edge. At an end one tooth passes: 1 mm. Of the five
// points across an end, two lie on the +y side.
TEST(SideCutting, HasTheEdgesOfTheTeethThatAreSetToThatSide) {
    SawParameters law{};
    law.thrust_edge = 6.0_N_per_mm;
    law.thrust_chip = 200.0_N_per_mm2;
    law.edge_depth = 0.4_um;
    law.reference_density = 1850.0;
    TeethInBone teeth{};
    teeth.teeth.count = 1;
    teeth.resisted[0] = teeth.resisted[1] = 1.0;
    const BoneOnOneSide bone;
    const Oscillation motion{.stroke = {.length = 3.0_mm, .pitch = 2.0_mm, .rate = 200.0}, .cutting = {1.0}};
    std::array<kerf_channel, KERF_MAX_CHANNELS> channel{};
    kerf_law given{sizeof(kerf_law), 0, channel.data(), {}, {}};
    Channels channels(given);
    add_side_cutting(teeth, ten_high, law, BoneQuery(bone.query), motion, channels);
    ASSERT_EQ(given.count, 3u) << "a side and two ends";
    EXPECT_EQ(channel[0].id, id_side);
    EXPECT_NEAR(channel[0].tau, 12.5 * 6.0, 1e-9);
    EXPECT_EQ(channel[0].d[1], 1.0);
    for (const auto& [end, out] : {std::pair{1, 1.0}, {2, -1.0}}) {
        EXPECT_EQ(channel[end].id, id_end + (end == 1 ? 0 : 1));
        EXPECT_NEAR(channel[end].tau, 0.4 * 6.0, 1e-9);
        EXPECT_NEAR(channel[end].w, 0.4_um * 200.0, 1e-12) << "a chip is the advance of an oscillation";
        EXPECT_NEAR(channel[end].eta, 0.4e-3 * 200e6 / 200.0, 1e-9);
        EXPECT_EQ(channel[end].d[0], out);
    }
}

/// The feed channels of one tooth at the tip, set to `side`, in bone of the reference density.
std::vector<kerf_channel> feed_of(double side, double phase, bool is_averaged) {
    SawParameters law{};
    law.thrust_edge = 6.0_N_per_mm;
    law.cutting_edge = 4.5_N_per_mm;
    law.edge_depth = 0.4_um;
    law.set_share = 0.1;
    law.reference_density = 1850.0;
    TeethInBone teeth{};
    teeth.teeth.count = 1;
    teeth.teeth.tooth[0] = {.tip = {0, 0, 0}, .normal = {0, 0, 1}, .along = {1, 0, 0}, .side = side};
    teeth.resisted[0] = teeth.resisted[1] = 1.0;
    const Oscillation motion{.stroke = {.length = 3.0_mm, .pitch = 2.0_mm, .rate = 50.0},
                             .cutting = {1.0},
                             .phase = phase,
                             .is_averaged = is_averaged};
    std::array<kerf_channel, KERF_MAX_CHANNELS> channel{};
    kerf_law given{sizeof(kerf_law), 0, channel.data(), {}, {}};
    Channels channels(given);
    add_feed_cutting(teeth, 1.0_mm, law, motion, 1.0_mm, channels);
    return {channel.begin(), channel.begin() + given.count};
}

TEST(FeedCutting, PushesAToothAgainstTheSideOfItsSet) {
    for (const double side : {1.0, -1.0}) {
        double thrust = 0.0;
        for (const kerf_channel& one : feed_of(side, 0.0, true)) {
            EXPECT_EQ(one.d[2], 1.0);
            EXPECT_NEAR(one.follow[1], -side * 0.1, 1e-12);
            EXPECT_NEAR(one.follow[0], 0.0, 1e-12) << "to and fro cancel";
            thrust += one.tau;
        }
        EXPECT_NEAR(thrust, 6.0, 1e-9) << "N, in both parts of the oscillation";
    }
}

TEST(FeedCutting, PushesASlowToothBackInBothDirections) {
    for (const auto& [phase, against] : {std::pair{0.0, -0.75}, {pi, 0.75}, {0.5 * pi, 0.0}}) {
        const std::vector<kerf_channel> feed = feed_of(1.0, phase, false);
        ASSERT_EQ(feed.size(), 1u);
        EXPECT_NEAR(feed[0].tau, 6.0, 1e-9);
        EXPECT_NEAR(feed[0].follow[0], against, 1e-9) << "4.5 N against 6 N, at " << phase;
    }
}

/// Channels of which each carries a force of its own: 1 N, 10 N, 100 N …
struct Loaded {
    std::vector<kerf_channel> channels;
    std::vector<double> lambda;
    Vec6 following{};

    explicit Loaded(const std::vector<std::uint32_t>& ids) {
        double force = 1.0;
        for (const std::uint32_t id : ids) {
            channels.push_back({});
            channels.back().id = id;
            lambda.push_back(force);
            force *= 10.0;
        }
    }
    [[nodiscard]] Advance advance() const {
        return {.rate = {}, .channel = channels, .lambda = lambda, .following = following};
    }
};

TEST(Binding, IsTheForceOnBothSidesAlone) {
    const std::uint32_t first = id_contact;
    const Loaded loaded({first + slot_tip, first + slot_side, first + slot_side + 3, first + slot_edge,
                         first + slot_back, id_rub, id_feed});
    EXPECT_EQ(binding_of(loaded.advance()), 10.0 + 100.0);
}

TEST(BladeTorque, CountsLoadsThatFollow) {
    // 3 N to +y at the cutting edge, 5 mm from the long axis, and a torque of 20 N·mm of their own
    Loaded loaded({});
    loaded.following = {0, 3.0, 0, 20.0_Nmm, 0, 0};
    EXPECT_NEAR(blade_torque(loaded.advance(), ten_high), 20.0_Nmm - 15.0_Nmm, 1e-15);
}

}  // namespace
}  // namespace kerf::sawing
