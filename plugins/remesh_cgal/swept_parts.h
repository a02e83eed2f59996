// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kerf/math.hpp"
#include "kerf/remesh.h"

/// What tools sweep, as convex parts.
namespace kerf::remesh_cgal {

/// The corners of a convex solid; its surface is their convex hull. Body frame [m].
using ConvexPart = std::vector<Vec3>;

/// The cutting part of a tool, tool frame.
struct CutSolid {
    std::span<const kerf_profile_point> profile;
    double kerf = 0.0;  ///< [m] of a prism; 0: a solid of revolution
};

/// By how much both ends of a stretch are moved, each in some direction that follows from seed and pose.
struct Nudge {
    std::uint64_t seed = 0;
    double most = 0.0;  ///< [m]

    /// Nothing at first. After a refusal 0.1 µm, after the third 1 µm.
    static Nudge of(std::uint64_t seed) noexcept { return {seed, seed == 0 ? 0.0 : seed < 3 ? 1e-7 : 1e-6}; }
};

/// Returns the parts that a solid sweeps on a straight stretch: of each convex part of the solid the hull of both ends.
/// A solid of revolution becomes a prism of many sides with the same cross-section area, whose sides are off by
/// `tolerance` [m] at most.
///
/// No two faces should lie in one plane: exact arithmetic takes minutes for that, and rounding decides wrongly. So a
/// part is smaller on each side by up to 0.04 µm at its end, by how much follows from the pose, and by 0.06 µm more at
/// its beginning: the walls of a stretch begin within those of the one before.   [any] pure.
[[nodiscard]] std::vector<ConvexPart> swept_parts(const CutSolid& solid, const Pose& from, const Pose& to,
                                                  double tolerance, const Nudge& nudge);

}  // namespace kerf::remesh_cgal
