// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "core/haptics/law/tool.h"
#include "documents/anatomy.h"
#include "documents/procedure.h"
#include "text/source.h"

namespace kerf::run {

/// Refuses limits of a step that break before it begins: a depth that must be reached, and a zone that the tool
/// must not leave but is not near at `from` of the step's axis (E0406).   [main]
void check_limits_at_start(const documents::Procedure& procedure, std::size_t step, const ToolOutline& tool,
                           const documents::Anatomy& anatomy, text::Diagnostics& diagnostics);

}  // namespace kerf::run
