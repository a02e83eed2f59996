// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/haptics/live_body.h"
#include "core/haptics/solve.h"

namespace kerf {

/// What the tool holds: rigid to it, and stopped by other bodies where points of its surface touch them.
class HeldBody {
public:
    /// Points of a surface at most: about 1.5 mm apart on a piece the size of a hand.
    static constexpr std::size_t most_points = 2048;

    HeldBody();

    [[nodiscard]] bool is_any() const noexcept { return body_ >= 0; }
    [[nodiscard]] bool is(std::size_t body) const noexcept { return body_ == static_cast<int>(body); }
    [[nodiscard]] std::size_t body() const noexcept { return static_cast<std::size_t>(body_); }

    /// It touches nothing until `find_points`.   [haptic, nonblocking]
    void take(const LiveBody& body, const Pose& world_from_tool) noexcept;
    void let_go() noexcept { body_ = -1; }
    /// Its shape has changed.   [haptic, nonblocking]
    void forget_points() noexcept { count_ = 0; }

    /// Where it may touch: of its surface as `cut` says, after `take` or a change of its shape.   [main] between ticks
    void find_points(const LiveBody& body, const CutField& cut);
    [[nodiscard]] bool lacks_points() const noexcept { return is_any() && count_ == 0; }

    /// Where it is when the tool is there.   [haptic, nonblocking]
    [[nodiscard]] Pose world_from_body(const Pose& world_from_tool) const noexcept { return world_from_tool * tool_from_body_; }
    /// How far a point of it moves between two poses of the tool, at most [m].   [haptic, nonblocking]
    [[nodiscard]] double largest_motion(const Pose& from, const Pose& to) const noexcept;
    /// Whether it comes within `margin` [m] of another body.   [haptic, nonblocking]
    [[nodiscard]] bool is_near_another(std::span<const std::unique_ptr<LiveBody>> bodies, const Pose& world_from_tool, double margin) const noexcept;
    /// A contact channel for each of its eight octants that touches: room for `most_held_channels`. How many there are.
    /// [haptic, nonblocking]
    std::size_t add_contact(std::span<const std::unique_ptr<LiveBody>> bodies, const Pose& world_from_tool, kerf_channel* channels) noexcept;

private:
    int body_ = -1;
    Pose tool_from_body_ = identity_pose();
    std::vector<Vec3> in_body_;  ///< room for `most_points`; the first `count_` are in use
    std::vector<std::uint8_t> octant_;
    std::size_t count_ = 0;
    Vec3 low_{}, high_{};  ///< a box around them, body frame [m]
    std::vector<Vec3> asked_;  ///< tool frame
    std::vector<std::uint8_t> octant_of_asked_;
    std::vector<kerf_surface_point> answers_;
};

}  // namespace kerf
