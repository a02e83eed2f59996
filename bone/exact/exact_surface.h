// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "bone/exact/exact_bone.h"
#include "core/haptics/scene/simulation.h"

namespace kerf {

/// A body's exact surface at the end of a run.
struct ExactPiece {
    std::size_t body = 0;
    TaggedMesh mesh;                                         ///< body frame [m]
    double volume = 0.0;                                     ///< [m³] of the mesh
    double field_volume = 0.0;                               ///< [m³] of the field
    std::vector<std::pair<std::string, double>> wall_areas;  ///< [m²] of what tools left, by tissue
};

/// What strategies made of a run's cuts.
struct ExactSurface {
    std::vector<ExactPiece> pieces;                     ///< one for each body of bone that is left, by number
    std::size_t records = 0;                            ///< of the cut log that changed bone
    std::size_t stretches = 0;                          ///< straight ones that they were joined into
    double base_volume = 0.0, field_base_volume = 0.0;  ///< [m³] before the first cut
    double removed = 0.0, field_removed = 0.0;          ///< [m³] by tools, without crumbs
    double allowed = 0.0;    ///< [m³] by which the two may differ, on all walls: 0.15 voxels and what strategies state
    std::size_t crumbs = 0;  ///< parts of the mesh in which the field has no body
    double crumb_volume = 0.0;       ///< [m³]
    int refusals = 0;                ///< results that the host did not take, and asked for again
    int handed_over = 0;             ///< stretches that a strategy did not cut and a later one got
    std::uint64_t digest = 0;        ///< of all pieces; no part of the replay hash
    std::vector<std::string> notes;  ///< for people
    std::string error;               ///< not empty: there is no exact surface; for people
};

/// The bodies of bone at one time.
struct ExactState {
    std::vector<ExactBody> bodies;  ///< by number
    bool may_return = false;        ///< the bone may come back to this state: the tool is in no cut
};

/// Returns the bodies as they are now.   [main]
/// @param with_cuts   and copies of their cuts
[[nodiscard]] ExactState exact_state(const Simulation& simulation, bool with_cuts);

/// The exact surfaces of all bone of a run: the anatomy's own surface, or the field's where the anatomy has none, cut
/// by all that the log holds of each body.   [worker]
class ExactSurfaces {
public:
    explicit ExactSurfaces(ExactTools tools);

    /// Follows the bodies to where they are now. Pre: with their cuts unless they are the same as at the last call.
    void follow(const ExactState& state);
    /// Follows, and returns the surface of each body. Pre: with their cuts; called once.
    [[nodiscard]] ExactSurface finish(const ExactState& state);

    /// The surfaces with what waits cut into them, by body.
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

/// Makes the exact surface of what a run has left.   [main]
[[nodiscard]] ExactSurface exact_surface(const Simulation& simulation, ExactTools tools);

}  // namespace kerf
