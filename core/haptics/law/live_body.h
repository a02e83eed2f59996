// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/field/cut/body_query.h"
#include "core/field/cut/piece_mask.h"
#include "core/field/pieces/present_bone.h"

namespace kerf {

inline constexpr std::size_t live_reserve = 512;      ///< number of free bricks that a new field reserves
inline constexpr std::size_t bricks_of_a_tick = 128;  ///< number of free bricks reserved for the next tick

/// A body in the haptic loop: its bone, the cut that edges read, and its pose. Its address never changes.
struct LiveBody {
    /// `solid` is the cutting solid of the tool. Pre: `of_bone` and `solid` outlive this body.   [main, worker]
    LiveBody(std::uint16_t number, const Body& of_bone, CutField field, const ToolSolid& solid);
    LiveBody(const LiveBody&) = delete;
    LiveBody& operator=(const LiveBody&) = delete;

    /// Recomputes the bounding box of the bricks with bone. Where bone continues beyond the region, the box is widened
    /// by 1 m.   [main, worker]
    void find_box();
    /// Returns whether a box (body frame) comes within `margin` [m] of the bounding box.   [haptic, nonblocking]
    [[nodiscard]] bool is_near_box(Vec3 box_low, Vec3 box_high, double margin) const noexcept;
    [[nodiscard]] Pose body_from(const Pose& world_from_tool) const noexcept {
        return inverse(world_from_body) * world_from_tool;
    }

    std::uint16_t id;
    const Body* bone;
    CutField committed;
    CutTracker tracker;
    BodyQuery view;
    Pose world_from_body = identity_pose();
    Vec3 low{}, high{};       ///< bounding box of its bone, body frame [m]
    std::uint16_t group;      ///< bodies of one group are rigid to each other; id of the group's first member
    bool is_cuttable = true;  ///< false: metal, which stops cutting tools
    bool is_present = true;   ///< false: removed from the scene
    bool is_near = true;      ///< whether the tool is near it in this tick
};

/// Makes a body from a copy of its cut, with `live_reserve` free bricks. `solid` is the cutting solid of the tool.
/// [main, worker]
[[nodiscard]] std::unique_ptr<LiveBody> live_body(std::uint16_t number, const Body& of_bone, const CutField& cut,
                                                  const ToolSolid& solid);

}  // namespace kerf
