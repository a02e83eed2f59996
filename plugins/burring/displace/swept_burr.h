// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kerf/math.hpp"
#include "kerf/remesh.h"

namespace kerf::burring::displacement {

/// A straight line inside the swept burr. Rays leave it at right angles, and at its ends in all directions away from
/// it. A convex body has one surface point on each ray.
struct Source {
    Vec3 from{}, to{};  ///< body frame [m]; equal for a point

    [[nodiscard]] Vec3 nearest(Vec3 point) const noexcept;
};

/// The volume that a convex solid of revolution sweeps on a straight stretch.
class SweptBurr {
public:
    /// Returns the swept burr. Returns nothing, with the reason, for a prism, for an outline that is not convex to 1
    /// nm, has fewer than two points or no volume, and for a pose that is not finite.
    static std::optional<SweptBurr> make(std::span<const kerf_profile_point> outline, double kerf, const Pose& from,
                                         const Pose& to, std::string& why);

    /// Returns a lower bound of a point's distance outside [m]; negative inside. It is convex along any line, and
    /// changes no faster than the point moves. Accuracy: 0.1 nm.   [any] pure.
    [[nodiscard]] double outside(Vec3 point) const noexcept;

    /// A lower bound of `outside` near a point: `at` + slope · (offset from the point) [m].
    struct Bound {
        double at;
        Vec3 slope;
    };
    /// Returns a bound for all points that is exact at `point`, to 0.1 nm. Pre: turns_little().   [any] pure.
    [[nodiscard]] Bound outside_lower_bound(Vec3 point) const noexcept;
    /// Returns whether the burr turns by less than 0.04 rad on the stretch, so that its sweep is convex to 2 µm.
    [[nodiscard]] bool is_nearly_straight() const noexcept { return is_nearly_straight_; }

    /// Returns the point on the ray from a source through a point where the ray leaves the burr.
    /// Pre: the source lies inside.   [any] pure.
    [[nodiscard]] Vec3 exit(const Source& source, Vec3 through) const noexcept;
    /// Returns the surface point between a point inside and one that is not.   [any] pure.
    [[nodiscard]] Vec3 crossing(Vec3 inside, Vec3 other) const noexcept;

    /// Returns sources along the tool's axis, at several heights and at several fractions of the stretch. All lie
    /// inside.
    [[nodiscard]] std::vector<Source> sources() const;

    [[nodiscard]] double largest_radius() const noexcept { return largest_radius_; }  ///< [m]

private:
    /// A face of the solid, in the plane of its outline: across · r + along · z ≤ offset.
    struct Face {
        double across, along, offset;
    };
    /// Outside value of a point at one pose [m], and its derivative with respect to t [m].
    struct Instant {
        double t, outside, slope;
        Vec3 normal;  ///< gradient with respect to the point, body frame [–]
    };
    /// Two instants around the minimum; at an end of the stretch the same instant twice.
    struct Minimum {
        double outside;
        Instant low, high;
    };
    [[nodiscard]] Minimum minimum(Vec3 point) const noexcept;
    [[nodiscard]] Minimum min_between(Instant low, Instant high, Vec3 point) const noexcept;
    [[nodiscard]] Instant at(double t, Vec3 point) const noexcept;
    [[nodiscard]] Vec3 in_tool(double t, Vec3 point) const noexcept;
    [[nodiscard]] Pose pose_at(double t) const noexcept;

    std::vector<Face> faces_;
    Pose from_{}, to_{};
    Vec3 travel_in_tool_{};
    bool turns_ = false, is_nearly_straight_ = true;
    int pieces_ = 1;                ///< of the stretch; the burr hardly turns within one
    double tip_ = 0.0, end_ = 0.0;  /// z [m]
    double largest_radius_ = 0.0;
};

}  // namespace kerf::burring::displacement
