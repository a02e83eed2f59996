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
            .core = 4.5_mm,
            .core_at_tip = 3.0_mm,
            .pitch = 3.0_mm,
            .starts = 1.0,
            .length = 45.0_mm,
            .flank_angle = 15.0_deg,
            .flutes = 2.0,
            .flute_length = 6.0_mm,
            .head = 10.0_mm};
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
    ThreadPiece pieces[most_pieces];
    const ScrewThread t = thread();
    const int count = make_pieces(t, pieces);
    double covered = 0.0;
    for (int i = 0; i < count; ++i) {
        covered += pieces[i].length;
        const double z = pieces[i].place.z, turn = z / t.advance();
        EXPECT_NEAR(pieces[i].place.x, t.mean_radius(z) * std::cos(turn), 1e-12);
        EXPECT_NEAR(pieces[i].place.y, t.mean_radius(z) * std::sin(turn), 1e-12);
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
    ThreadGrip grip;
    grip.move(0.1_mm, 1e6, 500.0);
    EXPECT_DOUBLE_EQ(grip.stretch, 0.1_mm);
    EXPECT_EQ(grip.slip, 0.0);
    grip.move(0.9_mm, 1e6, 500.0);  // 500 N stretch 0.5 mm
    EXPECT_DOUBLE_EQ(grip.stretch, 0.5_mm);
    EXPECT_DOUBLE_EQ(grip.slip, 0.5_mm);
    grip.move(-1.5_mm, 1e6, 500.0);
    EXPECT_DOUBLE_EQ(grip.stretch, -0.5_mm) << "the other way";
    EXPECT_DOUBLE_EQ(grip.slip, 1.0_mm);
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

TEST(BesideHole, IsElsewhereAsideOrTilted) {
    BesideHole beside;
    beside.move({1e-3, 0, -1.0, 0, 0, 5.0}, 1.0);
    EXPECT_FALSE(beside.is_elsewhere(3.0_mm)) << "along and about its shaft it stays over its hole";
    beside.move({3e-3, 0, 0, 0, 0, 0}, 1.0);
    EXPECT_TRUE(beside.is_elsewhere(3.0_mm));
    BesideHole tilted;
    tilted.move({0, 0, 0, 0.3, 0, 0}, 1.0);
    EXPECT_TRUE(tilted.is_elsewhere(3.0_mm));
}

TEST(PedicleScrew, RefusesWhatCannotBeMade) {
    const auto refusal = [](const std::map<std::string, double>& set) {
        ToolOutline outline;
        std::string error;
        return outline_of(test::screw(set), outline, error) ? std::string() : error;
    };
    EXPECT_EQ(refusal({}), "");
    EXPECT_NE(refusal({{"core_diameter", 7.0_mm}}).find("`core_diameter` is 7 mm; it needs less than `outer_diameter`"),
              std::string::npos);
    EXPECT_NE(refusal({{"tip_core_diameter", 5.0_mm}}).find("`tip_core_diameter` is 5 mm"), std::string::npos);
    EXPECT_NE(refusal({{"head_diameter", 6.0_mm}}).find("could not seat"), std::string::npos);
    EXPECT_NE(refusal({{"thread_length", 7.0_mm}}).find("two turns"), std::string::npos);
}

}  // namespace
}  // namespace kerf::implant
