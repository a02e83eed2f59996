// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/field/grid/body.h"
#include "core/haptics/law/tool.h"

namespace kerf {

/// Returns the body of an implant as it stays in bone, in its tool's frame: its outline without the driver, and one
/// helix of its lead between core and crests. Its flanks are drawn at 25°; nothing but the picture and what meets the
/// metal depends on them. Pre: it is an implant.   [main]
[[nodiscard]] Body implant_body(const ToolOutline& implant, const std::string& id, double spacing);

}  // namespace kerf
