// SPDX-License-Identifier: Apache-2.0
// Contact of core, tip and head with bone whose surface is a formula. Tool frame: z out of the tip.
#include "plugins/implant/screw_contact.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace kerf::implant {
namespace {

using namespace literals;

constexpr ScrewThread thread() {
    return {.outer = 6.5_mm,
            .outer_at_tip = 6.5_mm,
            .core = 4.5_mm,
            .core_at_tip = 3.0_mm,
            .pitch = 3.0_mm,
            .starts = 1.0,
            .length = 45.0_mm,
            .flank_angle = 15.0_deg,
            .flutes = 2.0,
            .flute_length = 6.0_mm,
            .head = 10.0_mm,
            .seat = 45.0_mm,
            .takes_chips_out = false};
}

// The points of the seat lie midway between the crests, at 3.25 mm, and the rim of the head, at 5 mm.
TEST(ScrewContact, SeatLiesUnderItsHead) {
    const ScrewContact contact(thread());
    Vec3 sum{};
    for (const Vec3& p : contact.seat) {
        EXPECT_NEAR(std::hypot(p.x, p.y), 4.125_mm, 1e-12);
        EXPECT_NEAR(p.z, -(45.0_mm), 1e-12);
        sum = sum + p;
    }
    EXPECT_NEAR(std::hypot(sum.x, sum.y), 0.0, 1e-12) << "evenly around";
}

// A core of 3 mm at the tip: a cone of 1.5 mm radius and 3 mm length.
TEST(ScrewContact, PointsLieOnItsTipAndCore) {
    const ScrewContact contact(thread());
    double area = 0.0;
    for (std::size_t i = 0; i < contact.tip.size(); ++i) {
        const Vec3 p = contact.tip[i];
        EXPECT_NEAR(std::hypot(p.x, p.y), i == 0 ? 0.0 : 1.125_mm, 1e-12);
        EXPECT_NEAR(p.z, i == 0 ? 0.0 : -(2.25_mm), 1e-12) << "on the cone, whose length is twice its radius";
        area += contact.tip_area[i];
    }
    EXPECT_NEAR(area, pi * 2.25_mm * 1.0_mm, 1e-12) << "of the core's section";
    for (std::size_t i = 0; i < contact.wall.size(); ++i) {
        const Vec3 p = contact.wall[i];
        EXPECT_NEAR(std::hypot(p.x, p.y), 0.5 * thread().core_at(p.z), 1e-12) << i;
    }
}

/// A round hole along z, and under the head bone on the +y side.
struct Hole {
    double radius = 3.0_mm, x = 0.0;  ///< of its middle
    double seat_depth = -1.0_mm;      ///< of the head in bone
    double gap = 1.0_mm;              ///< from the tip to bone ahead

