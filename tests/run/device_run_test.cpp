// SPDX-License-Identifier: Apache-2.0
// Runs with a hand at a device: through the driver's table, on a virtual clock.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/haptics/loop/coupling.h"
#include "core/haptics/loop/stated_device.h"
#include "run/device/device_hand.h"
#include "run/device/knob_turn.h"
#include "run/live_run.h"
#include "tests/run/device_double.h"
#include "tests/run/rehearsed_handle.h"
#include "tests/support/short_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/watched_run.h"

namespace kerf::run {
namespace {

using documents::ButtonAction;
using documents::DeviceStation;
using test::short_scene;

constexpr Quat no_turn{1, 0, 0, 0};

kerf_device_facts facts_of_premium() {
    const DeviceRecord& premium = *find_device("premium-1.5-6dof");
    return {.name = "double",
            .abilities = KERF_DEVICE_POSITION | KERF_DEVICE_ROTATION | KERF_DEVICE_FORCE | KERF_DEVICE_TORQUE,
            .button_count = 2,
            .peak_force = premium.peak_force,
            .continuous_force = premium.peak_force,  // ideal motors
            .peak_torque = premium.peak_torque,
            .continuous_torque = premium.peak_torque,
            .largest_stiffness = premium.largest_stiffness,
            .largest_damping = premium.largest_damping,
            .mass = premium.mass,
            .resolution = premium.resolution,
            .peak_turn_torque = 0.0,
            .continuous_turn_torque = 0.0,
            .turn_resolution = 0.0};
}

/// A device with the simulated hand of a rehearsal at its handle. Button 0 runs the motor, button 1 is `next`.
class HandAtDouble final : public DeviceLink {
public:
    /// @param silent  ranges of ticks in which it reports nothing
    /// @param idle    range of ticks in which the hand does not hold button 0
    HandAtDouble(RehearsedHandle& hand, std::vector<std::pair<std::uint64_t, std::uint64_t>> silent,
                 std::pair<std::uint64_t, std::uint64_t> idle)
        : hand_(hand), silent_(std::move(silent)), idle_(idle) {}

