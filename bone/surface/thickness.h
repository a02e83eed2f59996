// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "bone/surface/triangle_tree.h"

/// Thickness of the bone under its surface: straight inwards to the opposite wall.
namespace kerf::bone {

struct WallSample {
    double thickness = 0.0;  ///< [m]
    double area = 0.0;       ///< [m²] of surface that the sample represents
    Vec3 at{};               ///< [m] on the surface
};

/// Returns samples of the thickness at points of the surface in `region`, at most about `fineness` [m] apart and at
/// most 256 on a face. Crests are left out: points whose opposite surface is inclined by more than 37°. In the order of
/// the faces. Pre: closed, metres.   [any] pure.
[[nodiscard]] std::vector<WallSample> measure_walls(const SurfaceMesh& mesh, const TriangleTree& tree,
                                                    const Box& region, double fineness);

/// Returns the thinnest sample; nothing without samples.
[[nodiscard]] std::optional<WallSample> thinnest(const std::vector<WallSample>& walls);
/// Returns the thickness [m] below which a given fraction [–] of the area lies; 0 without samples.
[[nodiscard]] double thickness_at(const std::vector<WallSample>& walls, double fraction);
/// Returns the fraction [–] of the area that is thinner than `limit` [m].
[[nodiscard]] double fraction_under(const std::vector<WallSample>& walls, double limit);

}  // namespace kerf::bone
