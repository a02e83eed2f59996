// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bone/surface/surface_mesh.h"
#include "core/field/grid/body.h"
#include "documents/anatomy.h"

namespace kerf::bone {

/// Returns the initial surface of a bone for exact cuts: the anatomy's surface, or the field's surface if the anatomy
/// has none or a flawed one. Nothing on failure; then `error` has the reason, for people.   [any]
/// @param own    anatomy whose `mesh:` is the surface of this bone; null: none
/// @param notes  receives the choice of the surface, for people
[[nodiscard]] std::optional<SurfaceMesh> base_surface(const documents::Anatomy* own, const Body& bone,
                                                      std::vector<std::string>& notes, std::string& error);

}  // namespace kerf::bone
