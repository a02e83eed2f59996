// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "core/field/cut/cut_log.h"

/// What the pending solids leave standing, as contact meets it.
namespace kerf {

/// Made once for all points that are asked about at one pose.
///
/// A pending solid is the surface at a point that is deeper in it than the distance found before. Depths are taken in
/// single precision, from the tool's origin: 2 nm at 10 mm, a tenth of the step of a stored distance.
class PendingSurface {
public:
    PendingSurface(const CutTracker& tracker, const Pose& body_from_tool) noexcept;

    /// Raises the answers for `count` ≤ `block_capacity` points of the tool that lie in `box`; none of them is less
    /// than `least` [m]. `may_rise`, where given, tells which.   [haptic, nonblocking]
    void raise(const Vec3* points, std::size_t count, const PointBox& box, double least, const bool* may_rise,
               kerf_surface_point* answers) noexcept;

private:
    const CutTracker* tracker_;
    Pose body_from_tool_;
    Frame newest_from_tool_{};
    double clamp_;
    std::array<SingleFrame, CutTracker::pending_capacity>
        frames_;  ///< of the solids, the newest first; from when they are needed
    std::size_t frame_count_ = 0;
};

}  // namespace kerf
