// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bone/surface/surface_mesh.h"
#include "core/field/grid/body.h"
#include "documents/anatomy.h"

namespace kerf {

/// Returns the surface that exact cuts of a bone begin with: that of its anatomy, or the field's where it has none, or
/// one with a flaw. Nothing: the reason is in `error`, for people.   [any]
/// @param own     anatomy whose `mesh:` is the surface of this bone; null: there is none
/// @param notes   which surface it is, for people
[[nodiscard]] std::optional<SurfaceMesh> base_surface(const Anatomy* own, const Body& bone,
                                                      std::vector<std::string>& notes, std::string& error);

}  // namespace kerf
