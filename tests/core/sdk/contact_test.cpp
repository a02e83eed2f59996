// SPDX-License-Identifier: Apache-2.0
// Held against walls whose distances are exact: what a point carries must not depend on how far a grid knows them.
#include "kerf/contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "kerf/exact_math.hpp"

namespace kerf {
namespace {

constexpr double stiffness = 40e3;  // [N/m]

/// Bone that tells its distance as grids do: cut off at `reach`, and nothing of a surface beyond.
struct Bone {
    std::function<kerf_surface_point(Vec3)> exact;
    double reach;
    mutable std::size_t asked = 0;

    [[nodiscard]] kerf_bone_query query() const {
        kerf_bone_query q{};
        q.size = sizeof q;
        q.tissue_count = 1;
        q.reach = reach;
        q.bone = reinterpret_cast<const kerf_bone*>(this);
        q.nearest = [](const kerf_bone* of, const kerf_vec3* points, std::uint32_t count, kerf_surface_point* out) {
            const Bone& self = *reinterpret_cast<const Bone*>(of);
            self.asked += count;
            for (std::uint32_t i = 0; i < count; ++i) {
                out[i] = self.exact(points[i]);
                if (std::abs(out[i].distance) >= self.reach)
                    out[i] = {std::copysign(self.reach, out[i].distance), {0, 0, 0}, -1, 0};
            }
        };
        return q;
    }
};

/// Bone fills n · p > offset.
Bone half_space(Vec3 n, double offset, double reach) {
    return {[=](Vec3 p) -> kerf_surface_point { return {offset - dot(n, p), -n, 0, 0}; }, reach};
}
/// Bone around a hole along z through (x, 0).
Bone hole(double radius, double x, double reach) {
    return {[=](Vec3 p) -> kerf_surface_point {
                const double dx = p.x - x, r = std::hypot(dx, p.y);
                return {radius - r, {-dx / r, -p.y / r, 0}, 0, 0};
            },
            reach};
}

struct Written {
    kerf_channel channel[KERF_MAX_CHANNELS]{};
    kerf_law law{sizeof(kerf_law), 0, channel, {}, {}};
    [[nodiscard]] double force(std::size_t c = 0) const {
        return law.count > c ? channel[c].k * std::max(0.0, channel[c].delta) : 0.0;
    }
};
Written written(const Contact& contact, std::size_t kept_free = 0) {
    Written w;
    Channels channels(w.law);
    contact.write(channels, 100, kept_free);
    return w;
}
/// What one point at the origin, which looks along +x, carries in that bone [N].
Written point_in(const Bone& bone, double inwards = 3e-3, double facing = 0.05) {
    ContactPoints points;
    points.add({}, {1, 0, 0}, stiffness, facing, 0);
    const kerf_bone_query query = bone.query();
    Contact contact(points);
    contact.query_bone(BoneQuery(query), inwards);
    return written(contact);
}

TEST(Contact, APointCarriesItsDepthHoweverFarDistancesGo) {
    for (const double reach : {0.28e-3, 0.5e-3, 2e-3})
        for (const double depth : {0.01e-3, 0.1e-3, 0.3e-3, 0.6e-3, 1.7e-3})
            EXPECT_NEAR(point_in(half_space({1, 0, 0}, -depth, reach)).force(), stiffness * depth, 1e-9)
                << reach << ", " << depth;
}

TEST(Contact, AskewItPushesAlongItsOwnNormal) {
    // k p a, p the depth along the bone's normal, over d: stiffness k a², depth p/a.
    for (const double degrees : {20.0, 45.0, 70.0}) {
        const double a = std::cos(degrees * pi / 180.0), b = std::sin(degrees * pi / 180.0), p = 0.6e-3;
        for (const double reach : {0.28e-3, 0.5e-3, 2e-3}) {
            const Written w = point_in(half_space({a, b, 0}, -p, reach));
            ASSERT_EQ(w.law.count, 1u);
            EXPECT_NEAR(w.force(), stiffness * p * a, 1e-9) << degrees << ", " << reach;
            EXPECT_NEAR(w.channel[0].k, stiffness * a * a, 1e-6) << degrees << ", " << reach;
            EXPECT_NEAR(w.channel[0].d[0], 1.0, 1e-12);
        }
    }
}

TEST(Contact, TheForceGrowsWithoutAJump) {
    // Nor where what is known by one place ends and another tells: in a hole, whose normal turns on the way.
    const double step = 1e-6;
    for (const double reach : {0.28e-3, 0.4e-3}) {
        double last = 0.0;
        for (double aside = 0.0; aside < 1.2e-3; aside += step) {
            ContactPoints points;
            points.add({1.55e-3 * 0.8, 1.55e-3 * 0.6, 0}, {0.8, 0.6, 0}, stiffness, 0.05, 0);
            const Bone bone = hole(1.6e-3, -aside, reach);
            const kerf_bone_query query = bone.query();
            Contact contact(points);
            contact.query_bone(BoneQuery(query), 1.6e-3);
            const double force = written(contact).force();
            EXPECT_LT(std::abs(force - last), 2.0 * stiffness * step) << reach << ", " << aside;
            last = force;
        }
        EXPECT_GT(last, 20.0) << "and it has grown";
    }
}

/// What a point of a shank carries [N] that is `aside` from the middle of its hole, and if `knows`, knows so.
double carried_aside(double aside, double reach, bool knows) {
    constexpr double shank = 1.55e-3, radius = 1.6e-3;
    ContactPoints points;
    points.add({shank, 0, 0}, {1, 0, 0}, stiffness, 0.05, 0);
    const Bone bone = hole(radius, -aside, reach);
    const kerf_bone_query query = bone.query();
    Contact contact(points);
    contact.query_bone(BoneQuery(query), radius);
    for (const Contact::DeepPoint& one : contact.deep())
        if (knows) contact.hold(one, aside - (radius - shank));
    return written(contact).force();
}

TEST(Contact, AWallThatIsLostLetsGoWithoutAJump) {
    constexpr double step = 2e-6;
    for (const double reach : {0.28e-3, 0.8e-3, 2e-3}) {
        double last = 0.0, held = 0.0;
        for (double aside = 0.0; aside < 3.5e-3; aside += step) {
            const double now = carried_aside(aside, reach, false), known = carried_aside(aside, reach, true);
            EXPECT_LT(std::abs(now - last), 6.0 * stiffness * step) << reach << ", " << aside;
            EXPECT_LT(std::abs(known - held), 2.0 * stiffness * step) << reach << ", " << aside;
            EXPECT_NEAR(known, stiffness * std::max(0.0, aside - 0.05e-3), 0.02 * stiffness * 1.6e-3)
                << reach << ", " << aside;
            last = now;
            held = known;
        }
        EXPECT_EQ(last, 0.0) << "and what has no wall is not held";
    }
}

TEST(Contact, AGapThatOpensInTheBoneBecomesAWallWithoutAJump) {
    constexpr double step = 1e-6, behind = 0.83e-3;
    double last = 0.0;
    for (double wide = -20e-6; wide < 0.4e-3;
         wide += step) {  // bone from far behind the point to its front, with a gap across
        const Bone bone{[=](Vec3 p) -> kerf_surface_point {
                            const double off = std::abs(p.x + behind) - 0.5 * wide;
                            return {wide > 0.0 ? -off : -1.0, {p.x + behind > 0.0 ? -1.0 : 1.0, 0, 0}, 0, 0};
                        },
                        0.8e-3};
        const double now = point_in(bone, 1.6e-3).force();
        EXPECT_LT(std::abs(now - last), 0.03 * stiffness * behind) << wide;
        last = now;
    }
    EXPECT_GT(last, 0.5 * stiffness * behind) << "a wall it is in the end";
}

TEST(Contact, AHoleHoldsAShankAsFirmlyOnEveryGrid) {
    const double aside = 0.9e-3, shank = 1.55e-3;
    std::optional<double> far;
    for (const double reach : {2e-3, 0.8e-3, 0.4e-3, 0.28e-3}) {
        const Bone bone = hole(1.6e-3, -aside, reach);
        const kerf_bone_query query = bone.query();
        ContactPoints points;
        for (std::size_t n = 0; n < 8; ++n) {
            const double angle = 2.0 * pi * static_cast<double>(n) / 8.0;
            const Vec3 out{std::cos(angle), std::sin(angle), 0};
            points.add(shank * out, out, stiffness, 0.05, 0);
        }
        Contact contact(points);
        contact.query_bone(BoneQuery(query), 1.6e-3);
        const Written w = written(contact);
        ASSERT_EQ(w.law.count, 1u) << reach;
        const double across = w.force() * w.channel[0].d[0];
        if (!far) far = across;
        EXPECT_NEAR(across, *far, 0.03 * *far) << reach;
        EXPECT_NEAR(w.channel[0].d[1], 0.0, 1e-9) << "as much to one side as to the other";
    }
}

TEST(Contact, AWallIsAsFirmWhateverLiesBehindIt) {
    // Bone of 0.5 mm: what is nearest to a point deep in it is its other side, and that faces away. (Within 0.1 mm of
    // it a point lets go.)
    for (const double reach : {0.28e-3, 0.5e-3, 2e-3})
        for (const double depth : {0.15e-3, 0.2e-3, 0.3e-3}) {
            const Bone wall{[=](Vec3 p) -> kerf_surface_point {
                                const double x = p.x + depth;  // from its near side on
                                return x < 0.25e-3 ? kerf_surface_point{-x, {-1, 0, 0}, 0, 0}
                                                   : kerf_surface_point{x - 0.5e-3, {1, 0, 0}, 0, 0};
                            },
                            reach};
            EXPECT_NEAR(point_in(wall).force(), stiffness * depth, 1e-9) << reach << ", " << depth;
        }
}

TEST(Contact, WhereNoWallIsInsideTheToolNothingIsCarried) {
    const Bone whole{[](Vec3) -> kerf_surface_point { return {-1.0, {1, 0, 0}, 0, 0}; }, 0.1e-3};
    EXPECT_EQ(point_in(whole, 1.0).law.count, 0u);
    EXPECT_LE(whole.asked, 33u) << "and it does not look for it for ever";
    // Nor where it lies deeper than the tool is thick, or faces the other way.
    EXPECT_EQ(point_in(half_space({1, 0, 0}, -1.0e-3, 0.2e-3), 0.5e-3).law.count, 0u);
    EXPECT_EQ(point_in(half_space({-1, 0, 0}, -1.0e-3, 0.2e-3), 3e-3).law.count, 0u);
}

TEST(Contact, APointIsAskedAboutOnceUnlessItIsDeep) {
    const Bone shallow = half_space({1, 0, 0}, -0.09e-3, 0.5e-3), deep = half_space({1, 0, 0}, -0.4e-3, 0.5e-3);
    static_cast<void>(point_in(shallow));
    EXPECT_EQ(shallow.asked, 1u);
    static_cast<void>(point_in(deep));
    EXPECT_LE(deep.asked, 17u);
}

TEST(Contact, OfMoreSlotsThanThereIsRoomForTheDeepestStay) {
    const Bone bone = half_space({1, 0, 0}, -0.1e-3, 2e-3);
    ContactPoints points;
    for (std::size_t slot = 0; slot < 5; ++slot)
        points.add({1e-5 * static_cast<double>(slot), 0, 0}, {1, 0, 0}, stiffness, 0.05, slot);
    const kerf_bone_query query = bone.query();
    Contact contact(points);
    contact.query_bone(BoneQuery(query), 1e-3);
    const Written all = written(contact), some = written(contact, KERF_MAX_CHANNELS - 2);
    EXPECT_EQ(all.law.count, 5u);
    ASSERT_EQ(some.law.count, 2u);
    EXPECT_EQ(some.channel[0].id, 103u);
    EXPECT_EQ(some.channel[1].id, 104u);
}

TEST(Contact, WhatIsKnownFromElsewhereCounts) {
    const Bone bone = half_space({1, 0, 0}, -0.1e-3, 2e-3);
    ContactPoints points;
    points.add({}, {1, 0, 0}, stiffness, 0.05, 0);
    const kerf_bone_query query = bone.query();
    Contact contact(points);
    contact.query_bone(BoneQuery(query), 1e-3);
    ASSERT_TRUE(contact.faces_bone(0));
    contact.set_depth(0, 0.02e-3);
    EXPECT_NEAR(written(contact).force(), stiffness * 0.02e-3, 1e-9);
}

}  // namespace
}  // namespace kerf
