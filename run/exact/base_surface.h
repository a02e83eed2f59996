// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/import/surface/surface_mesh.h"
#include "run/scene.h"

namespace kerf {

/// Returns the surface that exact cuts of a bone begin with: the anatomy's own one, or the field's where the anatomy
/// has none or one with a flaw. Nothing: the reason is in `error`, for people.   [any]
/// @param notes   which one it is, for people
[[nodiscard]] std::optional<SurfaceMesh> base_surface(const Scene& scene, const Body& bone,
                                                      std::vector<std::string>& notes, std::string& error);

}  // namespace kerf
