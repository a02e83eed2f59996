// SPDX-License-Identifier: Apache-2.0
#include "run/device/fitted_handle.h"

#include <algorithm>

namespace kerf::run {

namespace {

constexpr double rise_per_tick = 1.0 / 500.0;  // [–] of the weight

}  // namespace

void FittedHandle::take(kerf_device_state& state) noexcept {
    is_there_ = (state.flags & KERF_DEVICE_VALID) != 0;
    if (!is_there_) return;
    lever_ = rotate(state.device_from_handle.rotation, fit_.grip);
    state.device_from_handle.position = state.device_from_handle.position + lever_;
}

kerf_device_command FittedHandle::give(kerf_device_command command) noexcept {
    const bool is_carrying = is_there_ && (command.flags & KERF_DEVICE_RUNNING) != 0;
    carried_ = is_carrying ? std::min(1.0, carried_ + rise_per_tick) : 0.0;
    command.force.y += carried_ * fit_.weight();
    if (peak_torque_ <= 0.0) return command;
    const Vec3 torque = command.torque + cross(lever_, command.force);
    command.torque = std::min(1.0, peak_torque_ / std::max(length(torque), peak_torque_)) * torque;
    return command;
}

}  // namespace kerf::run
