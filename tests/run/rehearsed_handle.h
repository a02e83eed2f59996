// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "devices/simulated_hand/simulated_hand.h"
#include "kerf/device.h"
#include "run/rehearsed_hand.h"
#include "run/run_observer.h"
#include "run/scene.h"

namespace kerf::run {

/// The simulated hand of a scene's first rehearsal at the handle of a device, in the frame of the world: the force that
/// the device makes moves it. One thread moves it.
class RehearsedHandle final : public RunObserver {
public:
    explicit RehearsedHandle(const Scene& scene)
        : scene_(scene),
          plan_(plan_of(scene.procedure.rehearsals.front(), scene)),
          hand_(plan_.plant, plan_.intent, plan_.start, 1e-3) {
        lead();
    }

    /// Takes another tool as soon as the run has.   [the run's thread]
    void on_event(const session::EventRow& event) override {
        if (event.id != "tool.taken") return;
        for (std::size_t step = 0; step < scene_.procedure.steps.size(); ++step)
            if (scene_.procedure.steps[step].instrument == event.detail) step_.store(step);
    }

    /// Returns where the handle is: where the hand grips the first tool. The hand takes another tool where the handle
    /// is.
    [[nodiscard]] Pose handle() const noexcept { return handle_; }
    /// Returns the buttons of a tick: 0 is held; 1 is pressed for one tick at each waypoint with an action.
    [[nodiscard]] std::uint32_t buttons() noexcept {
        std::uint32_t pressed = 1u;
        if (hand_.leg() < legs_pressed_) return pressed;
        const std::size_t leg = hand_.leg();
        legs_pressed_ = leg + 1;
        if (leg < plan_.inputs.size() && !plan_.inputs[leg].empty()) pressed |= 2u;
        return pressed;
    }
    /// Moves the hand by a millisecond.
    /// @param force, torque  that the device makes [N, N·m], world frame
    /// @param tool           frame of the device
    void move(Vec3 force, Vec3 torque, const Pose& tool) noexcept {
        take_tool();
        DeviceCommand rendered;
        rendered.wrench = make_vec6(force, torque);
        hand_.step(rendered, simulated_hand::SensedTool{.world_from_tool = {tool.position - offset_, tool.rotation}});
        lead();
    }

private:
    /// Returns where the hand grips the tool, frame of the world.
    [[nodiscard]] Vec3 grip() const noexcept {
        return hand_.reported() * Vec3{0, 0, scene_.tool(step_in_hand_).outline.handling.grip_z};
    }
    /// Takes the tool that the run has given. The handle stays where it is.
    void take_tool() noexcept {
        const std::size_t step = step_.load();
        if (step == step_in_hand_) return;
        step_in_hand_ = step;
        offset_ = handle_.position - grip();
    }
    /// Moves the handle to where the hand now has it.
    void lead() noexcept { handle_ = {grip() + offset_, hand_.reported().rotation}; }

    const Scene& scene_;
    HandPlan plan_;
    simulated_hand::SimulatedHand hand_;
    std::size_t legs_pressed_ = 0;
    std::atomic<std::size_t> step_{0};  ///< of the tool that the run has given
    std::size_t step_in_hand_ = 0;
    Vec3 offset_{};  ///< [m] from the grip of the tool in hand to the handle: from the world to the device
    Pose handle_{};
};

}  // namespace kerf::run
