// SPDX-License-Identifier: Apache-2.0
// Contact and friction of a drill's shank in a wall that is a plane. Tool frame: z out of the tip.
#include "plugins/drilling/drill_contact.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "plugins/drilling/drill_channels.h"
#include "plugins/drilling/drill_force.h"

namespace kerf::drilling {
namespace {

using namespace literals;

/// Channels of a drill of 3.2 mm whose shank touches a wall at one side, at 20 turns a second. Its shank
/// carried 4 N, its tip 6 N.
std::vector<kerf_channel> channels_at(const Vec3& side, double cutting) {
    struct Wall {
        Vec3 side;
        double distance;
    };
    TwistDrill drill = defaults_of<TwistBit>().drill();
    DrillParameters law = defaults_of<DrillCutting>();
    law.friction = 0.25;
    const Wall wall{side, drill.shank_radius() - 0.05_mm};
    kerf_bone_query query{};
    query.tissue_count = 1;
    query.reach = 1.0_mm;
    query.bone = reinterpret_cast<const kerf_bone*>(&wall);
    query.nearest = [](const kerf_bone* bone, const kerf_vec3* points, std::uint32_t count, kerf_surface_point* out) {
        const auto& [normal, distance] = *reinterpret_cast<const Wall*>(bone);
        for (std::uint32_t i = 0; i < count; ++i)
            out[i] = {distance - points[i].x * normal.x - points[i].y * normal.y, {-normal.x, -normal.y, 0}, 0, 0};
    };
    query.sample = [](const kerf_bone*, const kerf_vec3*, std::uint32_t count, const kerf_vec3*, std::uint32_t,
                      kerf_bone_sample* out) {
        for (std::uint32_t i = 0; i < count; ++i) {
            out[i] = {};
            out[i].engagement = 1.0;
            out[i].weight[0] = 1.0;
            out[i].density[0] = 1850.0;
        }
    };
    const BoneQuery bone(query);
    const ContactPoints points = touching_points(drill, law, bone, true);
    const Turning turning{.n = 20.0, .cutting = {cutting}, .speed = 20.0, .turns = 0.02};
    Carried last;
    last.by_shank = 4.0;
    last.by_tip = 6.0;
    std::array<kerf_channel, KERF_MAX_CHANNELS> channel{};
    kerf_law given{sizeof(kerf_law), 0, channel.data(), {}, {}};
    Channels channels(given);
    static_cast<void>(add_contact(drill, points, law, bone, turning, {}, last, channels));
    return {channel.begin(), channel.begin() + given.count};
}

TEST(DrillContact, RubsAgainstItsTurnWhileItCuts) {
    const double shank = defaults_of<TwistBit>().drill().shank_radius();
    for (const Vec3& side : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}})
        for (const double cutting : {1.0, 0.5}) {
            int touching = 0;
            for (const kerf_channel& one : channels_at(side, cutting)) {
                if (one.kind != KERF_CONTACT) continue;
                ++touching;
                EXPECT_GT(one.d[0] * side.x + one.d[1] * side.y, 0.7) << "into the wall";
                EXPECT_NEAR(one.follow[5], cutting < 1.0 ? 0.0 : -0.25 * shank, 1e-12);
            }
            EXPECT_GT(touching, 0) << side.x << ' ' << side.y;
        }
}

TEST(DrillContact, ResistsMotionByFrictionOfWhatItCarried) {
    const double shank = defaults_of<TwistBit>().drill().shank_radius();
    int seen = 0;
    for (const kerf_channel& one : channels_at({1, 0, 0}, 1.0)) {
        if (one.kind != KERF_FRICTION) continue;
        ++seen;
        EXPECT_NEAR(one.tau, 0.25 * (one.id == id_rub ? 4.0 : 6.0), 1e-12) << one.id;
        EXPECT_NEAR(one.w, 2.0 * pi * 20.0 * shank, 1e-9) << "speed of its surface";
        EXPECT_EQ(one.d[2], one.id == id_rub ? 1.0 : 0.0);
        EXPECT_EQ(one.d[0], one.id == id_stick ? 1.0 : 0.0);
        EXPECT_EQ(one.d[1], one.id == id_stick + 1 ? 1.0 : 0.0);
    }
    EXPECT_EQ(seen, 3);
}

}  // namespace
}  // namespace kerf::drilling
