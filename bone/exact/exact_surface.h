// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "bone/exact/exact_bone.h"
#include "core/haptics/scene/simulation.h"

namespace kerf::bone {

/// A body's exact surface at the end of a run.
struct ExactPiece {
    std::size_t body = 0;
    TaggedMesh mesh;                                         ///< body frame [m]
    double volume = 0.0;                                     ///< [m³] of the mesh
    double field_volume = 0.0;                               ///< [m³] of the field
    std::vector<std::pair<std::string, double>> wall_areas;  ///< [m²] of walls cut by tools, by tissue
};

/// The result of strategies for a run's cuts.
struct ExactSurface {
    std::vector<ExactPiece> pieces;                     ///< one for each remaining body of bone, by number
    std::size_t records = 0;                            ///< of the cut log, that changed bone
    std::size_t stretches = 0;                          ///< straight stretches that the records were joined into
    double base_volume = 0.0, field_base_volume = 0.0;  ///< [m³] before the first cut
    double removed = 0.0, field_removed = 0.0;          ///< [m³] by tools, without crumbs
    double allowed = 0.0;       ///< [m³] allowed difference of the two on all walls: 0.15 voxels and the strategies'
                                ///< tolerances
    std::size_t crumbs = 0;     ///< parts of the mesh without a body in the field
    double crumb_volume = 0.0;  ///< [m³]
    int refusals = 0;           ///< results that the host refused and requested again
    int handed_over = 0;        ///< stretches that a strategy did not cut and a later one received
    std::uint64_t digest = 0;   ///< of all pieces; not in the replay hash
    std::vector<std::string> notes;  ///< for people
    std::string error;               ///< if not empty, there is no exact surface; for people
};

/// The bodies of bone at one time.
struct ExactState {
    std::vector<ExactBody> bodies;  ///< by number
    bool may_return = false;        ///< bone may return to this state, because the tool is in no cut
};

/// Returns the present bodies.   [main]
/// @param with_cuts  also copies their cuts
[[nodiscard]] ExactState exact_state(const Simulation& simulation, bool with_cuts);

/// The exact surfaces of all bone of a run. Each begins with the anatomy's own surface, or without one with the
/// field's, and is cut along all records of its body in the log.   [worker]
class ExactSurfaces {
public:
    explicit ExactSurfaces(ExactTools tools);

    /// Follows the bodies to their present state. Pre: with their cuts, unless they are the same as in the last call.
    void follow(const ExactState& state);
    /// Follows the bodies and returns the surface of each. Pre: with their cuts; called once.
    [[nodiscard]] ExactSurface finish(const ExactState& state);

    /// Returns the surfaces by body, with waiting records cut into them.
    [[nodiscard]] std::vector<std::pair<std::size_t, LocalCutting::Moment>> shown();

private:
    struct Bone {
        const Body* field;
        std::unique_ptr<ExactBone> surface;  ///< null: it cannot be cut
        std::vector<std::string> notes;
        std::string error;
    };
    [[nodiscard]] Bone& bone(const Body& field);

    ExactTools tools_;
    std::vector<Bone> bones_;
};

/// Returns the exact surface at the end of a run.   [main]
[[nodiscard]] ExactSurface exact_surface(const Simulation& simulation, ExactTools tools);

}  // namespace kerf::bone
