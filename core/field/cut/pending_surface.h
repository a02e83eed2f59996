// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "core/field/cut/cut_log.h"

/// The surface that pending solids leave, for contact queries.
namespace kerf {

/// Made once for all points that are queried at one pose.
///
/// The present distance of a point is the larger of its signed distance to the committed surface and its depth in any
/// pending solid. Depths are computed in single precision, relative to the tool's origin. Their error is 2 nm at 10 mm,
/// a tenth of the quantum of a stored distance.
class PendingSurface {
public:
    PendingSurface(const CutTracker& tracker, const Pose& body_from_tool) noexcept;

    /// Raises the distance of each answer to the greatest depth of its point in a pending solid, which is negative
    /// outside it, where that is larger. The normal is then that solid's, and the body 0; at the clamp or beyond, none.
    /// The `count` ≤ `block_capacity` points, tool frame, lie in `box`. Pre: no distance in `answers` is less than
    /// `minimum` [m]. If `may_rise` is given, only answers with true change. [haptic, nonblocking]
    void raise(const Vec3* points, std::size_t count, const PointBox& box, double minimum, const bool* may_rise,
               kerf_surface_point* answers) noexcept;

private:
    const CutTracker* tracker_;
    Pose body_from_tool_;
    Frame newest_from_tool_{};
    double clamp_;
    std::array<SingleFrame, CutTracker::pending_capacity> frames_;  ///< of the solids, newest first; computed on demand
    std::size_t frame_count_ = 0;
};

}  // namespace kerf
