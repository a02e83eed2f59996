// SPDX-License-Identifier: Apache-2.0
// What the scenes see with Kerf's loop in them. For training and research; not for diagnosis, planning or deciding
// treatment.
#include "conformance/stability/scenes.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/conformance/stability/found_tool.h"

namespace kerf::stability {
namespace {

struct Found {
    std::vector<Finding> all;
    Report report = [this](const Finding& finding) { all.push_back(finding); };

    Found() = default;
    Found(const Found&) = delete;
    Found& operator=(const Found&) = delete;

    [[nodiscard]] const Finding& only(const std::string& scene, Method method) const {
        const Finding* found = nullptr;
        for (const Finding& f : all)
            if (f.scene == scene && f.method == method) found = &f;
        if (found == nullptr) throw std::runtime_error("nothing found on: " + scene);
        return *found;
    }
};

const Scope nominal = only("premium-1.5-6dof", test_hands[2], 0);

TEST(Scenes, TwiceThePointsAreTwiceTheForceAsPrintedAndTheSameSolved) {
    Found found;
    look_at_flat(nominal, found.report);
    const char* scene = "probe laid flat, points doubled";
    EXPECT_EQ(found.only(scene, Method::as_printed).outcome, Outcome::fail);
    EXPECT_NE(found.only(scene, Method::as_printed).measured.find(", 100 %"), std::string::npos);
    EXPECT_EQ(found.only(scene, Method::kerf).outcome, Outcome::pass) << found.only(scene, Method::kerf).measured;
    EXPECT_EQ(found.only(scene, Method::kerf).measured.find("0 N -> "), std::string::npos) << "and it touches";
}

TEST(Scenes, ASlowFeedIsNoiseAtTheDevicesRateAndQuietSolved) {
    Found found;
    look_at_noise(nominal, the_drill(), found.report);
    const char* scene = "feed of 0.5 mm/s";
    EXPECT_EQ(found.only(scene, Method::as_printed).outcome, Outcome::fail);
    EXPECT_EQ(found.only(scene, Method::kerf).outcome, Outcome::pass) << found.only(scene, Method::kerf).measured;
}

TEST(Scenes, AFastHandTunnelsAsPrintedAndFeelsTheShellSolved) {
    Found found;
    look_at_tunnelling(nominal, the_drill(), found.report);
    const char* scene = "0.5 mm shell at 1 m/s";
    EXPECT_EQ(found.only(scene, Method::as_printed).outcome, Outcome::fail);
    EXPECT_EQ(found.only(scene, Method::kerf).outcome, Outcome::pass) << found.only(scene, Method::kerf).measured;
    const Finding& taken = found.only("0.5 mm shell at 1 m/s: bone taken", Method::kerf);
    EXPECT_EQ(taken.outcome, Outcome::pass) << taken.measured;
}

TEST(Scenes, TheGridIsNotFeltInACreep) {
    Found found;
    look_at_creep(nominal, the_drill(), found.report);
    ASSERT_GE(found.all.size(), 2u);
    for (const Finding& f : found.all) EXPECT_EQ(f.outcome, Outcome::pass) << f.measured;
}

TEST(Scenes, ManyPointsGiveEnergyAsPrintedAndAreAsOneSolved) {
    Found found;
    look_at_many_contacts(nominal, found.report);
    const char* scene = "1 to 1000 points meet a plane at once";
    EXPECT_EQ(found.only(scene, Method::as_printed).outcome, Outcome::fail);
    EXPECT_EQ(found.only(scene, Method::kerf).outcome, Outcome::pass) << found.only(scene, Method::kerf).measured;
}

TEST(Scenes, TheLengthOfATickChangesNothing) {
    Found found;
    look_at_loop_rate(nominal, the_drill(), found.report);
    ASSERT_EQ(found.all.size(), 6u);
    for (const Finding& f : found.all) EXPECT_EQ(f.outcome, Outcome::pass) << f.measured;
}

TEST(Scenes, MissedTicksAreNotRampedBackInto) {
    Found found;
    look_at_missed_ticks(nominal, found.report);
    ASSERT_EQ(found.all.size(), 6u);
    for (const Finding& f : found.all) EXPECT_EQ(f.outcome, Outcome::pass) << f.measured;
}

TEST(Scenes, AHoleIsEmpty) {
    Found found;
    look_at_re_entry(nominal, the_drill(), found.report);
    ASSERT_EQ(found.all.size(), 1u);
    EXPECT_EQ(found.all[0].outcome, Outcome::pass) << found.all[0].measured;
}

TEST(Scenes, BehindAShellTheHandOvershootsAsAReleasedSpringDoes) {
    Found found;
    look_at_breakthrough(nominal, the_drill(), found.report);
    EXPECT_EQ(found.only("1 mm shell: overtravel of the hand", Method::kerf).outcome, Outcome::pass)
        << found.only("1 mm shell: overtravel of the hand", Method::kerf).measured;
    EXPECT_EQ(found.only("1 mm shell: force after clearing", Method::kerf).outcome, Outcome::pass)
        << found.only("1 mm shell: force after clearing", Method::kerf).measured;
}

TEST(Scenes, WithoutAHandNoOvertravelIsLookedFor) {
    Found found;
    look_at_breakthrough(only("premium-1.5-6dof", no_hand, 0), the_drill(), found.report);
    const Finding& overtravel = found.only("1 mm shell: overtravel of the hand", Method::kerf);
    EXPECT_EQ(overtravel.outcome, Outcome::not_applicable);
    EXPECT_FALSE(overtravel.reason.empty());
}

TEST(Scenes, ALeverCycleGivesNoWork) {
    Found found;
    look_at_lever(nominal, found.report);
    EXPECT_EQ(found.all[0].outcome, Outcome::pass) << found.all[0].measured;
}

}  // namespace
}  // namespace kerf::stability
