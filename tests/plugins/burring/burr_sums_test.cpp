// SPDX-License-Identifier: Apache-2.0
// What a burr sums over its channels, each with a force of its own.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "plugins/burring/burr_contact.h"
#include "plugins/burring/burr_cutting.h"

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

}  // namespace
}  // namespace kerf::burring
