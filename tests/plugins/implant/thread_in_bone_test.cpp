// SPDX-License-Identifier: Apache-2.0
// A thread stays in bone when the tool that cut it leaves: what a tap, a screw and another screw find there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/plugins/implant/screw_rig.h"

namespace kerf {
namespace {

using namespace literals;
using test::at_depth;
using Parameters = std::map<std::string, double>;

constexpr double fast = 4.0 * pi;  // [rad/s]

Tool tool(const char* id, const Parameters& set) {
    const ToolSetup setup = test::threaded(id, set);
    return {setup, test::outline(setup)};
}

/// Tools in turn at one hole, along its axis.
class Hole {
public:
    Hole(double density, double radius, std::vector<Tool> tools)
        : body_(test::pilot_block(density, 45.0_mm, radius)),
          simulation_(body_, std::move(tools), test::gains(), at_depth(-0.5_mm)) {
        begin();
    }
    void take(std::size_t tool) {
        simulation_.take_tool(tool);
        begin();
    }
    /// Turns by so many turns, along the thread. Returns the largest torque.
    double turn(double turns) {
        const double advance = simulation_.outline().thread_lead / (2.0 * pi);
        const int ticks = static_cast<int>(std::ceil(std::abs(turns) * 2.0 * pi / (fast * Simulation::dt)));
        double largest = 0.0;
        for (int i = 0; i < ticks; ++i) {
            const double by = 2.0 * pi * turns / ticks;
            angle_ += by;
            tick(depth_ += advance * by);
            largest = std::max(largest, signals().torque);
        }
        return largest;
    }
    /// Pulls straight, by so much; negative: pushes.
    void pull(double by) {
        const double step = by > 0.0 ? 10e-6 : -10e-6;
        for (double pulled = 0.0; std::abs(pulled) < std::abs(by); pulled += step) tick(depth_ -= step);
    }
    /// Puts the tool beside its place, out of bone.
    void shift(double by) {
        aside_ += by;
        leave();
        enter();
    }
    void leave() {
        for (int i = 0; i < 800; ++i) tick(depth_ -= 20e-6);
    }
    [[nodiscard]] const std::vector<std::uint64_t>& sequences() const { return sequences_; }
    [[nodiscard]] implant::ScrewInsertion::Signals signals() const {
        return signals_of<implant::ScrewInsertion>(simulation_.signals());
    }
    [[nodiscard]] const BodyThreads& threads() const { return simulation_.threads(); }
    [[nodiscard]] Simulation& simulation() { return simulation_; }
    [[nodiscard]] const std::vector<std::string>& events() const { return events_; }

private:
    void begin() {
        angle_ = 0.0;
        enter();
    }
    /// Puts the tip in, until the first crest is at the face.
    void enter() {
        const double cone = simulation_.setup().tool_parameters[3];  // as long as its core is wide
        for (depth_ = -0.5_mm; depth_ < cone;) tick(depth_ += 20e-6);
    }
    void tick(double depth) {
        const TickResult tick = simulation_.tick_direct({test::turned_at(depth, angle_, {aside_, 0, 0})});
        for (std::size_t e = 0; e < tick.event_count; ++e) events_.emplace_back(tick.events[e]);
        for (const CutRecord& record : simulation_.closed()) sequences_.push_back(record.sequence);
    }

