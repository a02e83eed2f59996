// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "kerf/abi.h"
#include "kerf/device.hpp"
#include "kerf/math.hpp"

namespace kerf {

/// The result of one tick. Wrenches are in the world frame and in bone newtons, except where a line names another
/// frame or unit. A fast tick has several parts: rates, wrenches and powers are then averages over them.
struct TickResult {
    static constexpr std::size_t max_events = 2 * KERF_MAX_ACTIONS;

    Pose world_from_tool = identity_pose();
    Vec6 rate{};                  ///< of the tool, tool frame
    Vec6 bone_on_tool{};          ///< of channels and following loads, about the tip
    Vec6 coupled_on_hand{};       ///< of the coupling without its limits, about the grip
    Vec6 limited_on_hand{};       ///< of the coupling within its limits, about the grip
    Vec3 released_on_hand{};      ///< part of `limited_on_hand` that the release damper made [N]
    DeviceCommand command;        ///< to the device [device newtons]
    double thrust = 0.0;          ///< [N] of the bone on the tool along the tool's −z: positive resists the feed
    double torque = 0.0;          ///< [N·m] of the bone on the tool about the tool's −z: positive resists the spin
    double power_hand = 0.0;      ///< [W] from the hand into the tool
    int parts = 1;                ///< 1 … 16; the law is evaluated and solved in each
    int iterations = 0;           ///< of the solver, maximum over the parts
    bool is_cutting = false;      ///< the plugin cut along the tool's motion in this tick, through bone or air
    bool is_stripping = false;    ///< the plugin wants the bone around the tool's thread removed: the caller subtracts
                                  ///< the solid `crest_number` at the tool's pose, as `Simulation` does
    bool is_at_metal = false;     ///< the tool meets a body that cannot be cut
    bool is_quarantined = false;  ///< the law was unsound or the solve failed: the tool rests
    bool is_closed_or_closing = false;  ///< the force gate is closing or closed after a fault
    bool is_coming_back = false;        ///< the force gate is opening: the force limit is below the device's own
    /// Event: the force returns after a fault or a pause. The coupling is without stretch at the poses of that tick.
    static constexpr const char* anchored_again = "haptics.anchored_again";
    std::size_t event_count = 0;
    const char* events[max_events]{};

    void add_event(const char* id) noexcept {
        if (event_count < max_events) events[event_count++] = id;
    }
    /// Returns whether the tick has reported this event.   [any]
    [[nodiscard]] bool has_event(std::string_view id) const noexcept {
        return std::find(events, events + event_count, id) != events + event_count;
    }
    /// Adds a wrench of the bone on the tool (tool frame, about the tip) to the sums, times `weight`: the fraction of
    /// the tick that it acts (0 … 1).   [haptic, nonblocking]
    void add_bone_wrench(const Vec6& bone_on_tool_in_tool, double weight, Quat world_from_tool_rotation) noexcept;
};

/// Adds `weight` × `v` to `sum`.   [any] nonblocking
inline void add_scaled(const Vec6& v, double weight, Vec6& sum) noexcept {
    for (std::size_t i = 0; i < 6; ++i) sum[i] += weight * v[i];
}

/// Returns a wrench or rate with both of its vectors rotated.   [any] pure.
[[nodiscard]] inline Vec6 rotated(Quat q, const Vec6& v) noexcept {
    return make_vec6(rotate(q, linear(v)), rotate(q, angular(v)));
}

inline void TickResult::add_bone_wrench(const Vec6& bone, double weight, Quat world_from_tool_rotation) noexcept {
    thrust -= weight * bone[2];
    torque -= weight * bone[5];
    add_scaled(rotated(world_from_tool_rotation, bone), weight, bone_on_tool);
}

}  // namespace kerf
