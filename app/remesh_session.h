// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/commands.h"

namespace kerf {

/// `kerf remesh SESSION.db`: repeats a session, and makes the exact surface of what it left: bone-exact.stl, one file
/// for each further piece, and remesh.json.   [main]
[[nodiscard]] ExitCode remesh_session(const RemeshOptions& options, const Environment& with);

}  // namespace kerf
