// SPDX-License-Identifier: Apache-2.0
#include "run/live/live_mouse.h"

#include <algorithm>
#include <utility>

namespace kerf::run {

LiveMouse::LiveMouse(MouseBox& box, const Scene& scene, const documents::Rehearsal& rehearsal,
                     const Pose& world_from_tool)
    : box_(&box),
      arm_(arm_at(*scene.device, scene.gains.force_scale)),
      hand_(arm_, world_from_tool, box.get(), HapticLoop::dt),
      totals_(box.get()),
      actions_(totals_.actions),
      undos_(totals_.undos) {
    for (const documents::Step& step : scene.procedure.steps) steps_.push_back({.feed = step.feed});
    for (const documents::Waypoint& waypoint : rehearsal.path)
        steps_[waypoint.step].regrip = std::max(steps_[waypoint.step].regrip, waypoint.regrip);
    follow_step(0);
}

void LiveMouse::continue_at(const Pose& world_from_handle) {
    totals_ = box_->get();
    hand_ = MouseHand(arm_, world_from_handle, totals_, HapticLoop::dt);
    actions_ = totals_.actions;
    undos_ = totals_.undos;
    has_begun_ = false;
}

bool LiveMouse::is_paused() noexcept {
    totals_ = box_->get();
    if (!totals_.is_paused) return false;
    hand_.drop(totals_);
    actions_ = totals_.actions;
    undos_ = totals_.undos;
    return true;
}

void LiveMouse::act(std::uint32_t /*missed*/, const TickResult& /*last*/, LoopInputs& inputs) noexcept {
    hand_.take(totals_);
    const bool is_loose = totals_.is_loose || hand_.is_regripping();
    const bool is_first = !std::exchange(has_begun_, true);
    if (std::exchange(is_loose_, is_loose) != is_loose || is_first) inputs.loosen(is_loose);
    if (std::exchange(is_driving_, totals_.is_driving) != totals_.is_driving || is_first)
        inputs.run_drives(totals_.is_driving);
    if (undos_ != totals_.undos) {
        ++undos_;
        inputs.undo();
    }
    if (actions_ != totals_.actions) {
        ++actions_;
        inputs.next_action();
    }
}

void LiveMouse::feel(const TickResult& result, const HapticLoop& loop) noexcept {
    const Pose& tool = result.world_from_tool;
    hand_.step({.command = result.command,
                .world_from_tool = tool,
                .resistance = length(linear(result.bone_on_tool)),
                .is_force_away = result.is_closed_or_closing,
                .has_thread = loop.outline().has_thread(),
                .is_realigning = loop.is_realigning(),
                .lie = (tool * loop.grasp()).position - tool.position});
}

void LiveMouse::take_tool() noexcept {
    is_driving_ = true;
    is_loose_ = false;
    hand_.take_tool();
}

void LiveMouse::follow_step(std::size_t step) noexcept {
    if (step < steps_.size()) hand_.begin_step(steps_[step].feed, steps_[step].regrip);
}

}  // namespace kerf::run
