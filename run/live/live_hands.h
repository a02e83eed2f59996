// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "run/device/device_hand.h"
#include "run/device/opened_device.h"
#include "run/live/live_hand.h"
#include "run/rehearsed_hand.h"

namespace kerf::run {

/// The hand of a rehearsal, at a loop on the clock.
class LiveRehearsal final : public LiveHand {
public:
    /// Pre: `plan` outlives this object.
    explicit LiveRehearsal(const HandPlan& plan) : hand_(plan) {}
    void act(std::uint32_t missed, const TickResult& last, LoopInputs& inputs) noexcept override;
    [[nodiscard]] DeviceSample sample(const HapticLoop& /*loop*/) noexcept override {
        return {.world_from_handle = hand_.reported()};
    }
    void take_tool() noexcept override { hand_.take_tool(); }
    void wait(bool waits) noexcept override { hand_.wait(waits); }
    [[nodiscard]] std::size_t milestone() const noexcept override { return hand_.leg(); }
    void feel(const TickResult& result, const HapticLoop& loop) noexcept override { hand_.feel(result, loop); }
    [[nodiscard]] std::optional<RunEnd> end() const noexcept override {
        return hand_.is_done() ? std::optional(RunEnd::path_ended) : std::nullopt;
    }

private:
    RehearsedHand hand_;
};

/// A hand at a device. A device that is silent for 10 s ends the run.
class LiveDevice final : public LiveHand {
public:
    /// Pre: `device` outlives this object.
    /// @param arm  of the simulated hand that a device without force moves
    LiveDevice(OpenedDevice& device, const documents::DeviceStation& station, const Pose& world_from_tool,
               const Arm& arm)
        : device_(&device), hand_(station, device.facts(), world_from_tool, arm) {}
    void act(std::uint32_t missed, const TickResult& last, LoopInputs& inputs) noexcept override;
    [[nodiscard]] DeviceSample sample(const HapticLoop& loop) noexcept override {
        return hand_.take(device_->read(), {0, 0, loop.outline().handling.grip_z});
    }
    void feel(const TickResult& result, const HapticLoop& loop) noexcept override {
        device_->write(hand_.command(result, loop.ticks()));
    }
    void take_tool() noexcept override { is_driving_ = true; }
    [[nodiscard]] std::optional<RunEnd> end() const noexcept override {
        return hand_.is_silent(max_silence) ? std::optional(RunEnd::device_silent) : std::nullopt;
    }
    void rest() noexcept override;

private:
    static constexpr std::uint64_t max_silence = 10'000;  // ticks

    OpenedDevice* device_;
    DeviceHand hand_;
    bool is_driving_ = true;  ///< the drives of the tool in hand are as configured; false: they are off
};

}  // namespace kerf::run
