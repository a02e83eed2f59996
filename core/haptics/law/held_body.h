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

/// Contact points on the surface of a held body, for one grip of it.
struct HeldPoints {
    std::vector<Vec3> points;  ///< tool frame [m]
    std::uint64_t grip = 0;    ///< number of the grip
};

/// The body that the tool grips, with the bodies fused to it: the held bodies. They move rigidly with the tool. Contact
/// with other bodies is found at points on the surface of the held bodies.
class HeldBody {
public:
    using Bodies = std::span<const std::unique_ptr<LiveBody>>;
    /// Maximum number of contact points: about 1.5 mm apart on a piece the size of a hand.
    static constexpr std::size_t max_points = 2048;

    HeldBody();

    [[nodiscard]] bool is_any() const noexcept { return members_ != 0; }
    /// Returns whether a body is held, or fused to the held one.
    [[nodiscard]] bool contains(std::size_t body) const noexcept { return (members_ >> body & 1u) != 0; }
    [[nodiscard]] std::size_t body() const noexcept { return body_; }  ///< id of the gripped body

    /// Grips a body and the bodies fused to it. They have no contact until `set_points` is called.
    /// [haptic, nonblocking]
    void take(Bodies bodies, std::size_t body, const Pose& world_from_tool) noexcept;
    void release() noexcept { members_ = 0; }
    /// Discards the contact points after a change of shape.   [haptic, nonblocking]
    void forget_points() noexcept { count_ = 0; }

    /// Returns contact points on the surface of the held bodies, as committed.   [main] between ticks
    [[nodiscard]] HeldPoints points_of(Bodies bodies) const;
    /// Sets the contact points; needed after `take` and `forget_points`. Ignores those of another grip.
    /// [haptic, nonblocking]
    void set_points(const HeldPoints& found) noexcept;
    [[nodiscard]] bool lacks_points() const noexcept { return is_any() && count_ == 0; }

    /// Moves the held bodies with the tool.   [haptic, nonblocking]
    void move(Bodies bodies, const Pose& world_from_tool) const noexcept;
    /// Returns an upper bound of the distance that a contact point moves between two tool poses [m].
    /// [haptic, nonblocking]
    /// @param from, to  world_from_tool
    [[nodiscard]] double largest_motion(const Pose& from, const Pose& to) const noexcept;
    /// Returns whether the bounding box of the contact points comes within `margin` [m] of another body's box. Errs
    /// towards true.   [haptic, nonblocking]
    [[nodiscard]] bool is_near_another(Bodies bodies, const Pose& world_from_tool, double margin) const noexcept;
    /// Divides the box of the contact points into eight octants. Writes one contact channel for each octant with points
    /// less than 0.3 mm from another body. Returns the number of channels.   [haptic, nonblocking]
    std::size_t add_contact(Bodies bodies, const Pose& world_from_tool, kerf_channel* channels) noexcept;

private:
    std::size_t body_ = 0;
    std::uint64_t grip_ = 0;                    ///< number of grips so far
    std::uint32_t members_ = 0;                 ///< bit i: body i is held
    std::array<Pose, max_bodies> tool_from_{};  ///< tool_from_body of each held body
    std::vector<Vec3> points_;                  ///< tool frame [m]; size `max_points`, the first `count_` are in use
    std::vector<std::uint8_t> octant_;          ///< of each point, 0 … 7
    std::size_t count_ = 0;
    Vec3 low_{}, high_{};  ///< bounding box of the points, tool frame [m]
    std::vector<Vec3> query_points_;
    std::vector<std::uint8_t> query_octants_;
    std::vector<kerf_surface_point> query_results_;
};

}  // namespace kerf
