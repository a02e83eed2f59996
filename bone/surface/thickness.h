// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "bone/surface/triangle_tree.h"

/// How thick the bone is under its surface: straight inwards to the wall on the other side.
namespace kerf {

struct WallSample {
    double thickness = 0.0;  ///< [m]
    double area = 0.0;       ///< [m²] of surface it stands for
    Vec3 at{};               ///< [m] on the surface
};

/// At points of the surface in `region`, at most about `fineness` [m] apart and no more than 256 on a face. Left out is
/// what is no wall but a crest: where the surface on the other side leans by more than 37°.
/// In the order of the faces.   Pre: closed, metres.   [any] pure.
[[nodiscard]] std::vector<WallSample> measure_walls(const SurfaceMesh& mesh, const TriangleTree& tree,
                                                    const Box& region, double fineness);

/// The thinnest; empty if there is none.
[[nodiscard]] std::optional<WallSample> thinnest(const std::vector<WallSample>& walls);
/// The thickness that `share` [–] of the area does not reach; 0 without samples.
[[nodiscard]] double thickness_at(const std::vector<WallSample>& walls, double share);
/// The share [–] of the area that is thinner than `limit` [m].
[[nodiscard]] double share_under(const std::vector<WallSample>& walls, double limit);

}  // namespace kerf
