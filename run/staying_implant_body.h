// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/field/grid/body.h"
#include "core/haptics/law/tool.h"

namespace kerf::run {

/// Returns the body of an implant that stays in bone, in its tool's frame: its outline without the driver, and one
/// helix of its lead between core and crests. The flanks have 25°; they affect only the picture and contact with the
/// metal. Pre: it is an implant.   [main]
[[nodiscard]] Body staying_implant_body(const ToolOutline& implant, const std::string& id, double spacing);

}  // namespace kerf::run
