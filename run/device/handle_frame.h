// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/station.h"
#include "kerf/math.hpp"

/// Where a handle moves the tool, as pure values.
namespace kerf::run {

/// Maps the motion of a handle to that of the tool, from a pair of poses at which they were joined: at the start, after
/// a clutch, and when a lost device comes back. Neither jumps then.   [any]
class HandleFrame {
public:
    HandleFrame(const documents::DeviceStation& station, bool has_rotation) noexcept
        : world_from_device_(station.world_from_device()), scale_(station.scale), has_rotation_(has_rotation) {}

    /// Joins the handle to the tool where both are now.
    void join(const Pose& device_from_handle, const Pose& world_from_tool) noexcept {
        handle_ = device_from_handle.position;
        tool_ = world_from_tool;
        handle_from_tool_ = conjugate(world_from_device_ * device_from_handle.rotation) * world_from_tool.rotation;
    }
    /// Returns the pose that the hand wants for the tool.
    [[nodiscard]] Pose tool_for(const Pose& device_from_handle) const noexcept {
        const Vec3 moved = rotate(world_from_device_, device_from_handle.position - handle_);
        return {tool_.position + scale_ * moved,
                has_rotation_ ? normalized(world_from_device_ * device_from_handle.rotation * handle_from_tool_)
                              : tool_.rotation};
    }
    /// Returns a force or torque of the world in the device's axes.
    [[nodiscard]] Vec3 to_device(Vec3 world) const noexcept { return rotate(conjugate(world_from_device_), world); }
    /// Returns device_from_tool: where the handle would have to be for the tool to be there.
    [[nodiscard]] Pose to_device(const Pose& world_from_tool) const noexcept {
        return {handle_ + (1.0 / scale_) * to_device(world_from_tool.position - tool_.position),
                normalized(conjugate(world_from_device_) * world_from_tool.rotation)};
    }

private:
    Quat world_from_device_;
    double scale_;
    bool has_rotation_;
    Vec3 handle_{};
    Pose tool_ = identity_pose();
    Quat handle_from_tool_{1, 0, 0, 0};
};

}  // namespace kerf::run
