// SPDX-License-Identifier: Apache-2.0
// Slips of the torque law of [dental-implant-2013], each next to the screw's law of plugins/implant in the same
// situation.
#include "studies/papers/as_printed/implant_torque.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/studies/papers/as_printed/printed_rig.h"
#include "tests/support/turned_screw.h"

namespace kerf::as_printed {
namespace {

using namespace literals;
using test::TurnedScrew;

constexpr double turn = 2.0 * pi;          // [rad]
constexpr double one_a_second = 2.0 * pi;  // [rad/s]

/// An implant of 4 mm with 5 turns of thread, 1 mm apart, above bone of 1 g/cm³. K D r of an element is 6.25e-4 × 1000
/// × 0.002 = 1.25 N·mm, that of a turn of 16 elements 20 N·mm.
constexpr double of_a_turn = 20.0_Nmm;

struct Screwing {
    Body body;
    ToolSetup setup;
    std::unique_ptr<Simulation> simulation;
    double period, seat, angle = 0.0;
    TickResult last;

    explicit Screwing(const std::map<std::string, double>& set = {}, double rate = 1000.0, double thickness = 12.0_mm,
                      double density = 1000.0)
        : body(test::block({-6.0_mm, -6.0_mm, -thickness}, {6.0_mm, 6.0_mm, 0}, 0.5_mm, {0.31, 0.17, 0.73})),
          period(1.0 / rate) {
        body.materials[0].density = density;
        std::map<std::string, double> with{{"thread_length", 5.0_mm}};
        with.insert(set.begin(), set.end());
        setup.tool = test::printed_plugins().find("papers.as_printed", KERF_KIND_TOOL, "paper_implant");
        setup.force = test::printed_plugins().find("papers.as_printed", KERF_KIND_FORCE, "implant_torque");
        for (const auto& info : test::printed_plugins().catalog()) {
            if (info.id == "paper_implant") setup.tool_parameters = test::values(info.parameters, with);
            if (info.id == "implant_torque") setup.force_parameters = test::values(info.parameters, with);
        }
        const auto implant = value_of<PaperImplant>(setup.tool_parameters);
        seat = implant.thread_length + implant.neck_length;
        simulation = std::make_unique<Simulation>(body, setup, test::outline(setup), test::gains(), pose(), period);
        tick();  // at rest, just above the bone
    }
    /// Along its thread, 1 mm a turn, until the head is on the bone; then on the spot.
    [[nodiscard]] Pose pose() const {
        Pose pose = test::at_depth(std::min(seat, angle / turn * 1.0_mm));
        pose.rotation = pose.rotation * quat_from_rotation_vector({0, 0, std::remainder(angle, turn)});
        return pose;
    }
    void tick() { last = simulation->tick_direct({pose()}); }
    void turn_by(double by) {
        const auto ticks = static_cast<int>(std::lround(by / (one_a_second * period)));
        for (int i = 0; i < ticks; ++i) {
            angle += by / ticks;
            tick();
        }
    }
    void rest(double seconds) {
        for (double t = 0.5 * period; t < seconds; t += period) tick();
    }
    [[nodiscard]] ImplantTorque::Signals signals() const { return signals_of<ImplantTorque>(simulation->signals()); }
    [[nodiscard]] TorqueMode mode() const { return static_cast<TorqueMode>(static_cast<int>(signals().mode)); }
    [[nodiscard]] double torque() const { return signals().torque; }
};

constexpr double fast = 4.0 * pi;  // [rad/s]

/// Our screw with its head on the bone.
std::unique_ptr<TurnedScrew> seated(double thickness = 55.0_mm, std::map<std::string, double> set = {}) {
    set.insert({"thread_length", 25.0_mm});
    auto screw = std::make_unique<TurnedScrew>(
        test::ScrewScene{.density = 250.0, .set = std::move(set), .thickness = thickness});
    screw->insert(6.0, fast);
    screw->tighten(1.0, 0.5 * pi);
    return screw;
}

TEST(ImplantTorque, RisesEvenlyWithEachTurnOfThread) {  // 02-10, 02-14
    Screwing implant;
    const double element = of_a_turn / 16.0;
    for (int turns = 1; turns <= 4; ++turns) {
        implant.turn_by(turn);
        EXPECT_NEAR(implant.torque(), turns * of_a_turn, element * 1.001) << "one element more or less";
        EXPECT_EQ(implant.mode(), TorqueMode::insertion);
        EXPECT_NEAR(implant.last.torque, implant.torque(), 1e-12) << "the hand feels what the signal records";
    }
    EXPECT_FALSE(implant.last.is_cutting);
}

TEST(ImplantTorque, TighteningIsContinuousAtBothEnds) {  // 02-11, equations 15 to 17
    constexpr double k = 3.0, s = 0.5;
    EXPECT_EQ(contact_stiffness(k, s, TorqueMode::insertion, 0.0), 3.0);
    EXPECT_EQ(contact_stiffness(k, s, TorqueMode::tightening, 0.0), 3.0);
    EXPECT_DOUBLE_EQ(contact_stiffness(k, s, TorqueMode::tightening, 2.0), 6.0);
    EXPECT_DOUBLE_EQ(contact_stiffness(k, s, TorqueMode::tightening, turn), 3.0 * (1.0 + pi));
    EXPECT_DOUBLE_EQ(contact_stiffness(k, s, TorqueMode::stripping, turn), 3.0 * (1.0 + pi));
}

TEST(ImplantTorque, FollowsTheModesOfFigureFour) {  // 02-13
    using enum TorqueMode;
    EXPECT_EQ(next_mode(insertion, 79, 80, 0.0), insertion) << "one element in a void, or through the far cortex";
    EXPECT_EQ(next_mode(insertion, 80, 80, 0.0), tightening);
    EXPECT_EQ(next_mode(tightening, 80, 80, 0.99 * turn), tightening);
    EXPECT_EQ(next_mode(tightening, 80, 80, turn), stripping);
    EXPECT_EQ(next_mode(tightening, 0, 80, 1.0), tightening) << "figure 4 has no way back from there";
    EXPECT_EQ(next_mode(stripping, 1, 80, turn), stripping);
    EXPECT_EQ(next_mode(stripping, 0, 80, turn), insertion);
    EXPECT_EQ(next_mode(insertion, 0, 0, 0.0), insertion) << "in air";
}

// P6: a sum over elements that weighs none by its length.
TEST(ImplantTorque, DoublesWithTwiceTheElements) {
    Screwing once, twice({{"elements_per_turn", 32.0}});
    once.turn_by(3.0 * turn);
    twice.turn_by(3.0 * turn);
    EXPECT_NEAR(twice.torque() / once.torque(), 2.0, 0.05);
}

// Each loop takes 1 kg/m³ of 1000. Of a quarter of a second at 500, 1000 and 2000 Hz: 125, 250, 500.
TEST(ImplantTorque, StripsFasterInAFasterLoop) {  // E02-9, P5
    const auto left_after_quarter_turn = [](double rate) {
        Screwing implant({}, rate);
        while (implant.mode() != TorqueMode::stripping && implant.angle < 8.0 * turn) implant.turn_by(turn / 100.0);
        const double before = implant.torque();
        implant.turn_by(0.25 * turn);
        return implant.torque() / before;
    };
    EXPECT_NEAR(left_after_quarter_turn(500.0), 0.875, 0.015) << "the first hundredth of a turn";
    EXPECT_NEAR(left_after_quarter_turn(1000.0), 0.75, 0.015);
    EXPECT_NEAR(left_after_quarter_turn(2000.0), 0.5, 0.015);
}

TEST(ImplantTorque, OursStripsAlikeInAnyLoop) {  // E02-9, P5
    const ToolSetup setup = test::screw_setup({{"thread_length", 25.0_mm}});
    const Body body = test::pilot_block(250.0, 30.0_mm, 0.5 * test::parameter(setup, "tip_core_diameter"));
    const auto torques = [&](double period) {
        test::HandOnDriver hand(body, setup, period);
        std::vector<double> all;
        for (double next = 8.0 * turn; next < 12.0 * turn; next += 0.25) {
            while (hand.angle() < next - 1e-9) (void)hand.tick(pi);
            all.push_back(test::signal(hand.simulation(), "torque"));
        }
        return all;
    };
    const std::vector<double> at_1_khz = torques(1e-3);
    const double most = *std::max_element(at_1_khz.begin(), at_1_khz.end());
    ASSERT_LT(at_1_khz.back(), 0.5 * most) << "it has stripped";
    for (const double period : {2e-3, 0.5e-3}) {
        const std::vector<double> other = torques(period);
        for (std::size_t i = 0; i < other.size(); ++i)
            EXPECT_NEAR(other[i], at_1_khz[i], 0.02 * most) << 1.0 / period << " Hz, at " << i;
    }
}

TEST(ImplantTorque, StripsWhileTheDriverRests) {  // E02-9
    Screwing implant;
    implant.turn_by(6.2 * turn);
    ASSERT_EQ(implant.mode(), TorqueMode::stripping);
    const double before = implant.torque();
    implant.rest(0.3);
    implant.turn_by(0.01 * turn);
    EXPECT_LT(implant.torque(), 0.7 * before) << "310 loops of 1 kg/m³, at the same angle";
}

TEST(ImplantTorque, OursDoesNotStripAtRest) {  // E02-9
    const auto screw = seated();
    screw->turn(3.0, pi);
    screw->rest(1e-3);  // the signal is that of the bone before a tick
    const double slip = screw->slip();
    ASSERT_GT(slip, 0.5_mm);
    screw->rest(0.3);
    EXPECT_NEAR(screw->slip(), slip, 1e-6) << "it goes to where nothing pulls along the shaft, and no farther";
}

// The thread is 5 mm long, the bone 3 mm thick: two turns are beyond it for ever.
TEST(ImplantTorque, NeverTightensThroughTheFarCortex) {  // E02-10
    Screwing implant({}, 1000.0, 3.0_mm);
    implant.turn_by(5.0 * turn);
    const double at_the_seat = implant.torque();
    implant.turn_by(3.0 * turn);
    EXPECT_EQ(implant.mode(), TorqueMode::insertion) << "three turns after the head seated";
    EXPECT_NEAR(implant.torque(), at_the_seat, of_a_turn / 16.0 * 2.001) << "two elements at the faces";
    EXPECT_NEAR(at_the_seat, 3.0 * of_a_turn, of_a_turn / 16.0 * 2.001);
}

TEST(ImplantTorque, OursTightensThroughTheFarCortex) {  // E02-10
    const auto screw = seated(15.0_mm);
    const double at_the_seat = screw->torque();
    ASSERT_TRUE(screw->has_seen("implant.head_contact")) << "its tip is 10 mm beyond the bone";
    double most = 0.0;
    for (int i = 0; i < 120; ++i) {
        screw->turn(0.05, pi);
        most = std::max(most, screw->torque());
    }
    EXPECT_GT(most, 1.5 * at_the_seat);
    EXPECT_TRUE(screw->has_seen("implant.stripped"));
}

// With 2 mm of neck the thread is in bone two turns before the head is on it.
TEST(ImplantTorque, IsStrippedBeforeTheHeadSeats) {  // E02-10
    Screwing implant({{"neck_length", 2.0_mm}});
    implant.turn_by(5.1 * turn);
    EXPECT_EQ(implant.mode(), TorqueMode::tightening) << "1.9 mm above its seat";
    implant.turn_by(turn);
    EXPECT_EQ(implant.mode(), TorqueMode::stripping) << "0.9 mm above its seat";
}

TEST(ImplantTorque, FeelsNothingAtRest) {  // E02-11
    Screwing implant;
    implant.turn_by(4.0 * turn);
    ASSERT_GT(implant.last.torque, 3.0 * of_a_turn);
    implant.rest(0.002);
    EXPECT_EQ(implant.last.torque, 0.0) << "whatever the hand does with the driver";
}

TEST(ImplantTorque, OursIsHeldAtRest) {  // E02-11
    TurnedScrew screw({.density = 300.0});
    screw.insert(5.0, fast);
    const double going_in = screw.torque();
    for (const double way : {1.0, -1.0}) {
        const Pose rests = screw.rig().world_from_tool();
        const double enough = 0.5 * going_in;
        TickResult result;
        double twist = 0.0;  // [rad] of the driver against the screw, until the hand carries half of the torque
        for (int i = 0; i < 2000 && way * result.torque < enough; ++i) {
            twist += 0.0002;
            Pose handle = rests;
            handle.rotation = rests.rotation * quat_from_rotation_vector({0, 0, way * twist});
            result = screw.rig().tick({handle});
        }
        ASSERT_GE(way * result.torque, enough);
        const Quat moved = conjugate(rests.rotation) * screw.rig().world_from_tool().rotation;
        EXPECT_LT(length(small_rotation_vector(moved)), 0.5_deg) << "friction holds it, turned by " << way;
        for (int i = 0; i < 200; ++i) (void)screw.rig().tick({rests});
    }
}

// Ryan 2015: 96.5° on average from the seat to the largest torque.
TEST(ImplantTorque, PeaksAfterOneTurnInAnyBone) {  // E02-12
    for (const double density : {300.0, 1500.0}) {
        Screwing implant({}, 1000.0, 12.0_mm, density);
        double most = 0.0, max_at = 0.0;
        for (int i = 0; i < 800; ++i) {
            implant.turn_by(turn / 100.0);
            if (implant.torque() > most) most = implant.torque(), max_at = implant.angle;
        }
        EXPECT_NEAR(max_at, 6.0 * turn, 0.05 * turn) << density;
    }
}

TEST(ImplantTorque, OursPeaksLaterWithMoreYieldSlip) {  // E02-12
    const auto peak_after_seat = [](double yield_slip) {
        const auto screw = seated(55.0_mm, {{"yield_slip", yield_slip}});
        const double seat = screw->angle();
        double most = 0.0, max_at = 0.0;
        for (int i = 0; i < 240; ++i) {
            screw->turn(0.025, 0.5 * pi);
            if (screw->torque() > most) most = screw->torque(), max_at = screw->angle() - seat;
        }
        return max_at;
    };
    const double sooner = peak_after_seat(0.3_mm), later = peak_after_seat(0.6_mm);
    EXPECT_GT(sooner, 60.0_deg);
    EXPECT_LT(later, 360.0_deg);
    // 0.3 mm more of slip along a lead of 2.75 mm are 39°.
    EXPECT_NEAR(later - sooner, 39.0_deg, 12.0_deg) << "the force grows a little as well";
}

}  // namespace
}  // namespace kerf::as_printed
