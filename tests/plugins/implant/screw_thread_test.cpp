// SPDX-License-Identifier: Apache-2.0
#include "plugins/implant/screw_thread.h"

#include <gtest/gtest.h>

#include <cmath>

#include "plugins/implant/thread_grip.h"
#include "tests/plugins/implant/screw_rig.h"
#include "tests/plugins/implant/weidling.h"

namespace kerf::implant {
namespace {

using namespace literals;

ScrewThread thread() {
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

TEST(ScrewThread, GoesItsLeadInATurn) {
    EXPECT_DOUBLE_EQ(2.0 * pi * thread().advance(), 3.0_mm);
    ScrewThread twice = thread();
    twice.starts = 2.0;
    EXPECT_DOUBLE_EQ(twice.lead(), 6.0_mm);
}

TEST(ScrewThread, ItsCoreTapersFromTipToHead) {
    EXPECT_DOUBLE_EQ(thread().core_at(0.0), 3.0_mm);
    EXPECT_DOUBLE_EQ(thread().core_at(-22.5_mm), 3.75_mm);
    EXPECT_DOUBLE_EQ(thread().core_at(-60.0_mm), 4.5_mm) << "behind the thread as at its end";
    EXPECT_DOUBLE_EQ(thread().mean_radius(-45.0_mm), 2.75_mm);
}

// Computed by hand: (6.5 − 4.5)/2 = 1 mm deep; 0.5 + 0.57735/3.
TEST(ScrewThread, StripsByItsShapeFactor) { EXPECT_NEAR(thread().shape_factor(-45.0_mm), 0.69245, 1e-9); }

TEST(ScrewThread, ItsPiecesLieOnItsHelixAndCoverIt) {
    ThreadPiece pieces[max_pieces];
    const ScrewThread t = thread();
    const int count = make_pieces(t, pieces);
    double covered = 0.0;
    for (int i = 0; i < count; ++i) {
        covered += pieces[i].length;
        const double z = pieces[i].point.z, turn = z / t.advance();
        EXPECT_NEAR(pieces[i].point.x, t.mean_radius(z) * std::cos(turn), 1e-12);
        EXPECT_NEAR(pieces[i].point.y, t.mean_radius(z) * std::sin(turn), 1e-12);
    }
    EXPECT_NEAR(covered, t.length - t.cone(), 1e-12);
    EXPECT_GE(count / ((t.length - t.cone()) / t.lead()), 8.0) << "in a turn";
}

TEST(ScrewThread, HasTheContactThatWasMeasured) {
    int close = 0;
    for (const auto& screw : test::weidling) {
        const ScrewThread t = test::thread_of(screw);
        const double contact = 25.0_mm * (t.core_contact(-t.length) + t.flank_contact(-t.length)),
                     off = std::abs(contact / screw.contact - 1.0);
        close += off < 0.05;
        EXPECT_LT(off, 0.15) << screw.name;
    }
    EXPECT_EQ(close, 10) << "of twelve within 5 %";
}

TEST(ThreadGrip, StretchesAndThenSlips) {
    double stretch = 0.1_mm;
    EXPECT_EQ(yield_plastically(stretch, 1e6, 500.0), 0.0);
    EXPECT_DOUBLE_EQ(stretch, 0.1_mm);
    stretch = 1.0_mm;  // 500 N stretch 0.5 mm
    EXPECT_DOUBLE_EQ(yield_plastically(stretch, 1e6, 500.0), 0.5_mm);
    EXPECT_DOUBLE_EQ(stretch, 0.5_mm);
    stretch = -1.0_mm;
    EXPECT_DOUBLE_EQ(yield_plastically(stretch, 1e6, 500.0), 0.5_mm) << "the other way";
    EXPECT_DOUBLE_EQ(stretch, -0.5_mm);
    EXPECT_DOUBLE_EQ(yield_plastically(stretch, 0.0, 0.0), 0.5_mm) << "nothing holds it";
}

TEST(ThreadGrip, ItsStrengthRisesToFullAndFallsToNothing) {
    const auto left = [](double slip) { return strength_left(slip, 0.85, 0.5_mm, 1.5_mm); };
    EXPECT_DOUBLE_EQ(left(0.0), 0.85);
    EXPECT_DOUBLE_EQ(left(0.25_mm), 0.925);
    EXPECT_DOUBLE_EQ(left(0.5_mm), 1.0);
    EXPECT_NEAR(left(1.25_mm), 0.5, 1e-12);
    EXPECT_EQ(left(2.0_mm), 0.0);
    EXPECT_EQ(left(9.0_mm), 0.0);
}

/// A bone of nothing but threads.
struct Threads {
    std::vector<kerf_thread> all;

    [[nodiscard]] ThreadTrack found(const ScrewThread& tool, std::uint32_t held = KERF_NEW_THREAD) const {
        kerf_bone_query query{};
        query.bone = reinterpret_cast<const kerf_bone*>(this);
        query.threads = [](const kerf_bone* bone, kerf_thread* out, std::uint32_t capacity) {
            const auto& threads = reinterpret_cast<const Threads*>(bone)->all;
            std::copy_n(threads.begin(), std::min<std::size_t>(threads.size(), capacity), out);
            return static_cast<std::uint32_t>(threads.size());
        };
        return ThreadTrack::found(BoneQuery(query), tool, held);
    }
};

/// Cut from the first crest on, 20 mm deep. The tool stands where it began.
kerf_thread groove(const ScrewThread& tool) {
    kerf_thread t = ThreadTrack::begun(tool, tool.first_crest(), 0).thread();
    t.to = t.from + 20.0_mm;
    t.number = 0;
    return t;
}

TEST(ThreadTrack, IsFoundByItsLeadItsPlaceAndItsAxis) {
    const auto is_found = [](const Pose& moved, double lead) {
        kerf_thread t = groove(thread());
        t.tool_from_thread = moved;
        t.lead = lead;
        return Threads{{t}}.found(thread()).is_there();
    };
    EXPECT_FALSE(Threads{}.found(thread()).is_there());
    EXPECT_TRUE(is_found(identity_pose(), 3.0_mm));
    EXPECT_FALSE(is_found(identity_pose(), 2.75_mm)) << "of another lead";
    EXPECT_TRUE(is_found({{1.0_mm, 0, 0}, {1, 0, 0, 0}}, 3.0_mm)) << "within the thread's depth";
    EXPECT_FALSE(is_found({{2.5_mm, 0, 0}, {1, 0, 0, 0}}, 3.0_mm)) << "beside it";
    EXPECT_TRUE(is_found({{}, quat_from_rotation_vector({5.0_deg, 0, 0})}, 3.0_mm));
    EXPECT_FALSE(is_found({{}, quat_from_rotation_vector({15.0_deg, 0, 0})}, 3.0_mm)) << "askew";
    EXPECT_TRUE(is_found({{0, 0, 2.5_mm}, {1, 0, 0, 0}}, 3.0_mm)) << "just before it";
    EXPECT_FALSE(is_found({{0, 0, 4.0_mm}, {1, 0, 0, 0}}, 3.0_mm)) << "not there yet";
}

TEST(ThreadTrack, IsTheNearestOfTwoWhicheverCameFirst) {
    kerf_thread near = groove(thread()), far = groove(thread());
    near.tool_from_thread.position = {0, -0.4_mm, 0};
    far.tool_from_thread.position = {0.9_mm, 0, 0};
    near.number = 7;
    far.number = 8;
    EXPECT_EQ((Threads{{near, far}}.found(thread()).thread().number), 7u);
    EXPECT_EQ((Threads{{far, near}}.found(thread()).thread().number), 7u);
}

TEST(ThreadTrack, IsTheOneThatTheToolIsInHoweverNearAnotherLies) {
    kerf_thread near = groove(thread()), held = groove(thread());
    held.tool_from_thread.position = {1.5_mm, 0, 0};
    near.number = 7;
    held.number = 8;
    EXPECT_EQ((Threads{{near, held}}.found(thread(), 8).thread().number), 8u);
}

TEST(ThreadTrack, ItsOffsetIsAcrossAtEveryHeight) {
    // A thread that leans by 0.01 about y, through the tool's axis 4 mm behind the tip
    kerf_thread t = groove(thread());
    const Quat lean = quat_from_rotation_vector({0, 0.01, 0});
    t.tool_from_thread = {{0, 0, -4.0_mm}, lean};
    const ThreadTrack track = Threads{{t}}.found(thread());
    EXPECT_NEAR(track.inclination().y, -0.01, 1e-5);
    EXPECT_NEAR(track.inclination().x, 0.0, 1e-12);
    EXPECT_NEAR(track.offset(-4.0_mm).x, 0.0, 1e-12);
    EXPECT_NEAR(track.offset(0.0).x, -0.04_mm, 1e-8);
    EXPECT_NEAR(track.offset(-14.0_mm).x, 0.1_mm, 1e-8);
}

TEST(ThreadTrack, OfAnotherLeadIsCrossed) {
    kerf_thread t = groove(thread());
    t.lead = 2.0_mm;
    t.tool_from_thread.position.z = -5.0_mm;  // the tool is 5 mm deep in it
    EXPECT_TRUE(Threads{{t}}.found(thread()).is_crossed());
    t.lead = thread().lead();
    EXPECT_FALSE(Threads{{t}}.found(thread()).is_crossed());
}

TEST(ThreadTrack, SlipsInItsBinsAlone) {
    ThreadTrack track = ThreadTrack::begun(thread(), thread().first_crest(), 0);
    const double from = track.thread().from;
    track.add_slip(from + 10.0_mm, from + 20.0_mm, 0.3_mm);
    EXPECT_EQ(track.slip_at(from + 5.0_mm), 0.0);
    EXPECT_DOUBLE_EQ(track.slip_at(from + 15.0_mm), 0.3_mm);
    EXPECT_EQ(track.slip_at(from + 30.0_mm), 0.0);
    EXPECT_DOUBLE_EQ(track.slip_at(1.0), 0.0) << "far behind its end: the last bin";
}

TEST(ThreadTrack, SaysHowTheToolLiesToIt) {
    kerf_thread t = groove(thread());
    t.tool_from_thread = {{0.2_mm, -0.1_mm, 0}, quat_from_rotation_vector({0.01, 0, 0})};
    ThreadTrack track = Threads{{t}}.found(thread());
    EXPECT_NEAR(track.inclination().x, -0.01, 1e-5) << "the thread is turned about +x, so the tool is about −x";
    EXPECT_NEAR(track.offset(0.0).x, -0.2_mm, 1e-9);
    EXPECT_NEAR(track.offset(0.0).y, 0.1_mm, 1e-9);
    EXPECT_NEAR(track.offset(-10.0_mm).y, 0.1_mm - 0.1_mm, 1e-7) << "10 mm × 0.01";
    const Vec3 offset = track.offset(-10.0_mm), inclination = track.inclination();
    track.yield_plastically(offset, inclination, -10.0_mm);
    track = Threads{{track.thread()}}.found(thread());
    EXPECT_NEAR(length(track.offset(-10.0_mm)), 0.0, 1e-9) << "it gave way by all of it";
    EXPECT_NEAR(length(track.inclination()), 0.0, 1e-4);
}

TEST(ThreadTrack, KnowsHowMuchATapTook) {
    kerf_thread t = groove(thread());
    EXPECT_EQ(Threads{{t}}.found(thread()).fraction_tapped(t.from, 3.25_mm, 2.25_mm), 0.0) << "no tap was there";
    t.tapped_to = t.from + 10.0_mm;
    t.tapped_radius = 2.75_mm;
    const ThreadTrack track = Threads{{t}}.found(thread());
    EXPECT_NEAR(track.fraction_tapped(t.from + 5.0_mm, 3.25_mm, 2.25_mm), 0.5, 1e-12);
    EXPECT_EQ(track.fraction_tapped(t.from + 11.0_mm, 3.25_mm, 2.25_mm), 0.0);
    EXPECT_EQ(track.fraction_tapped(t.from, 2.5_mm, 2.25_mm), 1.0) << "a wider tap";
}

}  // namespace
}  // namespace kerf::implant
