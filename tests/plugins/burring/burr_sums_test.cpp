// SPDX-License-Identifier: Apache-2.0
// What a burr sums over its channels, each with a force of its own.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "plugins/burring/burr_contact.h"
#include "plugins/burring/burr_cutting.h"
#include "plugins/burring/burr_force.h"

namespace kerf::burring {
namespace {

/// Channels that carry 1 N, 10 N, 100 N …, with a torque of 1 mN·m per newton about −z.
struct Loaded {
    std::vector<kerf_channel> channels;
    std::vector<double> lambda;

    Loaded(std::uint32_t kind, const std::vector<std::uint32_t>& ids) {
        double force = 1.0;
        for (const std::uint32_t id : ids) {
            channels.push_back({});
            channels.back().kind = kind;
            channels.back().id = id;
            channels.back().follow[5] = -1e-3;
            lambda.push_back(force);
            force *= 10.0;
        }
    }
    [[nodiscard]] Advance advance() const {
        return {.rate = {}, .channel = channels, .lambda = lambda, .following = {}};
    }
};

TEST(CuttingTorque, IsThatOfAllCuttingSectorsAndNoOther) {
    const Loaded loaded(KERF_CUT, {id_cut - 1, id_cut, id_cut + sector_count - 1, id_cut + sector_count, id_contact});
    EXPECT_NEAR(cutting_torque(loaded.advance(), 1.0), 0.110, 1e-12);
}

TEST(CuttingTorque, IsAgainstTheTurnInBothSenses) {
    const Loaded loaded(KERF_CUT, {id_cut});
    EXPECT_NEAR(cutting_torque(loaded.advance(), 1.0), 1e-3, 1e-15);
    EXPECT_NEAR(cutting_torque(loaded.advance(), -1.0), -1e-3, 1e-15);
}

TEST(Carried, DividesContactBetweenHeadAndNeck) {
    const std::uint32_t neck = id_contact + wide_count;
    const Carried carried(Loaded(KERF_CONTACT, {id_contact, neck - 1, neck, neck + 2}).advance());
    EXPECT_EQ(carried.by_head, 11.0);
    EXPECT_EQ(carried.by_neck, 1100.0);
}

TEST(Carried, IsNoCutNorFriction) {
    for (const std::uint32_t kind : {KERF_CUT, KERF_FRICTION, KERF_HOLD}) {
        const Carried carried(Loaded(kind, {id_cut, id_rub, id_contact, id_contact + wide_count}).advance());
        EXPECT_EQ(carried.by_head, 0.0);
        EXPECT_EQ(carried.by_neck, 0.0);
    }
}

/// Channels of a burr whose neck is in a wall on the +x side, at 300 turns a second; its neck carried 2 N, its head 3
/// N.
std::vector<kerf_channel> rubbing(double sense, double cutting) {
    RoundBurr burr = defaults_of<RoundBurr>();  // 4 mm, neck 1.6 mm
    BurrParameters law = defaults_of<BurrCutting>();
    law.friction = 0.25;
    kerf_bone_query query{};
    query.reach = 1e-3;
    query.nearest = [](const kerf_bone*, const kerf_vec3* points, std::uint32_t count, kerf_surface_point* out) {
        for (std::uint32_t i = 0; i < count; ++i) out[i] = {0.75e-3 - points[i].x, {-1, 0, 0}, 0, 0};
    };
    const BoneQuery bone(query);
    const BurrHead head = burr.head();
    const ContactPoints points = touching_points(head, burr.length, law, bone, true);
    const Turning turning{.blade_rate = 1800.0, .sense = sense, .cutting = {cutting}, .rate = {}};
    Carried last;
    last.by_neck = 2.0;
    last.by_head = 3.0;
    std::array<kerf_channel, KERF_MAX_CHANNELS> channel{};
    kerf_law given{sizeof(kerf_law), 0, channel.data(), {}, {}};
    Channels channels(given);
    add_contact(head, points, law, bone, turning, 300.0, last, channels);
    return {channel.begin(), channel.begin() + given.count};
}

TEST(BurrContact, RubsAgainstTheTurnOfItsNeck) {
    for (const double sense : {1.0, -1.0})
        for (const double cutting : {1.0, 0.5}) {
            int touching = 0;
            for (const kerf_channel& one : rubbing(sense, cutting)) {
                if (one.kind != KERF_CONTACT) continue;
                ++touching;
                EXPECT_GT(one.d[0], 0.7) << "into the wall";
                EXPECT_NEAR(one.follow[5], cutting < 1.0 ? 0.0 : -sense * 0.25 * 0.8e-3, 1e-12) << sense;
            }
            EXPECT_GT(touching, 0);
        }
}

TEST(BurrContact, ResistsMotionByFrictionOfWhatItCarried) {
    int seen = 0;
    for (const kerf_channel& one : rubbing(1.0, 1.0)) {
        if (one.kind != KERF_FRICTION) continue;
        ++seen;
        const bool is_of_neck = one.id == id_rub;
        EXPECT_NEAR(one.tau, 0.25 * (is_of_neck ? 2.0 : 3.0), 1e-12) << one.id;
        EXPECT_NEAR(one.w, 2.0 * pi * 300.0 * (is_of_neck ? 0.8e-3 : 2e-3), 1e-9) << "speed of its surface";
        EXPECT_EQ(one.d[2], is_of_neck ? 1.0 : 0.0);
        EXPECT_NEAR(one.d[4], one.id == id_stick ? -2e-3 : 0.0, 1e-12) << "at the middle of the ball";
        EXPECT_NEAR(one.d[3], one.id == id_stick + 1 ? 2e-3 : 0.0, 1e-12);
    }
    EXPECT_EQ(seen, 3);
}

}  // namespace
}  // namespace kerf::burring