    [[nodiscard]] kerf_device_facts facts() const override { return facts_of_premium(); }
    [[nodiscard]] kerf_device_state read() noexcept override {
        kerf_device_state state{};
        const bool is_silent = std::any_of(silent_.begin(), silent_.end(), [&](const auto& range) {
            return tick_ >= range.first && tick_ < range.second;
        });
        state.reports = tick_;
        state.device_from_handle = hand_.handle();
        state.flags = is_silent ? 0u : std::uint32_t{KERF_DEVICE_VALID};
        const bool is_idle = tick_ >= idle_.first && tick_ < idle_.second;
        state.buttons = hand_.buttons() & (is_idle ? ~1u : ~0u);
        return state;
    }
    void write(const kerf_device_command& command) noexcept override {
        ++tick_;
        if ((command.flags & KERF_DEVICE_RUNNING) != 0)
            hand_.move(command.force, command.torque, command.device_from_tool);
    }

private:
    RehearsedHandle& hand_;
    std::vector<std::pair<std::uint64_t, std::uint64_t>> silent_;
    std::pair<std::uint64_t, std::uint64_t> idle_;
    std::uint64_t tick_ = 0;
};

RunOutcome run_at_double(const Scene& scene, const std::string& out,
                         std::vector<std::pair<std::uint64_t, std::uint64_t>> silent = {},
                         std::pair<std::uint64_t, std::uint64_t> idle = {}) {
    RehearsedHandle hand(scene);
    RunRequest request;
    request.observers = {&hand};
    const auto device = opened(std::make_unique<HandAtDouble>(hand, std::move(silent), idle));
    request.out = out;
    SteadyClock clock;
    return run_on_clock(scene, test::plugins(), request, clock, *device, station_in_world());
}

// ---- a whole run --------------------------------------------------------------------------------------------------

void expect_two_buttons_complete(const std::string& procedure) {
    text::Diagnostics diagnostics;
    const auto scene = make_scene(KERF_SOURCE_DIR "/procedures/" + procedure, "", test::plugins()).take(diagnostics);
    ASSERT_TRUE(scene) << text::to_text(diagnostics);
    const RunOutcome led = run_at_double(*scene, "");
    EXPECT_EQ(led.error, "");
    EXPECT_EQ(led.summary.verdict, session::Verdict::pass)
        << (led.summary.reasons.empty() ? "" : led.summary.reasons.front());
    EXPECT_EQ(led.summary.hand, "device");
}

TEST(DeviceRun, TwoButtonsCompleteTheTrochanter) { expect_two_buttons_complete("trochanter-fixation.yaml"); }
TEST(DeviceRun, TwoButtonsCompleteTheAmputation) { expect_two_buttons_complete("amputation.yaml"); }

TEST(DeviceRun, ReplaysALossOfTheDeviceToTheBit) {
    const test::TemporaryFolder folder;
    const RunOutcome led = run_at_double(short_scene(), folder.path() + "/led", {{1000, 1100}, {4000, 4001}});
    ASSERT_EQ(led.error, "");
    EXPECT_NE(led.summary.hash, run_at_double(short_scene(), "").summary.hash);
    const session::RecordedInputs inputs = inputs_in(folder.path() + "/led");
    EXPECT_EQ(replayed(short_scene(), inputs).summary.hash, led.summary.hash);
    using Loss = std::pair<std::uint64_t, bool>;
    EXPECT_EQ(inputs.lost, (std::vector<Loss>{{1000, true}, {1100, false}, {4000, true}, {4001, false}}));
}

TEST(DeviceRun, ReplaysItsButtonsToTheBit) {
    const test::TemporaryFolder folder;
    const RunOutcome led = run_at_double(short_scene(), folder.path() + "/led", {}, {2000, 3000});
    ASSERT_EQ(led.error, "");
    EXPECT_NE(led.summary.hash, run_at_double(short_scene(), "").summary.hash);
    const session::RecordedInputs inputs = inputs_in(folder.path() + "/led");
    EXPECT_EQ(replayed(short_scene(), inputs).summary.hash, led.summary.hash);
    ASSERT_GE(inputs.hand_inputs.size(), 2u);
    EXPECT_EQ(inputs.hand_inputs.back().first, 3001u) << "the motor runs from the tick after the press";
}

TEST(DeviceRun, EndsWhenTheDeviceDoesNotComeBack) {
    const RunOutcome led = run_at_double(short_scene(), "", {{1000, 1'000'000}});
    EXPECT_EQ(led.summary.verdict, session::Verdict::incomplete);
    EXPECT_EQ(led.summary.ticks, 11'000u);
    ASSERT_FALSE(led.summary.reasons.empty());
    EXPECT_EQ(led.summary.reasons.front(), "The run ended early: the device was silent for 10 s.");
}

// ---- the hand at a device -------------------------------------------------------------------------------------------

kerf_device_state at(Vec3 position, std::uint32_t buttons = 0) {
    kerf_device_state state{};
    state.device_from_handle = {position, no_turn};
    state.buttons = buttons;
    state.flags = KERF_DEVICE_VALID;
    return state;
}

TEST(DeviceHand, MovesTheToolAlongTheAxesOfTheStation) {
    // By default the user looks from behind: the device's right, up and back are the patient's -x, +z and +y.
    const Pose start{{0.1, 0.2, 0.3}, no_turn};
    DeviceHand hand({.scale = 0.5}, facts_of_premium(), start);
    EXPECT_EQ(length(hand.take(at({0.7, 0.8, 0.9}), {}).world_from_handle.position - start.position), 0.0)
        << "wherever the handle is";
    const Vec3 moved = hand.take(at({0.710, 0.820, 0.930}), {}).world_from_handle.position - start.position;
    EXPECT_NEAR(moved.x, -0.005, 1e-12);
    EXPECT_NEAR(moved.y, 0.015, 1e-12);
    EXPECT_NEAR(moved.z, 0.010, 1e-12);

    TickResult result;
    result.command.wrench = make_vec6({1.0, 2.0, 3.0}, {});
    result.world_from_tool = {start.position + moved, no_turn};
    const kerf_device_command command = hand.command(result, 5);
    EXPECT_NEAR(command.force.x, -1.0, 1e-12);
    EXPECT_NEAR(command.force.y, 3.0, 1e-12);
    EXPECT_NEAR(command.force.z, 2.0, 1e-12);
    EXPECT_NEAR(length(command.device_from_tool.position - Vec3{0.710, 0.820, 0.930}), 0.0, 1e-12);
    EXPECT_EQ(command.flags, std::uint32_t{KERF_DEVICE_RUNNING | KERF_DEVICE_FORCE_ON});
}

TEST(DeviceHand, HoldsTheToolWhileItIsClutched) {
    DeviceStation station = station_in_world();
    station.buttons = {ButtonAction::drive, ButtonAction::clutch};
    DeviceHand hand(station, facts_of_premium(), identity_pose());
    constexpr std::uint32_t clutch = 1u << 1;
    static_cast<void>(hand.take(at({}), {}));
    const Vec3 before = hand.take(at({0.01, 0, 0}), {}).world_from_handle.position;
    const DeviceSample clutched = hand.take(at({0.02, 0, 0}, clutch), {});
    EXPECT_TRUE(clutched.is_lost) << "the force fades: the handle is free";
    EXPECT_FALSE(hand.is_silent(1));
    EXPECT_EQ(length(clutched.world_from_handle.position - before), 0.0);
    EXPECT_EQ(length(hand.take(at({-0.05, 0, 0}, clutch), {}).world_from_handle.position - before), 0.0);
    EXPECT_EQ(length(hand.take(at({-0.05, 0, 0}), {}).world_from_handle.position - before), 0.0)
        << "no jump when it is let go";
    EXPECT_NEAR(hand.take(at({-0.04, 0, 0}), {}).world_from_handle.position.x, 0.02, 1e-12);
}

TEST(DeviceHand, IsLostWhileTheDeviceIsSilent) {
    DeviceHand hand(station_in_world(), facts_of_premium(), identity_pose());
    static_cast<void>(hand.take(at({}), {}));
    const Vec3 before = hand.take(at({0.01, 0, 0}, 1u), {}).world_from_handle.position;
    EXPECT_TRUE(hand.presses().is_driving);
    kerf_device_state late = at({0.02, 0, 0}, 1u);
    late.age = 20e-3;
    EXPECT_FALSE(hand.take(late, {}).is_lost);
    late.age = 20.1e-3;
    EXPECT_TRUE(hand.take(late, {}).is_lost);
    EXPECT_FALSE(hand.presses().is_driving) << "a motor does not run on without a hand";
    const Vec3 at_loss = hand.take(late, {}).world_from_handle.position;
    EXPECT_GT(at_loss.x, before.x);
    const DeviceSample back = hand.take(at({0.5, 0.5, 0.5}), {});
    EXPECT_FALSE(back.is_lost);
    EXPECT_EQ(length(back.world_from_handle.position - at_loss), 0.0)
        << "the handle is joined to the tool where both are";
}

TEST(DeviceHand, IsLostWhereAReportCannotBe) {
    DeviceHand hand(station_in_world(), facts_of_premium(), identity_pose());
    kerf_device_state state = at({});
    state.age = std::nan("");
    EXPECT_TRUE(hand.take(state, {}).is_lost);
    EXPECT_TRUE(hand.take(at({std::nan(""), 0, 0}), {}).is_lost);
    EXPECT_TRUE(hand.take(at({200.0, 0, 0}), {}).is_lost) << "millimetres, perhaps";
    kerf_device_state stretched = at({});
    stretched.device_from_handle.rotation.w = 1.1;
    EXPECT_TRUE(hand.take(stretched, {}).is_lost);
    EXPECT_FALSE(hand.take(at({}), {}).is_lost);
}

TEST(DeviceHand, TurnsTheToolAboutItsGrip) {
    const Vec3 grip{0, 0, -0.1};
    DeviceHand hand(station_in_world(), facts_of_premium(), identity_pose());
    static_cast<void>(hand.take(at({}), grip));
    kerf_device_state turned = at({});
    turned.device_from_handle.rotation = quat_from_rotation_vector({0.5, 0, 0});
    const Pose tool = hand.take(turned, grip).world_from_handle;
    EXPECT_NEAR(length(tool * grip - grip), 0.0, 1e-12) << "the origin of the handle stays";
    EXPECT_NEAR(tool.position.y, -0.1 * std::sin(0.5), 1e-9);
    TickResult result;
    result.world_from_tool = tool;
    const Pose seen = hand.command(result, 0).device_from_tool;
    EXPECT_NEAR(length(seen * grip - turned.device_from_handle.position), 0.0, 1e-12);
}

TEST(DeviceHand, RepeatsNoPressAfterALoss) {
    DeviceHand hand(station_in_world(), facts_of_premium(), identity_pose());
    constexpr std::uint32_t next = 1u << 1;
    static_cast<void>(hand.take(at({}, next), {}));
    EXPECT_FALSE(hand.presses().wants_next) << "it was pressed before the run";
    static_cast<void>(hand.take(at({}), {}));
    static_cast<void>(hand.take(at({}, next), {}));
    EXPECT_TRUE(hand.presses().wants_next);
    static_cast<void>(hand.take({}, {}));
    static_cast<void>(hand.take(at({}, next), {}));
    EXPECT_FALSE(hand.presses().wants_next);
    static_cast<void>(hand.take(at({}, 1u << 3), {}));
    EXPECT_FALSE(hand.presses().wants_undo) << "the device has two buttons";
}

TEST(DeviceHand, RequestsAnActionOnceAPress) {
    DeviceHand hand(station_in_world(), facts_of_premium(), identity_pose());
    constexpr std::uint32_t next = 1u << 1;
    static_cast<void>(hand.take(at({}), {}));
    static_cast<void>(hand.take(at({}, next), {}));
    EXPECT_TRUE(hand.presses().wants_next);
    static_cast<void>(hand.take(at({}, next), {}));
    EXPECT_FALSE(hand.presses().wants_next) << "it is still held";
    static_cast<void>(hand.take(at({}), {}));
    static_cast<void>(hand.take(at({}, next), {}));
    EXPECT_TRUE(hand.presses().wants_next);
}

// ---- a knob next to the leading device -----------------------------------------------------------------------------

kerf_device_facts facts_with_knob() {
    kerf_device_facts facts = facts_of_premium();
    facts.abilities &= ~std::uint32_t{KERF_DEVICE_TORQUE};
    facts.peak_torque = facts.continuous_torque = 0.0;
    facts.abilities |= KERF_DEVICE_TURN | KERF_DEVICE_TURN_TORQUE;
    facts.peak_turn_torque = 2.0;
    facts.continuous_turn_torque = 1.0;
    facts.turn_resolution = 1e-3;
    return facts;
}

kerf_device_state turned_by(double turn, std::uint64_t reports = 0) {
    kerf_device_state state = at({});
    state.turn = turn;
    state.reports = reports;
    return state;
}

TEST(DeviceHand, TurnsTheToolAboutItsShaftByTheKnob) {
    const Pose start{{0.1, 0.2, 0.3}, quat_from_rotation_vector({0.3, -0.2, 0.5})};
    const Vec3 grip{0, 0, -0.1};
    DeviceHand hand(station_in_world(), facts_with_knob(), start);
    static_cast<void>(hand.take(turned_by(7.0), grip));
    const Pose tool = hand.take(turned_by(7.0 + 5.5 * std::numbers::pi), grip).world_from_handle;
    EXPECT_NEAR(length(tool * grip - start * grip), 0.0, 1e-12) << "shaft and grip stay where they are";
    EXPECT_NEAR(length(rotate(tool.rotation, {0, 0, 1}) - rotate(start.rotation, {0, 0, 1})), 0.0, 1e-12);
    // Two turns and three quarters clockwise, as seen along the shaft, take x to -y.
    EXPECT_NEAR(length(rotate(tool.rotation, {1, 0, 0}) - rotate(start.rotation, {0, -1, 0})), 0.0, 1e-9);

    static_cast<void>(hand.take({}, grip));  // the leading device is lost
    const Pose back = hand.take(turned_by(-3.0), grip).world_from_handle;
    EXPECT_NEAR(length(rotate(back.rotation, {1, 0, 0}) - rotate(tool.rotation, {1, 0, 0})), 0.0, 1e-12)
        << "it is joined again where both are";
}

TEST(DeviceHand, SendsTheTorqueAboutTheShaftToTheKnob) {
    TickResult result;
    result.world_from_tool = {{}, quat_between({0, 0, 1}, {1, 0, 0})};  // the shaft along x
    result.command.wrench = make_vec6({1, 2, 3}, {-0.4, 0.1, 0.2});
    DeviceHand with(station_in_world(), facts_with_knob(), identity_pose());
    EXPECT_NEAR(with.command(result, 0).turn_torque, -0.4, 1e-12);
    DeviceHand without(station_in_world(), facts_of_premium(), identity_pose());
    EXPECT_EQ(without.command(result, 0).turn_torque, 0.0);
}

TEST(KnobTurn, InterpolatesASlowKnob) {
    KnobTurn knob;
    EXPECT_EQ(knob.take(turned_by(1.0, 5)), 0.0) << "from where it is";
    for (int i = 0; i < 7; ++i) EXPECT_EQ(knob.take(turned_by(1.0, 5)), 0.0);
    for (int i = 1; i <= 8; ++i) {
        EXPECT_NEAR(knob.take(turned_by(1.8, 6)), 0.1 * i, 1e-12) << "its reports are 8 ticks apart";
    }
    EXPECT_NEAR(knob.take(turned_by(1.8, 6)), 0.8, 1e-12);
    for (int i = 0; i < 100; ++i) static_cast<void>(knob.take(turned_by(1.8, 6)));
    for (int i = 0; i < 20; ++i) static_cast<void>(knob.take(turned_by(2.0, 7)));
    EXPECT_NEAR(knob.take(turned_by(2.0, 7)), 1.0, 1e-12) << "a late report takes at most 20 ticks";
}

TEST(KnobTurn, KeepsItsTurnWhileTheKnobIsLost) {
    KnobTurn knob;
    static_cast<void>(knob.take(turned_by(0.0, 1)));
    EXPECT_NEAR(knob.take(turned_by(0.5, 2)), 0.5, 1e-12);
    EXPECT_NEAR(knob.take({}), 0.5, 1e-12);
    kerf_device_state odd = turned_by(std::nan(""), 3);
    EXPECT_NEAR(knob.take(odd), 0.5, 1e-12);
    EXPECT_NEAR(knob.take(turned_by(90.0, 4)), 0.5, 1e-12) << "it was turned while it was unplugged";
    EXPECT_NEAR(knob.take(turned_by(90.25, 5)), 0.75, 1e-12);
}

/// A knob of a test.
class Knob final : public DeviceLink {
public:
    explicit Knob(std::uint32_t abilities) : abilities_(abilities) {}
    [[nodiscard]] kerf_device_facts facts() const override {
        kerf_device_facts facts{};
        facts.abilities = abilities_;
        facts.peak_turn_torque = 2.0;
        facts.continuous_turn_torque = 1.0;
        facts.turn_resolution = 1e-3;
        return facts;
    }
    [[nodiscard]] kerf_device_state read() noexcept override {
        kerf_device_state state = turned_by(turn += 0.01, ++reports_);
        state.buttons = 1u;
        return state;
    }
    void write(const kerf_device_command& command) noexcept override { torque = command.turn_torque; }
    [[nodiscard]] std::string problem() override { return "it is stuck."; }
    double turn = 0.0, torque = 0.0;

private:
    std::uint32_t abilities_;
    std::uint64_t reports_ = 0;
};

/// A stylus that is still.
class Stylus final : public DeviceLink {
public:
    explicit Stylus(const kerf_device_facts& facts) : facts_(facts) {}
    [[nodiscard]] kerf_device_facts facts() const override { return facts_; }
    [[nodiscard]] kerf_device_state read() noexcept override { return at({}, 2u); }
    void write(const kerf_device_command& /*command*/) noexcept override {}

private:
    kerf_device_facts facts_;
};

constexpr std::uint32_t knob_abilities = KERF_DEVICE_TURN | KERF_DEVICE_TURN_TORQUE;

kerf_device_facts facts_of_stylus() {
    kerf_device_facts facts = facts_with_knob();
    facts.abilities &= ~knob_abilities;
    facts.peak_turn_torque = facts.continuous_turn_torque = facts.turn_resolution = 0.0;
    return facts;
}

TEST(OpenedDevice, AddsAKnobToTheLeadingDevice) {
    const auto device = opened(std::make_unique<Stylus>(facts_of_stylus()));
    auto link = std::make_unique<Knob>(knob_abilities);
    Knob& knob = *link;
    EXPECT_EQ(device->add_knob(opened(std::move(link))), "");
    EXPECT_EQ(device->facts().abilities & knob_abilities, knob_abilities);
    EXPECT_EQ(device->record()->axis.peak_torque, 2.0);
    EXPECT_EQ(device->record()->continuous_torque, 1.0);
    static_cast<void>(device->read());
    const kerf_device_state state = device->read();
    EXPECT_NEAR(state.turn, 0.01, 1e-12);
    EXPECT_EQ(state.buttons, 2u) << "those of the knob count for nothing";
    kerf_device_command command{};
    command.turn_torque = 0.7;
    device->write(command);
    EXPECT_EQ(knob.torque, 0.7);
    EXPECT_EQ(device->problem(), "it is stuck.");

    std::string fault;
    const auto recorded = StatedDevice::of("again", StatedDevice::values_of(*device->record()), fault);
    ASSERT_NE(recorded, nullptr) << fault;
    EXPECT_EQ(recorded->record().axis.peak_torque, 2.0) << "a replay has the same device";
    EXPECT_EQ(recorded->record().axis.resolution, 1e-3);
    EXPECT_EQ(gains_for(recorded->record(), 0.01, 1).shaft.torque_limit, 2.0);
}

TEST(OpenedDevice, CarriesWhatIsFixedToTheHandle) {
    kerf_device_facts facts = facts_of_premium();
    const auto device = opened(std::make_unique<Stylus>(facts));
    EXPECT_EQ(device->fit_handle({.grip = {0, 0, 0.04}, .mass = 0.05}), "");
    EXPECT_DOUBLE_EQ(device->record()->peak_force, facts.peak_force - 0.05 * 9.81) << "the rest is for bone";
    EXPECT_DOUBLE_EQ(device->facts().continuous_force, facts.continuous_force - 0.05 * 9.81);
    EXPECT_DOUBLE_EQ(device->record()->mass, facts.mass + 0.05);
    EXPECT_EQ(device->read().device_from_handle.position.z, 0.04);

    const auto weak = opened(std::make_unique<Stylus>(facts));
    EXPECT_NE(weak->fit_handle({.mass = 0.9}).find("need at most 4.25 N, half of"), std::string::npos);
    const auto knob = opened(std::make_unique<Knob>(knob_abilities));
    EXPECT_NE(knob->fit_handle({.mass = 0.01}).find("Leave out `handle`"), std::string::npos);
}

TEST(OpenedDevice, RefusesWhatIsNoKnob) {
    const auto refusal = [](const kerf_device_facts& facts, std::uint32_t abilities) {
        const auto device = opened(std::make_unique<Stylus>(facts));
        return device->add_knob(opened(std::make_unique<Knob>(abilities)));
    };
    EXPECT_NE(refusal(facts_of_stylus(), 0u), "") << "a pedal";
    EXPECT_NE(refusal(facts_of_premium(), knob_abilities), "") << "it makes all torques";
    EXPECT_NE(refusal(facts_with_knob(), knob_abilities), "") << "it has one";
    EXPECT_EQ(refusal(facts_of_stylus(), KERF_DEVICE_TURN), "") << "a knob without a motor";
}

TEST(StatedDevice, HasTheMotorOfItsOwnKnob) {
    std::string fault;
    const auto device = StatedDevice::of("stylus with a motor", facts_with_knob(), fault);
    ASSERT_NE(device, nullptr) << fault;
    EXPECT_EQ(device->record().axis.peak_torque, 2.0);
    EXPECT_EQ(device->record().axis.resolution, 1e-3);
    EXPECT_EQ(device->record().continuous_torque, 1.0);
    kerf_device_facts both = facts_of_premium();
    both.abilities |= knob_abilities;
    both.peak_turn_torque = both.continuous_turn_torque = 1.0;
    both.turn_resolution = 1e-3;
    EXPECT_EQ(StatedDevice::of("both", both, fault), nullptr) << "it makes all torques itself";
}

TEST(StatedDevice, RefusesADeviceThatTheLoopCannotUse) {
    const auto fault_of = [](auto&& change) {
        kerf_device_facts facts = facts_of_premium();
        change(facts);
        return fault_of_facts(facts);
    };
    EXPECT_EQ(fault_of([](auto&) {}), "");
    EXPECT_NE(fault_of([](auto& f) { f.peak_force = 0.0; }), "");
    EXPECT_NE(fault_of([](auto& f) { f.peak_force = 1e6; }), "");
    EXPECT_NE(fault_of([](auto& f) { f.continuous_force = f.peak_force + 1.0; }), "");
    EXPECT_NE(fault_of([](auto& f) { f.largest_stiffness = std::nan(""); }), "");
    EXPECT_NE(fault_of([](auto& f) { f.resolution = 0.0; }), "");
    EXPECT_NE(fault_of([](auto& f) { f.mass = -1.0; }), "");
    EXPECT_NE(fault_of([](auto& f) { f.abilities = KERF_DEVICE_POSITION; }), "");
    EXPECT_NE(fault_of([](auto& f) { f.continuous_torque = 0.0; }), "");
    EXPECT_NE(fault_of([](auto& f) { f.button_count = 33; }), "");
    const auto fault_of_knob = [](auto&& change) {
        kerf_device_facts facts = facts_with_knob();
        change(facts);
        return fault_of_facts(facts);
    };
    EXPECT_EQ(fault_of_knob([](auto&) {}), "");
    EXPECT_NE(fault_of_knob([](auto& f) { f.peak_turn_torque = 0.0; }), "");
    EXPECT_NE(fault_of_knob([](auto& f) { f.continuous_turn_torque = 3.0; }), "");
    EXPECT_NE(fault_of_knob([](auto& f) { f.turn_resolution = std::nan(""); }), "");
    EXPECT_NE(fault_of_knob([](auto& f) { f.abilities &= ~std::uint32_t{KERF_DEVICE_TURN}; }), "");
}

}  // namespace
}  // namespace kerf::run
