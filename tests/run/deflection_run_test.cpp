// SPDX-License-Identifier: Apache-2.0
// Runs that a cap leads through the bytes of its reports, with a pedal, on a virtual clock.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "devices/hid/hid_reader.h"
#include "devices/pedal/pedal.h"
#include "devices/spacemouse/spacemouse.h"
#include "run/live_run.h"
#include "session/report/read_run.h"
#include "tests/devices/hid/scripted_transport.h"
#include "tests/run/device_double.h"
#include "tests/support/temporary_folder.h"

namespace kerf::run {
namespace {

/// A scripted HID device behind its driver's reader, without the driver's thread. A tick takes 1 ms.
class ReportingLink : public DeviceLink {
public:
    ReportingLink(const hid::HidModel& model, const hid::HidEntry& entry) : model_(model) {
        table_.plug_in(entry);
        reader_ = std::make_unique<hid::HidReader>(std::make_unique<test::ScriptedTransport>(table_), model,
                                                   hid::devices_of(model, table_.entries).front());
        EXPECT_EQ(reader_->open(), "");
    }
    [[nodiscard]] kerf_device_facts facts() const override { return model_.facts(reader_->entry()); }
    [[nodiscard]] kerf_device_state read() noexcept override {
        report(tick_);
        static_cast<void>(reader_->step(1e-3 * static_cast<double>(tick_++)));
        return reader_->state();
    }
    void write(const kerf_device_command& /*command*/) noexcept override {}

protected:
    /// Sends what the device sends in this tick.
    virtual void report(std::uint64_t tick) noexcept = 0;
    test::HidTable table_;

private:
    hid::HidModel model_;
    std::unique_ptr<hid::HidReader> reader_;
    std::uint64_t tick_ = 0;
};

/// A person with a SpaceNavigator, who sees the tool and moves its tip from target to target. They push harder while it
/// is too slow, and softer while it is too fast. They drill slowly, for a drill that breaks through plunges. They bring
/// the tip back sideways, unless it is in bone.
class PersonAtCap final : public ReportingLink {
public:
    /// @param targets  of the tip, patient frame [m], the start before them
    explicit PersonAtCap(std::vector<Vec3> targets)
        : ReportingLink(spacemouse::model(), test::space_navigator("/dev/hidraw0")), targets_(std::move(targets)) {}

    void write(const kerf_device_command& command) noexcept override { tip_ = command.device_from_tool.position; }

private:
    static constexpr std::uint64_t period = 8;  // ticks between two reports

    void report(std::uint64_t tick) noexcept override {
        if (tick == 0 || tick % period != 0 || target_ == targets_.size()) return;
        constexpr double arrived = 0.3e-3, air = 5e-3;                          // [m]
        constexpr double push_through = 1e-3, drill = 0.2e-3, approach = 8e-3;  // [m/s]
        constexpr double growth = 0.1, decline = 0.5, min_push = 0.02;          // [1/s], [–]
        const Vec3 leg = targets_[target_] - targets_[target_ - 1];
        const Vec3 along = length(leg) > 0.0 ? normalized(leg) : Vec3{};
        const Vec3 off = targets_[target_] - tip_;
        const double left = dot(off, along), dt = 1e-3 * period;
        const double speed = dot(tip_ - std::exchange(before_, tip_), along) / dt;
        if (left < arrived) {
            ++target_;
            push_ = min_push;
            send({});
            return;
        }
        const bool is_inwards = target_ % 3 == 1, is_in_bone = is_inwards && length(leg) - left > air;
        const double feed = target_ < 3 ? drill : push_through;
        const bool is_slow = speed < (is_in_bone ? feed : approach);
        push_ = std::clamp(push_ + dt * (is_slow ? growth : -decline), min_push, 1.0);
        const documents::DeviceStation station;
        send(push_ * station.speed * along + (is_in_bone ? Vec3{} : off - left * along));
    }
    /// Reports the deflection that moves the tip at this velocity [m/s]. The cap's own y leads to the user, and its z
    /// down.
    void send(Vec3 velocity) {
        const documents::DeviceStation station;
        test::ReportBytes report{1};
        for (const double v : {velocity.x, velocity.z, -velocity.y}) {
            const double beyond = std::sqrt(std::min(1.0, std::abs(v) / station.speed));  // the dead zone
            const double size = beyond > 0.0 ? station.dead_zone + (1.0 - station.dead_zone) * beyond : 0.0;
            const auto counts = static_cast<int>(std::lround(350.0 * std::copysign(size, v)));
            report.push_back(static_cast<std::uint8_t>(counts & 0xff));
            report.push_back(static_cast<std::uint8_t>(counts >> 8 & 0xff));
        }
        table_.queue.push_back(std::move(report));
    }
    std::vector<Vec3> targets_;
    std::size_t target_ = 1;
    double push_ = 0.02;  ///< [–] of the full one
    Vec3 before_{};       ///< tip at the last report
    Vec3 tip_{};
};

/// A foot that presses the left button of a pedal, which is unplugged for a while.
class FootAtPedal final : public ReportingLink {
public:
    /// @param unplugged  range of ticks
    explicit FootAtPedal(std::pair<std::uint64_t, std::uint64_t> unplugged = {})
        : ReportingLink(pedal::model(), infinity), unplugged_(unplugged) {}

private:
    static inline const hid::HidEntry infinity{.path = "/dev/hidraw1", .vendor = 0x05f3, .product = 0x00ff};