    [[nodiscard]] kerf_surface_point nearest(kerf_vec3 p) const {
        if (p.z < -40.0_mm) return {-seat_depth, {0, 0, -1}, p.y > 0.1_mm ? 0 : -1, 0};
        const double away = std::hypot(p.x - x, p.y);
        return {radius - away, {-(p.x - x) / away, -p.y / away, 0}, 0, 0};
    }
    /// Returns the channels of a law with round coefficients.
    [[nodiscard]] std::vector<kerf_channel> channels() const {
        kerf_bone_query query{};
        query.tissue_count = 1;
        query.reach = 1.0_mm;
        query.bone = reinterpret_cast<const kerf_bone*>(this);
        query.nearest = [](const kerf_bone* bone, const kerf_vec3* points, std::uint32_t count,
                           kerf_surface_point* out) {
            for (std::uint32_t i = 0; i < count; ++i) out[i] = reinterpret_cast<const Hole*>(bone)->nearest(points[i]);
        };
        query.sample = [](const kerf_bone* bone, const kerf_vec3*, std::uint32_t count, const kerf_vec3*, std::uint32_t,
                          kerf_bone_sample* out) {
            for (std::uint32_t i = 0; i < count; ++i) {
                out[i] = {};
                out[i].engagement = 1.0;
                out[i].weight[0] = 1.0;
                out[i].density[0] = reference_density;
                out[i].gap = reinterpret_cast<const Hole*>(bone)->gap;
            }
        };
        ScrewParameters law{};
        law.crush = 200.0_N_per_mm2;
        law.wall_stiffness = 500.0_N_per_mm;
        law.seat_stiffness = 4000.0_N_per_mm;
        std::array<kerf_channel, KERF_MAX_CHANNELS> channel{};
        kerf_law given{sizeof(kerf_law), 0, channel.data(), {}, {}};
        Channels channels(given);
        ScrewContact(thread()).add_to(channels, law, BoneQuery(query));
        return {channel.begin(), channel.begin() + given.count};
    }
    [[nodiscard]] kerf_channel channel(std::uint32_t id) const {
        for (const kerf_channel& one : channels())
            if (one.id == id) return one;
        return {};
    }
};

// The core has 1.55 mm radius at z = −3 mm, where its first level lies.
TEST(ScrewContact, RestsBetweenBothSidesOfATightHole) {
    for (const double side : {1.0, -1.0}) {
        const Hole hole{.radius = 1.5_mm, .x = side * 0.02_mm};
        const kerf_channel held = hole.channel(ScrewContact::id_wall);
        ASSERT_EQ(held.kind, std::uint32_t{KERF_HOLD});
        EXPECT_NEAR(held.k, 2.0 * 500e3, 1.0);
        EXPECT_NEAR(held.delta, -side * 0.02_mm, 1e-9) << "it is pushed to the middle of the hole";
        EXPECT_EQ(held.d[0], 1.0);
        EXPECT_NEAR(held.d[4], -(3.0_mm), 1e-12) << "with a lever of 3 mm behind the tip";
        EXPECT_NEAR(hole.channel(ScrewContact::id_wall + 1).delta, 0.0, 1e-9) << "across";
    }
}

TEST(ScrewContact, TouchesTheNearerSideOfAWideHole) {
    for (const auto& [side, id] : {std::pair{-1.0, ScrewContact::id_wall}, {1.0, ScrewContact::id_wall + 2}}) {
        const Hole hole{.radius = 1.6_mm, .x = side * 0.1_mm};
        const kerf_channel touch = hole.channel(id);
        ASSERT_EQ(touch.kind, std::uint32_t{KERF_CONTACT});
        EXPECT_NEAR(touch.delta, 0.05_mm, 1e-9);
        EXPECT_NEAR(touch.k, 500e3, 1.0);
        EXPECT_NEAR(touch.d[0], -side, 1e-12);
        EXPECT_NEAR(touch.d[4], side * 3.0_mm, 1e-12);
    }
}

TEST(ScrewContact, TouchesNoWallThatIsFarAway) {
    for (const kerf_channel& one : Hole{}.channels()) EXPECT_EQ(one.id, ScrewContact::id_tip);
}

TEST(ScrewContact, CrushesBoneAheadOfItsTip) {
    const kerf_channel crushed = Hole{.gap = 0.2_mm}.channel(ScrewContact::id_tip);
    EXPECT_EQ(crushed.kind, std::uint32_t{KERF_CUT});
    EXPECT_NEAR(crushed.tau, 200.0 * pi * 2.25, 1e-6) << "N on 7.07 mm2";
    EXPECT_EQ(crushed.gap, 0.2_mm);
    EXPECT_EQ(crushed.d[2], 1.0);
}

TEST(ScrewContact, SeatsOnAsMuchBoneAsLiesUnderTheHead) {
    const kerf_channel seat = Hole{.seat_depth = 0.1_mm}.channel(ScrewContact::id_seat);
    EXPECT_EQ(seat.kind, std::uint32_t{KERF_CONTACT});
    EXPECT_NEAR(seat.k, 3.0 / 8.0 * 4000e3, 1.0) << "three of eight points";
    EXPECT_NEAR(seat.delta, 0.1_mm, 1e-12);
    EXPECT_EQ(seat.d[2], 1.0);
    EXPECT_NEAR(Hole{.seat_depth = -0.2_mm}.channel(ScrewContact::id_seat).delta, -0.2_mm, 1e-12);
    EXPECT_NE(Hole{.seat_depth = -0.4_mm}.channel(ScrewContact::id_seat).id, ScrewContact::id_seat);
}

}  // namespace
}  // namespace kerf::implant