    Body body_;
    Simulation simulation_;
    double depth_ = 0.0, angle_ = 0.0, aside_ = 0.0;
    std::vector<std::string> events_;
    std::vector<std::uint64_t> sequences_;
};

/// The screw of [kuklo-2003], and its taps: cores as wide as the hole.
const Parameters thoracic = {{"outer_diameter", 5.0_mm},
                             {"core_diameter", 3.2_mm},
                             {"tip_core_diameter", 3.2_mm},
                             {"pitch", 2.5_mm},
                             {"thread_length", 30.0_mm}};

double torque_after_tap(double tap_diameter) {
    Parameters tap = thoracic;
    if (tap_diameter > 0.0) tap["outer_diameter"] = tap_diameter;
    Hole hole(250.0, 1.6_mm, {tool("pedicle_screw", thoracic), tool("tap", tap)});
    if (tap_diameter > 0.0) {
        hole.take(1);
        hole.turn(9.0);
        hole.turn(-9.5);
        hole.take(0);
    }
    return hole.turn(8.0);
}

// Kuklo 2003: 0.295 N·m after a tap 1 mm too thin, 0.153 N·m after one as wide as the screw.
TEST(TappedHole, TakesLessTorqueTheWiderTheTap) {
    const double none = torque_after_tap(0.0), thin = torque_after_tap(4.0_mm), thick = torque_after_tap(5.0_mm);
    EXPECT_LT(thin, none);
    EXPECT_LT(thick, thin);
    EXPECT_NEAR(thin / thick, 1.93, 0.25);
}

TEST(TappedHole, IsOneThreadThatTheScrewGoesOnWith) {
    Parameters tap = thoracic;
    tap["outer_diameter"] = 4.0_mm;
    Hole hole(250.0, 1.6_mm, {tool("tap", tap), tool("pedicle_screw", thoracic)});
    hole.turn(4.0);
    ASSERT_EQ(hole.threads().count(), 1u);
    const kerf_thread tapped = hole.threads().thread(0);
    EXPECT_NEAR(tapped.to - tapped.from, 4.0 * 2.5_mm, 0.2_mm);
    EXPECT_EQ(tapped.tapped_to, tapped.to);
    EXPECT_DOUBLE_EQ(tapped.tapped_radius, 2.0_mm);
    hole.turn(-4.5);
    hole.take(1);
    hole.turn(6.0);
    ASSERT_EQ(hole.threads().count(), 1u) << "no other thread";
    const kerf_thread& screwed = hole.threads().thread(0);
    EXPECT_NEAR(screwed.to - screwed.from, 6.0 * 2.5_mm, 0.2_mm);
    EXPECT_NEAR(screwed.tapped_to, tapped.tapped_to, 1e-9) << "as far as the tap went";
    EXPECT_DOUBLE_EQ(screwed.radius, 2.5_mm);
}

// The groove is a triangle, one for each turn: its area × the helix' length.
TEST(ThreadInBone, CountsTheGrooveApart) {
    Hole hole(250.0, 1.6_mm, {tool("pedicle_screw", thoracic)});
    hole.turn(6.0);
    const double depth = 0.9_mm, area = depth * depth * std::tan(15.0_deg), around = 2.0 * pi * 2.05_mm;
    const double wanted = 6.0 * std::hypot(around, 2.5_mm) * area;
    EXPECT_NEAR(hole.threads().volume() / wanted, 1.0, 0.05);
    const double removed = hole.simulation().present().removed();
    EXPECT_LT(removed, 0.2 * wanted) << "the core runs in its hole, and the field knows of no groove";
}

TEST(ThreadInBone, PulledStraightStripsAndItsBoneIsCut) {
    Hole hole(250.0, 1.6_mm, {tool("pedicle_screw", thoracic)});
    hole.turn(6.0);
    const double before = hole.simulation().present().removed(), strength = hole.signals().pull_out;
    EXPECT_GT(strength, 50.0);
    hole.pull(0.4_mm);
    EXPECT_GT(hole.signals().pull_out, 0.9 * strength) << "it yields, and holds";
    hole.pull(3.0_mm);
    EXPECT_EQ(hole.events().back(), "implant.stripped");
    EXPECT_EQ(hole.signals().pull_out, 0.0);
    const double ring = pi * (2.5_mm * 2.5_mm - 1.6_mm * 1.6_mm);
    EXPECT_GT(hole.simulation().present().removed() - before, 0.8 * ring * 12.0_mm) << "what was between the crests";
}

// The slip is the bone's: another screw in the same hole finds what the first one left.
TEST(ThreadInBone, HoldsAnotherScrewAsLittleAsTheFirst) {
    Hole hole(250.0, 1.6_mm, {tool("pedicle_screw", thoracic), tool("pedicle_screw", thoracic)});
    hole.turn(6.0);
    const double whole = hole.signals().pull_out;
    hole.pull(1.1_mm);
    const double left = hole.signals().pull_out / whole;
    EXPECT_LT(left, 0.8);
    EXPECT_GT(left, 0.3);
    hole.turn(-7.0);
    hole.take(1);
    hole.turn(6.0);
    EXPECT_NEAR(hole.signals().pull_out / whole, left, 0.12);
}

TEST(ThreadInBone, IsCrossedByOneOfAnotherLead) {
    Parameters tap = thoracic;
    tap["outer_diameter"] = 4.0_mm;
    tap["pitch"] = 1.75_mm;
    Hole hole(250.0, 1.6_mm, {tool("tap", tap), tool("pedicle_screw", thoracic)});
    hole.turn(6.0);
    hole.turn(-6.5);
    hole.take(1);
    hole.turn(3.0);
    EXPECT_EQ(std::count(hole.events().begin(), hole.events().end(), "implant.cross_threaded"), 1);
}

TEST(ThreadInBone, IsNoneWhereAScrewIsOnlyPushed) {
    Parameters wide = thoracic;
    Hole hole(250.0, 1.6_mm, {tool("pedicle_screw", wide)});
    hole.pull(-2.0_mm);
    EXPECT_EQ(hole.threads().count(), 0u);
    EXPECT_EQ(hole.signals().pull_out, 0.0) << "nothing holds it back";
}

TEST(ThreadInBone, OfCrestsThatWerePushedInIsCutByAWholeTurn) {
    Hole hole(250.0, 1.6_mm, {tool("pedicle_screw", thoracic)});
    hole.pull(-2.4_mm);
    hole.turn(0.03);
    const double begun = hole.signals().pull_out;
    hole.turn(1.2);
    EXPECT_GT(hole.signals().pull_out, 2.0 * begun) << "ten degrees cut next to nothing";
}

TEST(ThreadInBone, IsNoneOnceAScrewIsPushedThroughByMoreThanItsPitch) {
    Hole hole(250.0, 1.6_mm, {tool("pedicle_screw", thoracic)});
    hole.pull(-2.4_mm);
    const double before = hole.simulation().present().removed();
    hole.pull(-5.6_mm);
    const double crests = pi * (2.5_mm * 2.5_mm - 1.6_mm * 1.6_mm) * 5.6_mm;
    EXPECT_GT(hole.simulation().present().removed() - before, 0.5 * crests)
        << "the bone between its crests is sheared off";
    hole.turn(0.03);
    EXPECT_LT(hole.signals().pull_out, 30.0);
}

TEST(ThreadInBone, TakesNoCrestsOfOtherBoneForWhatItWasPushedThroughBefore) {
    const auto removed_beside = [](double pushed_before) {
        Hole hole(250.0, 1.6_mm, {tool("pedicle_screw", thoracic)});
        hole.pull(-pushed_before);
        hole.leave();
        hole.shift(5.0_mm);
        const double before = hole.simulation().present().removed();
        hole.pull(-1.0_mm);
        return hole.simulation().present().removed() - before;
    };
    EXPECT_NEAR(removed_beside(8.0_mm), removed_beside(0.0), 1e-9) << "1 mm³: it starts anew once it has left bone";
}

TEST(ThreadInBone, SaysThatItsHeadSeatsEvenIfItHasSlippedBefore) {
    Parameters brief = thoracic;
    brief["thread_length"] = 14.0_mm;
    Hole hole(700.0, 1.6_mm, {tool("pedicle_screw", brief)});
    hole.turn(3.0);
    hole.pull(0.4_mm);
    hole.turn(2.0);
    EXPECT_EQ(std::count(hole.events().begin(), hole.events().end(), "implant.yield"), 1);
    EXPECT_EQ(std::count(hole.events().begin(), hole.events().end(), "implant.head_contact"), 1);
}

// Channels 5 and 6 hold the tool's axis on the thread's, 7 and 8 its direction with a lever of 10 mm. A positive
// stretch pushes against the channel's direction: back.
TEST(ThreadInBone, PushesAToolBackToItsAxis) {
    constexpr double aside = 1e-6, tilt = 1e-4;  // [m], [rad]
    test::ScrewRig rig(400.0);
    rig.insert(2.0, 16.0 * pi);
    const Pose inserted = rig.rig().world_from_tool();
    const auto channels_at = [&](const Pose& at) {
        (void)rig.rig().tick_direct({at});
        std::map<std::uint32_t, kerf_channel> by_id;
        for (const kerf_channel& one : test::law_now(rig.rig())) by_id[one.id] = one;
        return by_id;
    };
    const auto held = [&](Vec3 moved, Vec3 turned) {
        const auto before = channels_at(inserted);
        auto after = channels_at({inserted.position + rotate(inserted.rotation, moved),
                                  inserted.rotation * quat_from_rotation_vector(turned)});
        for (std::uint32_t id = 5; id <= 8; ++id) after[id].delta -= before.at(id).delta;
        return after;
    };
    const auto x = held({aside, 0, 0}, {}), y = held({0, aside, 0}, {});
    EXPECT_NEAR(x.at(5).delta, aside, 0.02 * aside);
    EXPECT_NEAR(x.at(6).delta, 0.0, 0.02 * aside);
    EXPECT_NEAR(y.at(6).delta, aside, 0.02 * aside);
    EXPECT_NEAR(y.at(5).delta, 0.0, 0.02 * aside);
    // Turned about the tip, the thread's middle at z < 0 moves by turn × (0, 0, z).
    const auto about_x = held({}, {tilt, 0, 0}), about_y = held({}, {0, tilt, 0});
    const double middle = about_y.at(5).d[4];
    EXPECT_LT(middle, -(3.0_mm));
    EXPECT_NEAR(about_x.at(6).d[3], -middle, 1e-5);
    EXPECT_NEAR(about_x.at(6).delta, -tilt * middle, 0.02 * tilt * std::abs(middle));
    EXPECT_NEAR(about_y.at(5).delta, tilt * middle, 0.02 * tilt * std::abs(middle));
    EXPECT_NEAR(about_x.at(7).delta, tilt * 10.0_mm, 0.02 * tilt * 10.0_mm);
    EXPECT_NEAR(about_y.at(8).delta, tilt * 10.0_mm, 0.02 * tilt * 10.0_mm);
    EXPECT_EQ(about_x.at(7).d[3], 10.0_mm);
    EXPECT_EQ(about_y.at(8).d[4], 10.0_mm);
}

TEST(ThreadInBone, IsAnotherOneBesideTheFirst) {
    Hole hole(250.0, 1.6_mm, {tool("pedicle_screw", thoracic)});
    hole.turn(4.0);
    hole.turn(-5.0);
    hole.shift(1.3_mm);
    hole.turn(3.0);
    EXPECT_EQ(hole.threads().count(), 2u);
}

TEST(ThreadInBone, IsGoneWithTheCutThatIsTakenBackAndComesAgainWithIt) {
    Hole hole(250.0, 1.5_mm, {tool("pedicle_screw", thoracic)});
    hole.turn(4.0);
    hole.turn(-5.0);
    hole.leave();
    ASSERT_EQ(hole.threads().count(), 1u);
    ASSERT_EQ(hole.simulation().undo(), "");
    while (hole.simulation().undo().empty()) continue;  // it may have been clear of the bone in its hole
    EXPECT_EQ(hole.simulation().present().removed(), 0.0) << "all of it";
    EXPECT_EQ(hole.threads().count(), 0u);
    while (hole.simulation().redo().empty()) continue;
    EXPECT_EQ(hole.threads().count(), 1u);
}

// What a tick removes is told to those who watch, also in the tick that strips.
TEST(ThreadInBone, LosesNoRecordWhenItStrips) {
    Hole hole(250.0, 1.55_mm, {tool("pedicle_screw", thoracic)});
    hole.turn(5.0);
    hole.pull(4.0_mm);
    ASSERT_EQ(hole.events().back(), "implant.stripped");
    ASSERT_FALSE(hole.sequences().empty());
    for (std::size_t i = 0; i < hole.sequences().size(); ++i) EXPECT_EQ(hole.sequences()[i], i);
}

/// How far a screw that is started 6° askew is from the hole's axis after some turns [rad].
double drift(bool is_tapped) {
    const Parameters set = {{"outer_diameter", 5.0_mm},
                            {"core_diameter", 2.8_mm},
                            {"tip_core_diameter", 2.6_mm},
                            {"pitch", 2.5_mm},
                            {"thread_length", 30.0_mm}};
    Parameters tap = set;
    tap["outer_diameter"] = 4.5_mm;
    const Body body = test::pilot_block(250.0, 45.0_mm, 1.6_mm);
    Simulation simulation(body, {tool("tap", tap), tool("pedicle_screw", set)}, in_hands(test::gains()),
                          at_depth(-1.0_mm));
    double depth = -1.0_mm;
    const auto go = [&](double turns, double tilt) {
        const int ticks = static_cast<int>(std::abs(turns) * 500.0);
        for (int i = 1; i <= ticks; ++i) {
            const double angle = 2.0 * pi * turns * i / ticks;
            depth += 2.5_mm * turns / ticks;
            Pose pose = at_depth(depth, tilt);
            pose.rotation = pose.rotation * quat_from_rotation_vector({0, 0, std::remainder(angle, 2.0 * pi)});
            static_cast<void>(simulation.tick({pose}));
        }
    };
    // A loose hand: it turns the driver where that stands, and goes with it.
    const auto follow = [&](double turns) {
        const int ticks = static_cast<int>(turns * 500.0);
        const Pose step{{0, 0, 2.5_mm * turns / ticks}, quat_from_rotation_vector({0, 0, 2.0 * pi * turns / ticks})};
        for (int i = 0; i < ticks; ++i) static_cast<void>(simulation.tick({simulation.world_from_tool() * step}));
    };
    const auto push = [&](double to, double tilt) {
        for (; depth < to; depth += 4e-6) static_cast<void>(simulation.tick({at_depth(depth, tilt)}));
    };
    if (is_tapped) {
        push(2.4_mm, 0.0);
        go(5.0, 0.0);
        go(-6.5, 0.0);
        for (; depth > -2.0_mm; depth -= 10e-6) static_cast<void>(simulation.tick({at_depth(depth)}));
    }
    simulation.take_tool(1);
    depth = -2.0_mm;
    constexpr double inclination = 6.0 * pi / 180.0;
    push(2.4_mm, inclination);
    follow(4.0);
    const Vec3 along = rotate(simulation.world_from_tool().rotation, {0, 0, 1});
    return std::acos(std::min(1.0, -along.z));
}

TEST(ThreadInBone, LeadsAScrewThatIsStartedAskewBetterOnceItIsTapped) {
    const double untapped = drift(false), tapped = drift(true);
    EXPECT_GT(untapped, 1.0_deg) << untapped / 1.0_deg;
    EXPECT_LT(tapped, 0.7 * untapped) << tapped / 1.0_deg << " of " << untapped / 1.0_deg;
}

}  // namespace
}  // namespace kerf
