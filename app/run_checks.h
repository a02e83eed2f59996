// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/procedure/procedure.h"
#include "core/procedure/source.h"

/// What a procedure asks of a run, each complaint at its place in the document.
namespace kerf {

/// Refuses a device without a record, a step that changes tool or axis, and rehearsals that cannot be carried out. None
/// of it needs the bone.   [main]
void check_run(const Procedure& procedure, Diagnostics& diagnostics);

/// The plugin refuses the first step's instrument, and `why`.   [main]
void refuse_tool(const Procedure& procedure, const std::string& why, Diagnostics& diagnostics);

}  // namespace kerf
