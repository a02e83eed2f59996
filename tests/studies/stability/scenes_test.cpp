// SPDX-License-Identifier: Apache-2.0
// What the scenes see with Kerf's loop in them. For training and research; not for diagnosis, planning or deciding
// treatment.
#include "studies/stability/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/studies/stability/found_tool.h"

namespace kerf::stability {
namespace {

struct Found {
    std::vector<Finding> all;
    Report report = [this](const Finding& finding) { all.push_back(finding); };

    Found() = default;
    Found(const Found&) = delete;
    Found& operator=(const Found&) = delete;

    [[nodiscard]] int count(const std::string& scene, Method method, Outcome outcome) const {
        return static_cast<int>(std::count_if(all.begin(), all.end(), [&](const Finding& f) {
            return f.scene == scene && f.method == method && f.outcome == outcome;
        }));
    }
    void expect_that_kerf_passes() const {
        ASSERT_FALSE(all.empty());
        for (const Finding& f : all) {
            if (f.method == Method::kerf) {
                EXPECT_EQ(f.outcome, Outcome::pass) << f.scene << ": " << f.measured;
            }
        }
    }
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
    check_flat(nominal, found.report);
    const char* scene = "probe laid flat, points doubled";
    EXPECT_EQ(found.only(scene, Method::as_printed).outcome, Outcome::fail);
    EXPECT_NE(found.only(scene, Method::as_printed).measured.find(", 100 %"), std::string::npos);
    EXPECT_EQ(found.only(scene, Method::kerf).outcome, Outcome::pass) << found.only(scene, Method::kerf).measured;
    EXPECT_EQ(found.only(scene, Method::kerf).measured.find("0 N -> "), std::string::npos) << "and it touches";
}

TEST(Scenes, ASlowFeedIsNoiseAtTheDevicesRateAndQuietSolved) {
    Found found;
    check_noise(nominal, the_drill(), found.report);
    EXPECT_EQ(found.only("feed of 0.5 mm/s", Method::as_printed).outcome, Outcome::fail);
    found.expect_that_kerf_passes();
    EXPECT_EQ(found.count("hold still, +-1 count", Method::kerf, Outcome::pass), 2) << "led, and held by a hand";
}

TEST(Scenes, AFastHandTunnelsAsPrintedAndFeelsTheShellSolved) {
    Found found;
    check_tunnelling(nominal, the_drill(), found.report);
    const char* scene = "0.5 mm shell at 1 m/s";
    EXPECT_EQ(found.only(scene, Method::as_printed).outcome, Outcome::fail);
    EXPECT_EQ(found.only(scene, Method::kerf).outcome, Outcome::pass) << found.only(scene, Method::kerf).measured;
    const Finding& taken = found.only("0.5 mm shell at 1 m/s: bone taken", Method::kerf);
    EXPECT_EQ(taken.outcome, Outcome::pass) << taken.measured;
}

TEST(Scenes, NeitherTheGridNorABorderOnItsFacesIsFeltAsStepsInACreep) {
    Found found;
    const ToolUnderTest printed = the_papers_drill();
    check_creep(nominal, the_drill(), &printed, found.report);
    found.expect_that_kerf_passes();
    const char* scene = "creep over a border 10 : 1 on a face";
    EXPECT_EQ(found.count(scene, Method::kerf, Outcome::pass), 2);
    EXPECT_EQ(found.count(scene, Method::as_printed, Outcome::fail), 1) << "binary voxels, met by many points at once";
}

TEST(Scenes, ManyPointsGiveEnergyAsPrintedAndAreAsOneSolved) {
    Found found;
    check_many_contacts(nominal, found.report);
    const char* scene = "1 to 1000 points meet a plane at once";
    EXPECT_EQ(found.only(scene, Method::as_printed).outcome, Outcome::fail);
    EXPECT_EQ(found.only(scene, Method::kerf).outcome, Outcome::pass) << found.only(scene, Method::kerf).measured;
}

TEST(Scenes, TheLengthOfATickChangesNothing) {
    Found found;
    const std::vector<ToolUnderTest> papers{the_papers_drill(), the_papers_drill("volumetric_drilling"),
                                            the_papers_drill("dental_implant")};
    check_loop_rate(nominal, the_drill(), papers, found.report);
    found.expect_that_kerf_passes();
    for (const ToolUnderTest& paper : papers)
        EXPECT_EQ(std::count_if(found.all.begin(), found.all.end(),
                                [&](const Finding& f) { return f.reason.starts_with(paper.law); }),
                  9)
            << paper.law;
    EXPECT_EQ(found.count("loop rate, prescribed feed", Method::kerf, Outcome::pass), 9);
    EXPECT_EQ(found.count("loop rate, solved", Method::kerf, Outcome::pass), 9);
}

TEST(Scenes, WithoutThePapersTheirRowsSayWhy) {
    Found found;
    check_re_entry(nominal, the_drill(), nullptr, found.report);
    const Finding& as_printed = found.only("out of a hole and in again", Method::as_printed);
    EXPECT_EQ(as_printed.outcome, Outcome::not_applicable);
    EXPECT_NE(as_printed.reason.find("kerf_as_printed"), std::string::npos);
}

TEST(Scenes, MissedTicksAreNotRampedBackInto) {
    Found found;
    check_missed_ticks(nominal, found.report);
    ASSERT_EQ(found.all.size(), 12u);
    found.expect_that_kerf_passes();
    EXPECT_EQ(found.only("100 ticks missed, pressing on", Method::as_printed).outcome, Outcome::fail)
        << "a spring jumps to what it would be";
}

TEST(Scenes, AHoleIsEmptySolvedAndFullOfBoneAsPrinted) {
    Found found;
    const ToolUnderTest printed = the_papers_drill();
    check_re_entry(nominal, the_drill(), &printed, found.report);
    found.expect_that_kerf_passes();
    EXPECT_EQ(found.count("out of a hole and in again", Method::kerf, Outcome::pass), 2) << "led, and by a hand";
    EXPECT_EQ(found.only("out of a hole and in again", Method::as_printed).outcome, Outcome::fail);
}

TEST(Scenes, ABorderIsCrossedWithoutAStepAndPushesAsideAsGeometrySays) {
    Found found;
    const ToolUnderTest printed = the_papers_drill();
    check_border(nominal, the_drill(), &printed, found.report);
    found.expect_that_kerf_passes();
    const char* sideways = "border at 10 deg: force sideways";
    EXPECT_EQ(found.count(sideways, Method::kerf, Outcome::pass), 3);
    EXPECT_EQ(found.count(sideways, Method::as_printed, Outcome::fail), 3) << "sums without directions";
    EXPECT_EQ(found.count("border 10 : 1 at 0.5 mm/s, prescribed", Method::as_printed, Outcome::fail), 2)
        << "a step is as large at the slowest feed";
}

TEST(Scenes, ADrillThatIsSwitchedOffHandsOverSolvedAndChattersAsPrinted) {
    Found found;
    check_switching_off(nominal, the_drill(), found.report);
    found.expect_that_kerf_passes();
    EXPECT_EQ(found.only("switched off under a push", Method::as_printed).outcome, Outcome::fail);
}

TEST(Scenes, BehindAShellTheHandOvershootsAsAReleasedSpringDoes) {
    Found found;
    check_breakthrough(nominal, the_drill(), found.report);
    EXPECT_EQ(found.only("1 mm shell: overtravel of the hand", Method::kerf).outcome, Outcome::pass)
        << found.only("1 mm shell: overtravel of the hand", Method::kerf).measured;
    EXPECT_EQ(found.only("1 mm shell: force after clearing", Method::kerf).outcome, Outcome::pass)
        << found.only("1 mm shell: force after clearing", Method::kerf).measured;
}

TEST(Scenes, SkipsOvertravelWithoutHand) {
    Found found;
    check_breakthrough(only("premium-1.5-6dof", no_hand, 0), the_drill(), found.report);
    const Finding& overtravel = found.only("1 mm shell: overtravel of the hand", Method::kerf);
    EXPECT_EQ(overtravel.outcome, Outcome::not_applicable);
    EXPECT_FALSE(overtravel.reason.empty());
}

TEST(Scenes, AScrewTurnsInHoldsBacksOffAndStripsSolvedAndNoneOfThatDirectly) {
    Found found;
    check_screw(nominal, the_screw(), found.report);
    for (const char* scene : {"screw turned in", "screw held half way", "screw backed off by two turns",
                              "screw turned on until it strips"}) {
        EXPECT_EQ(found.only(scene, Method::kerf).outcome, Outcome::pass) << found.only(scene, Method::kerf).measured;
        EXPECT_EQ(found.only(scene, Method::as_printed).outcome, Outcome::fail) << scene;
    }
}

TEST(Scenes, ALeverCycleGivesNoWorkSolvedAndSomeAsPrinted) {
    Found found;
    check_lever(nominal, found.report);
    found.expect_that_kerf_passes();
    for (const char* scene : {"lever, a cycle at 1 x", "lever, a cycle at 0.01 x"})
        EXPECT_EQ(found.only(scene, Method::as_printed).outcome, Outcome::fail) << "on a device with torque";
}

}  // namespace
}  // namespace kerf::stability
