// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/haptics/simulation.h"
#include "core/remesh/remesh_child.h"
#include "run/scene.h"

namespace kerf {

/// A body's exact surface at the end of a run.
struct ExactPiece {
    std::size_t body = 0;
    TaggedMesh mesh;            ///< body frame [m]
    double volume = 0.0;        ///< [m³] of the mesh
    double field_volume = 0.0;  ///< [m³] of the field
    double wall_area = 0.0;     ///< [m²] of what tools left
};

/// What a strategy made of a run's cuts.
struct ExactSurface {
    std::vector<ExactPiece> pieces;                     ///< one for each body of bone that is left, by number
    std::size_t records = 0;                            ///< of the cut log that changed bone
    std::size_t stretches = 0;                          ///< straight ones that they were joined into
    double base_volume = 0.0, field_base_volume = 0.0;  ///< [m³] before the first cut
    double removed = 0.0, field_removed = 0.0;          ///< [m³] without crumbs
    double allowed = 0.0;                               ///< [m³] by which the two may differ: 0.15 voxels on all walls
    std::size_t crumbs = 0;                             ///< parts of the mesh in which the field has no body
    double crumb_volume = 0.0;                          ///< [m³]
    int refusals = 0;                                   ///< results that the host did not take, and asked for again
    std::uint64_t digest = 0;                           ///< of all pieces; no part of the replay hash
    std::vector<std::string> notes;                     ///< for people
    std::string error;                                  ///< not empty: there is no exact surface; for people
};

struct ExactOptions {
    double tolerance = 20e-6;  ///< [m] that a straight stretch may be off the recorded path
    std::chrono::milliseconds limit = std::chrono::minutes(5);  ///< for one answer
    std::function<void(double fraction, const std::string& what)> progress{};
    std::function<bool()> is_cancelled{};  ///< asked before each request
};

/// Makes the exact surface of what a run has left: the anatomy's own surface, or the field's where the anatomy has
/// none, cut by all that the log holds of each body. The field decides which bodies there are: each part of the mesh
/// belongs to the body on whose surface it lies.   [main]
[[nodiscard]] ExactSurface exact_surface(const Scene& scene, const Simulation& simulation, RemeshChild& child,
                                         const ExactOptions& options = {});

}  // namespace kerf
