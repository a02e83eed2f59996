// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/haptics/law/live_body.h"
#include "core/haptics/law/solve.h"

namespace kerf {

/// What the tool holds: a body, and those it is fused to. They are rigid to the tool, and stopped by other bodies where
/// points of their surface touch them.
class HeldBody {
public:
    using Bodies = std::span<const std::unique_ptr<LiveBody>>;
    /// Points of a surface at most: about 1.5 mm apart on a piece the size of a hand.
    static constexpr std::size_t most_points = 2048;

    HeldBody();

    [[nodiscard]] bool is_any() const noexcept { return members_ != 0; }
    /// Whether a body is held, or fused to the one that is.
    [[nodiscard]] bool holds(std::size_t body) const noexcept { return (members_ >> body & 1u) != 0; }
    [[nodiscard]] std::size_t body() const noexcept { return body_; }  ///< the one that was gripped

    /// It touches nothing until `find_points`.   [haptic, nonblocking]
    void take(Bodies bodies, std::size_t body, const Pose& world_from_tool) noexcept;
    void let_go() noexcept { members_ = 0; }
    /// Its shape has changed.   [haptic, nonblocking]
    void forget_points() noexcept { count_ = 0; }

    /// Where it may touch: on its surface as it is committed, after `take` or a change of its shape.   [main] between
    /// ticks
    void find_points(Bodies bodies);
    [[nodiscard]] bool lacks_points() const noexcept { return is_any() && count_ == 0; }

    /// Puts what is held to where the tool is.   [haptic, nonblocking]
    void move(Bodies bodies, const Pose& world_from_tool) const noexcept;
    /// How far a point of it moves between two poses of the tool, at most [m].   [haptic, nonblocking]
    [[nodiscard]] double largest_motion(const Pose& from, const Pose& to) const noexcept;
    /// Whether it comes within `margin` [m] of another body.   [haptic, nonblocking]
    [[nodiscard]] bool is_near_another(Bodies bodies, const Pose& world_from_tool, double margin) const noexcept;
    /// A contact channel for each of its eight octants that touches: room for `most_held_channels`. How many there are.
    /// [haptic, nonblocking]
    std::size_t add_contact(Bodies bodies, const Pose& world_from_tool, kerf_channel* channels) noexcept;

private:
    std::size_t body_ = 0;
    std::uint32_t members_ = 0;                  ///< a bit for each body
    std::array<Pose, most_bodies> tool_from_{};  ///< each member
    std::vector<Vec3> points_;  ///< tool frame [m]; room for `most_points`, the first `count_` are in use
    std::vector<std::uint8_t> octant_;
    std::size_t count_ = 0;
    Vec3 low_{}, high_{};  ///< a box around them
    std::vector<Vec3> asked_;
    std::vector<std::uint8_t> octant_of_asked_;
    std::vector<kerf_surface_point> answers_;
};

}  // namespace kerf