    void report(std::uint64_t tick) noexcept override {
        constexpr std::uint64_t pressed = 500;
        if (tick == unplugged_.first && unplugged_.second > 0) table_.unplug();
        if (tick == unplugged_.second && tick > 0) table_.plug_in(infinity);
        // The foot presses again, later.
        if (tick == pressed || (unplugged_.second > 0 && tick == unplugged_.second + 1500))
            table_.queue.push_back({1, 0});
    }
    std::pair<std::uint64_t, std::uint64_t> unplugged_;
};

/// Returns the tips at the start and at the ends of the legs of a procedure's first rehearsal.
std::vector<Vec3> tips_of(const Scene& scene) {
    const HandPlan plan = plan_of(scene.procedure.rehearsals.front(), scene);
    std::vector<Vec3> tips{plan.start.position};
    for (const auto& leg : plan.intent.legs) tips.push_back(leg.target.position);
    return tips;
}

RunOutcome run_at_cap(const Scene& scene, const std::string& out,
                      std::pair<std::uint64_t, std::uint64_t> unplugged = {},
                      std::vector<RunObserver*> observers = {}) {
    const auto cap = opened(std::make_unique<PersonAtCap>(tips_of(scene)));
    documents::DeviceStation station = station_in_world();
    station.buttons.fill(documents::ButtonAction::none);  // of the cap
    station.append_buttons({.device = "pedal"}, cap->facts().button_count);
    EXPECT_EQ(cap->add_pedal(opened(std::make_unique<FootAtPedal>(unplugged))), "");
    RunRequest request;
    request.out = out;
    request.observers = std::move(observers);
    SteadyClock clock;
    return run_on_clock(scene, test::plugins(), request, clock, *cap, station);
}

std::optional<Scene> awl_scene() {
    text::Diagnostics diagnostics;
    auto scene = make_scene(KERF_SOURCE_DIR "/procedures/pedicle-awl.yaml", "", test::plugins()).take(diagnostics);
    EXPECT_TRUE(scene) << text::to_text(diagnostics);
    return scene;
}

TEST(DeflectionRun, CapAndPedalOpenAPedicleAndReplayToTheBit) {
    const auto scene = awl_scene();
    ASSERT_TRUE(scene);
    const test::TemporaryFolder folder;
    const RunOutcome led = run_at_cap(*scene, folder.path() + "/led");
    ASSERT_EQ(led.error, "");
    EXPECT_EQ(led.summary.verdict, session::Verdict::pass)
        << (led.summary.reasons.empty() ? "" : led.summary.reasons.front());
    EXPECT_EQ(led.summary.hand, "device");
    EXPECT_EQ(led.summary.leader, "double");
    EXPECT_NE(led.summary.leader_setup.find("drive, next, clutch, undo]"), std::string::npos)
        << led.summary.leader_setup;
    std::string error;
    const auto recorded = session::read_run(folder.path() + "/led/session.db", error);
    ASSERT_TRUE(recorded) << error;
    EXPECT_EQ(recorded->summary.leader, "double");
    EXPECT_EQ(recorded->summary.leader_setup, led.summary.leader_setup);
    EXPECT_EQ(led.summary.device, scene->procedure.device) << "coupling and force scale are those of the procedure";
    const session::RecordedInputs inputs = inputs_in(folder.path() + "/led");
    EXPECT_TRUE(inputs.device_values.empty()) << "a modelled device needs no record";
    EXPECT_EQ(replayed(*scene, inputs).summary.hash, led.summary.hash);
}

/// Collects the events that a run records.
struct Events final : RunObserver {
    std::vector<std::pair<std::uint64_t, std::string>> all;
    void on_event(const session::EventRow& event) override {
        all.emplace_back(event.tick, event.id + " " + event.detail);
    }
    [[nodiscard]] std::vector<std::uint64_t> ticks_of(const std::string& what) const {
        std::vector<std::uint64_t> ticks;
        for (const auto& [tick, text] : all)
            if (text.find(what) != std::string::npos) ticks.push_back(tick);
        return ticks;
    }
};

TEST(DeflectionRun, ToolStopsWhileItsPedalIsUnplugged) {
    auto scene = awl_scene();
    ASSERT_TRUE(scene);
    scene->procedure.time_limit = 5.0;  // [s]; by then the foot has pressed again
    Events events;
    static_cast<void>(run_at_cap(*scene, "", {1000, 2000}, {&events}));
    std::string text;
    for (const auto& [tick, what] : events.all) text += std::to_string(tick) + " " + what + "\n";
    const std::vector<std::uint64_t> drives = events.ticks_of("hand.input spindle_speed");
    ASSERT_GE(drives.size(), 4u) << text;
    EXPECT_EQ(drives[0], 0u) << "no foot is on it";
    EXPECT_EQ(drives[1], 501u) << "the foot presses";
    EXPECT_EQ(drives[2], 1001u) << "it is unplugged";
    EXPECT_GT(drives[3], 2000u) << "it is back";
    EXPECT_TRUE(events.ticks_of("device.lost").empty()) << "the cap still leads the tool";
}

}  // namespace
}  // namespace kerf::run
