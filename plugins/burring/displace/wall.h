// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "kerf/remesh_mesh.hpp"
#include "swept_burr.h"

namespace kerf::burring::displacement {

using remeshing::Triangles;
using Cancelled = std::function<bool()>;

enum class Outcome { cut, unchanged, declined, refused, cancelled };

/// How fine a wall is.
struct Fineness {
    double tolerance = 0.0;    ///< [m] that a face may be off the burr
    double edge = 0.0;         ///< [m] of a triangle of equal sides that is off by so much on a ball
    double bend_cosine = 1.0;  ///< [–] of the dihedral angle between two of them

    /// For a ball of radius R a triangle with sides e is off by s = e²/(6 R), and its neighbour turns by e/(√3 R):
    ///
    ///     e = √(6 R s), at most R/2;   cos θ = 1 − e²/(6 R²)
    [[nodiscard]] static Fineness of(double tolerance, double radius) noexcept;
};

/// Whether a face looks at the source: its triangles are seen from there anticlockwise.
[[nodiscard]] bool faces(const Source& source, Vec3 a, Vec3 b, Vec3 c) noexcept;

/// Moves a piece of surface onto the burr, along the rays of a source. Its border stays. Then refines it where two
/// faces bend by more than the limit, by 1-to-4 splits with new vertices on the burr; flips edges and moves vertices
/// along the burr where that makes least angles larger. Declined: a face would turn over.   [worker]
[[nodiscard]] Outcome move_onto_burr(Triangles& wall, const SweptBurr& burr, const Source& source,
                                     const Fineness& fineness, const Cancelled& cancelled, std::string& why);

}  // namespace kerf::burring::displacement
