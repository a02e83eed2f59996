// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kerf/draft/remesh.h"
#include "kerf/math.hpp"

/// What tools sweep, as convex parts.
namespace kerf::remesh_cgal {

/// The corners of a convex solid; its surface is their convex hull. Body frame [m].
using ConvexPart = std::vector<Vec3>;

/// The cutting part of a tool, tool frame.
struct CutSolid {
    std::span<const kerf_profile_point> profile;
    double kerf = 0.0;  ///< [m] of a prism; 0: a solid of revolution
};

/// Returns the parts that a solid sweeps on a straight stretch: of each convex part of the solid the hull of both ends.
/// A solid of revolution becomes a prism of many sides with the same cross-section area, whose sides are off by
/// `tolerance` [m] at most. A part begins 0.1 µm smaller than it ends: then the walls of a stretch lie within those of
/// the one before, and no two faces lie in one plane, which exact arithmetic survives but takes minutes for.
/// [any] pure.
/// @param nudge   0, or a seed: then both ends are moved by up to 0.1 µm in some direction
[[nodiscard]] std::vector<ConvexPart> swept_parts(const CutSolid& solid, const Pose& from, const Pose& to,
                                                  double tolerance, std::uint64_t nudge);

}  // namespace kerf::remesh_cgal
