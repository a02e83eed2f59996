// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "kerf/remesh_mesh.hpp"
#include "swept_burr.h"

namespace kerf::burring::displacement {

using remeshing::Cancelled, remeshing::Outcome;
using remeshing::Triangles;

/// Resolution of a wall.
struct Fineness {
    double tolerance = 0.0;    ///< [m] largest distance of a face from the burr
    double edge = 0.0;         ///< [m] of an equilateral triangle with this distance on a ball
    double bend_cosine = 1.0;  ///< [–] cosine of the dihedral angle between two of them

    /// Returns the resolution for a ball of `radius` R. An equilateral triangle with edge e is off by s = e²/(6 R), and
    /// its neighbour turns by e/(√3 R):
    ///
    ///     e = √(6 R s), at most R/2;   cos θ = 1 − e²/(6 R²)
    [[nodiscard]] static Fineness of(double tolerance, double radius) noexcept;
};

/// Returns whether a face faces the source: seen from there, its corners run anticlockwise.
[[nodiscard]] bool faces(const Source& source, Vec3 a, Vec3 b, Vec3 c) noexcept;

/// Moves a piece of surface onto the burr, along the rays of a source. Its border stays. Faces whose dihedral angle
/// exceeds the limit are refined by 1-to-4 splits with new vertices on the burr. Edges are flipped and vertices moved
/// along the burr where that increases the smallest angles. Declined if a face would turn over.   [worker]
[[nodiscard]] Outcome move_onto_burr(Triangles& wall, const SweptBurr& burr, const Source& source,
                                     const Fineness& fineness, const Cancelled& cancelled, std::string& why);

}  // namespace kerf::burring::displacement
