// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <thread>
#include <utility>

#include "core/haptics/loop/stated_device.h"
#include "kerf/device_exchange.hpp"
#include "run/clock/tick_clock.h"
#include "run/documents.h"
#include "run/live_run.h"
#include "tests/run/device_double.h"
#include "tests/run/rehearsed_handle.h"

/// Runs with a driver and a stand-in for its device. The hand of the rehearsal is at the stand-in: the force that
/// arrives there moves it. The axes of the device are those of the world.
namespace kerf::run {

/// Takes the part of a device. Any thread calls its functions.
class StandIn {
public:
    virtual ~StandIn() = default;
    virtual void set_handle(const Pose& device_from_handle, std::uint32_t buttons) = 0;
    /// Returns the force that it makes now [N].
    [[nodiscard]] virtual Vec3 force() = 0;
    /// Returns the torque that it makes now [N·m].
    [[nodiscard]] virtual Vec3 torque() { return {}; }
    /// Returns a pose as the device can report it, which may round it.
    [[nodiscard]] virtual Pose reported(const Pose& device_from_handle) const { return device_from_handle; }
};

/// A driver whose commands the hand also sees, since it sees the tool.
class WatchedLink final : public DeviceLink {
public:
    /// @param is_in_step  the ticks wait for the device, so that no report is old
    WatchedLink(std::unique_ptr<DeviceLink> link, Newest<kerf_device_command>& commands, bool is_in_step)
        : link_(std::move(link)), commands_(commands), is_in_step_(is_in_step) {}
    [[nodiscard]] kerf_device_facts facts() const override { return link_->facts(); }
    [[nodiscard]] kerf_device_state read() noexcept override {
        kerf_device_state state = link_->read();
        if (is_in_step_) state.age = 0.0;
        return state;
    }
    void write(const kerf_device_command& command) noexcept override {
        link_->write(command);
        commands_.put(command);
    }

private:
    std::unique_ptr<DeviceLink> link_;
    Newest<kerf_device_command>& commands_;
    bool is_in_step_;
};

/// A device with nothing between hand and loop: the reference for runs through a driver.
class DirectLink final : public DeviceLink {
public:
    DirectLink(RehearsedHandle& hand, const kerf_device_facts& facts, const StandIn& device)
        : hand_(hand), facts_(facts), device_(device) {}
    [[nodiscard]] kerf_device_facts facts() const override { return facts_; }
    [[nodiscard]] kerf_device_state read() noexcept override {
        kerf_device_state state = state_without_report();
        state.device_from_handle = device_.reported(hand_.handle());
        state.buttons = hand_.buttons();
        state.flags = KERF_DEVICE_VALID;
        return state;
    }
    void write(const kerf_device_command& command) noexcept override {
        if ((command.flags & KERF_DEVICE_RUNNING) != 0) hand_.move(command.force, {}, command.device_from_tool);
    }

private:
    RehearsedHandle& hand_;
    kerf_device_facts facts_;
    const StandIn& device_;
};

/// Between two ticks it waits until the force of the first has moved the hand, and until the driver has the new pose.
/// So nothing depends on the speed of the machine.
class LockStepClock final : public TickClock {
public:
    LockStepClock(StandIn& device, RehearsedHandle& hand, DeviceLink& driver, Newest<kerf_device_command>& commands)
        : device_(device), hand_(hand), driver_(driver), commands_(commands) {}

    [[nodiscard]] std::uint32_t wait() noexcept override {
        if (has_ticked_) {
            const kerf_device_command command = commands_.get();
            while (!(device_.force() == command.force)) {
                driver_.write(command);  // again: a driver drops a command that is 20 ms old
                std::this_thread::yield();
            }
            if ((command.flags & KERF_DEVICE_RUNNING) != 0) hand_.move(command.force, {}, command.device_from_tool);
        }
        has_ticked_ = true;
        const Pose handle = hand_.handle();
        const std::uint32_t buttons = hand_.buttons();
        device_.set_handle(handle, buttons);
        const Pose reported = device_.reported(handle);
        while (!has_arrived(driver_.read(), reported, buttons)) std::this_thread::yield();
        return 0;
    }

private:
    [[nodiscard]] static bool has_arrived(const kerf_device_state& state, const Pose& handle, std::uint32_t buttons) {
        const Quat &a = state.device_from_handle.rotation, &b = handle.rotation;
        return (state.flags & KERF_DEVICE_VALID) != 0 && state.device_from_handle.position == handle.position &&
               a.w == b.w && a.x == b.x && a.y == b.y && a.z == b.z && state.buttons == buttons;
    }

