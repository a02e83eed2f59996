// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "text/write_file.h"

namespace kerf::session {

/// Returns why a run cannot write its files to a folder as it is now, for people; empty if it can. Changes nothing.
/// [main]
[[nodiscard]] std::string refusal_of_output(const std::string& folder);

/// Prepares `folder` for a run's files, and locks it for the lifetime of `lock`. An empty folder is taken unchanged. A
/// folder with a session (session.db), or the rest of a run killed during its start, is emptied if every other file in
/// it is a run's. Any other folder is refused and left unchanged. `made` contains the folders that were missing: keep
/// them once files are in them. Returns the reason of a refusal, empty on success.   [main]
[[nodiscard]] std::string prepare_output(const std::string& folder, text::OutputLock& lock, text::MadeFolders& made);

}  // namespace kerf::session
