// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/station.h"
#include "kerf/math.hpp"

/// The motion of the tool for a motion of the handle, as pure values.
namespace kerf::run {

/// Maps the motion of a handle to that of the tool, from a pair of poses at which they were joined: at the start, after
/// a clutch, and when a lost device comes back. Neither jumps then. The origin of the handle is the point of the tool
/// that the hand grips.   [any]
class HandleFrame {
public:
    HandleFrame(const documents::DeviceStation& station, bool has_rotation) noexcept
        : world_from_device_(station.world_from_device()), scale_(station.scale), has_rotation_(has_rotation) {}

    /// Joins the handle to the tool at these poses.
    /// @param grip  point that the hand grips, tool frame [m]
    void join(const Pose& device_from_handle, const Pose& world_from_tool, Vec3 grip) noexcept {
        grip_ = grip;
        handle_ = device_from_handle.position;
        tool_rotation_ = world_from_tool.rotation;
        held_ = world_from_tool * grip;
        handle_from_tool_ = conjugate(world_from_device_ * device_from_handle.rotation) * world_from_tool.rotation;
    }
    /// Returns the pose that the hand wants for the tool.
    [[nodiscard]] Pose tool_for(const Pose& device_from_handle) const noexcept {
        const Vec3 moved = rotate(world_from_device_, device_from_handle.position - handle_);
        const Quat rotation = has_rotation_
                                  ? normalized(world_from_device_ * device_from_handle.rotation * handle_from_tool_)
                                  : tool_rotation_;
        return {held_ + scale_ * moved - rotate(rotation, grip_), rotation};
    }
    /// Returns a force or torque of the world in the device's axes.
    [[nodiscard]] Vec3 to_device(Vec3 world) const noexcept { return rotate(conjugate(world_from_device_), world); }
    /// Returns device_from_tool. In air the tool's grip is at the origin of the handle.
    [[nodiscard]] Pose to_device(const Pose& world_from_tool) const noexcept {
        const Quat rotation = normalized(conjugate(world_from_device_) * world_from_tool.rotation);
        const Vec3 held = handle_ + (1.0 / scale_) * to_device(world_from_tool * grip_ - held_);
        return {held - rotate(rotation, grip_), rotation};
    }

private:
    Quat world_from_device_;
    double scale_;
    bool has_rotation_;
    Vec3 grip_{}, handle_{}, held_{};  ///< tool, device and world frame [m]
    Quat tool_rotation_{1, 0, 0, 0}, handle_from_tool_{1, 0, 0, 0};
};

}  // namespace kerf::run
