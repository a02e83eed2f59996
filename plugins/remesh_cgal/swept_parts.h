// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kerf/math.hpp"
#include "kerf/remesh.h"

/// Swept volumes of tools, as convex parts.
namespace kerf::remesh_cgal {

/// The corners of a convex solid; its surface is their convex hull. Body frame [m].
using ConvexPart = std::vector<Vec3>;

/// The cutting part of a tool, tool frame.
struct CutSolid {
    std::span<const kerf_profile_point> profile;
    double kerf = 0.0;  ///< [m] of a prism; 0: a solid of revolution
};

/// Random shift of both ends of a stretch; its direction follows from seed and pose.
struct Nudge {
    std::uint64_t seed = 0;
    double largest = 0.0;  ///< [m]

    /// Returns no shift at first, 0.1 µm after a refusal, 1 µm after the third.
    static Nudge of(std::uint64_t seed) noexcept { return {seed, seed == 0 ? 0.0 : seed < 3 ? 1e-7 : 1e-6}; }
};

/// Returns the parts that a solid sweeps on a straight stretch: for each convex part of the solid, the hull of both
/// ends. A solid of revolution becomes a prism with many sides and the same cross-section area. Its sides are off by
/// `tolerance` [m] at most.
///
/// No two faces should lie in one plane, because exact arithmetic then takes minutes and rounding decides wrongly. So
/// the end of a part is smaller on each side by up to 0.04 µm, an amount that follows from the pose. Its beginning is
/// smaller by 0.06 µm more, so the walls of a stretch begin within those of the one before.   [any] pure.
[[nodiscard]] std::vector<ConvexPart> swept_parts(const CutSolid& solid, const Pose& from, const Pose& to,
                                                  double tolerance, const Nudge& nudge);

}  // namespace kerf::remesh_cgal