    StandIn& device_;
    RehearsedHandle& hand_;
    DeviceLink& driver_;
    Newest<kerf_device_command>& commands_;
    bool has_ticked_ = false;
};

/// Moves the hand each millisecond of the wall clock, on a thread of its own.
class HandThread {
public:
    HandThread(StandIn& device, RehearsedHandle& hand, Newest<kerf_device_command>& commands)
        : thread_([&device, &hand, &commands, this] {
              auto next = std::chrono::steady_clock::now();
              while (!is_over_.load()) {
                  const kerf_device_command command = commands.get();
                  if ((command.flags & KERF_DEVICE_RUNNING) != 0)
                      hand.move(device.force(), device.torque(), command.device_from_tool);
                  device.set_handle(hand.handle(), hand.buttons());
                  std::this_thread::sleep_until(next += std::chrono::milliseconds(1));
              }
          }) {}
    ~HandThread() {
        is_over_.store(true);
        thread_.join();
    }
    HandThread(const HandThread&) = delete;
    HandThread& operator=(const HandThread&) = delete;

private:
    std::atomic<bool> is_over_{false};
    std::thread thread_;
};

/// The awl in a hurry: its drill is in bone after two seconds.
inline const std::vector<std::string> hurried_awl = {"time_limit=3 s", "rehearsals.expert.hand.feed=10 mm/s",
                                                     "rehearsals.expert.hand.approach=30 mm/s"};

/// Returns the scene of a procedure on a device: of a shipped one by its name, or of a file. Throws std::runtime_error
/// with the diagnostics.
inline Scene scene_on(const DeviceRecord& device, const std::string& procedure,
                      const std::vector<std::string>& settings = {}) {
    text::Diagnostics diagnostics;
    DocumentRequest request{
        .procedure = procedure.ends_with(".yaml") ? procedure : KERF_SOURCE_DIR "/procedures/" + procedure + ".yaml"};
    request.changes.settings = settings;
    auto documents = check_documents(request, test::plugins()).take(diagnostics);
    if (documents) documents->device = &device;
    auto scene = documents ? make_scene(std::move(*documents)).take(diagnostics) : std::nullopt;
    if (!scene) throw std::runtime_error(text::to_text(diagnostics));
    return *std::move(scene);
}

/// Runs a procedure in lock-step, through a driver or directly.
inline RunOutcome run_in_lock_step(const std::string& procedure, const std::vector<std::string>& settings,
                                   StandIn& device, std::unique_ptr<DeviceLink> link) {
    DeviceLink& driver = *link;
    Newest<kerf_device_command> commands;
    const auto watched = opened(std::make_unique<WatchedLink>(std::move(link), commands, true));
    const Scene scene = scene_on(*watched->record(), procedure, settings);
    RehearsedHandle hand(scene);
    LockStepClock clock(device, hand, driver, commands);
    RunRequest request;
    request.observers = {&hand};
    return run_on_clock(scene, test::plugins(), request, clock, *watched, station_in_world());
}
inline RunOutcome run_directly(const std::string& procedure, const std::vector<std::string>& settings,
                               const kerf_device_facts& facts, const StandIn& device) {
    std::string fault;
    const auto stated = StatedDevice::of("double", facts, fault);
    const Scene scene = scene_on(stated->record(), procedure, settings);
    RehearsedHandle hand(scene);
    const auto direct = opened(std::make_unique<DirectLink>(hand, facts, device));
    RunRequest request;
    request.observers = {&hand};
    SteadyClock steady;
    return run_on_clock(scene, test::plugins(), request, steady, *direct, station_in_world());
}

/// A run on the wall clock and its replay.
struct LiveAndAgain {
    RunOutcome live, again;
};

/// Runs a procedure on the wall clock, into a folder, and replays its session.
/// @param knob   of the tool's turn; null: the device leads that, too
/// @param also   a further observer; may be null
inline LiveAndAgain run_live_at(const std::string& procedure, const std::vector<std::string>& settings, StandIn& device,
                                std::unique_ptr<DeviceLink> link, const std::string& folder,
                                std::unique_ptr<DeviceLink> knob = nullptr, RunObserver* also = nullptr) {
    Newest<kerf_device_command> commands;
    const auto watched = opened(std::make_unique<WatchedLink>(std::move(link), commands, false));
    if (knob != nullptr)
        if (const std::string refusal = watched->add_knob(opened(std::move(knob))); !refusal.empty())
            throw std::runtime_error(refusal);
    const Scene scene = scene_on(*watched->record(), procedure, settings);
    RehearsedHandle hand(scene);
    RunRequest request;
    request.observers = {&hand};
    if (also != nullptr) request.observers.push_back(also);
    request.out = folder;
    LiveAndAgain runs;
    {
        const HandThread thread(device, hand, commands);
        runs.live = run_live(scene, test::plugins(), request, *watched, station_in_world());
    }
    runs.again = replayed(scene, inputs_in(folder));
    return runs;
}

/// Runs a hurried awl through a driver and without one, tick by tick, and expects the same bits.
inline void expect_the_bits_of_no_driver(StandIn& device, std::unique_ptr<DeviceLink> link) {
    const kerf_device_facts facts = link->facts();
    const RunOutcome led = run_in_lock_step("pedicle-awl", hurried_awl, device, std::move(link));
    ASSERT_EQ(led.error, "");
    const RunOutcome direct = run_directly("pedicle-awl", hurried_awl, facts, device);
    EXPECT_EQ(direct.summary.ticks, 3000u);
    EXPECT_GT(direct.summary.removed, 0.0) << "the hand has felt bone";
    EXPECT_EQ(led.summary.hash, direct.summary.hash);
}

}  // namespace kerf::run
