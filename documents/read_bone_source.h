// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "documents/anatomy.h"
#include "documents/yaml/read_map.h"

namespace kerf::documents {

/// Reads `ct:`, the image that bone is made of.   [main]
[[nodiscard]] CtSource read_ct(const Node& node, Report& report);

/// Reads `mesh:`, the surface that bone or an implant is made of. `where` is its name in messages.   [main]
[[nodiscard]] MeshSource read_mesh(const Node& node, const std::string& where, Report& report);

}  // namespace kerf::documents
