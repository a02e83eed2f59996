// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/field/cut/bone_view.h"
#include "core/field/cut/piece_mask.h"
#include "core/field/pieces/present_bone.h"

namespace kerf {

inline constexpr std::size_t live_reserve = 512;      ///< bricks ready in a new field
inline constexpr std::size_t bricks_of_a_tick = 128;  ///< kept ready between ticks

/// A body as the loop meets it: its bone, what edges see cut of it, and where it is. Does not move in memory.
struct LiveBody {
    /// Pre: `of_bone` and `solid` outlive it.   [main, worker]
    LiveBody(std::uint16_t number, const Body& of_bone, CutField field, const ToolSolid& solid);
    LiveBody(const LiveBody&) = delete;
    LiveBody& operator=(const LiveBody&) = delete;

    /// Looks for the box again that holds its bone.   [main, worker]
    void find_box();
    /// Whether a box (body frame) comes within `margin` [m] of that.   [haptic, nonblocking]
    [[nodiscard]] bool is_near_box(Vec3 box_low, Vec3 box_high, double margin) const noexcept;
    [[nodiscard]] Pose body_from(const Pose& world_from_tool) const noexcept {
        return inverse(world_from_body) * world_from_tool;
    }

    std::uint16_t id;
    const Body* bone;
    CutField committed;
    CutTracker tracker;
    BoneView view;
    Pose world_from_body = identity_pose();
    Vec3 low{}, high{};       ///< holds its bone, body frame [m]
    std::uint16_t group;      ///< bodies of one group are rigid to each other; its first member's id
    bool is_cuttable = true;  ///< false: metal, which stops what would cut it
    bool is_present = true;   ///< false: taken out of the scene
    bool is_near = true;      ///< of the tool, in this tick
};

/// Of bone with a cut, with room for what is cut next.   [main, worker]
[[nodiscard]] std::unique_ptr<LiveBody> live_body(std::uint16_t number, const Body& of_bone, const CutField& cut,
                                                  const ToolSolid& solid);

}  // namespace kerf
