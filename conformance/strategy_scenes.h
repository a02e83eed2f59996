// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bone/remesh/remesh_request.h"

namespace kerf::conformance {

/// A cut in a slab of bone whose removed volume follows from a formula.
struct RemeshScene {
    std::string name;  ///< "a groove 1 mm deep by a ball of 4 mm"
    ToolSolid solid;
    bone::CutStretch cut{};  ///< its solid is number 0
    double volume = 0.0;     ///< [m³] that it removes
    double walls = 0.0;      ///< [m²] of the surface that it leaves
    [[nodiscard]] bool is_in_air() const noexcept { return volume == 0.0; }
};

/// The scenes, each with its own tool: a shallow and a deep groove, a hole, a slot, and a pass in air.   [any]
[[nodiscard]] const std::vector<RemeshScene>& remesh_scenes();

/// What the host requests for a scene: a patch with a locked border, or the whole slab. The ring of faces around the
/// patch is empty for a whole mesh.   [main]
struct RemeshTask {
    bone::RemeshRequest request;
    bone::TaggedMesh ring;
};
[[nodiscard]] RemeshTask task_of(const RemeshScene& scene, std::uint32_t scope, double tolerance);

}  // namespace kerf::conformance
