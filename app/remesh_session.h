// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/commands.h"

namespace kerf::app {

/// `kerf remesh SESSION.db`: repeats a session and writes the exact surface of its bone: bone-exact.stl, a file for
/// each further piece, and remesh.json.   [main]
[[nodiscard]] ExitCode remesh_session(const RemeshOptions& options, const Environment& with);

}  // namespace kerf::app
