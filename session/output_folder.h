// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "text/write_file.h"

namespace kerf {

/// Makes `folder` ready for a run's files, and ours alone while `lock` lives. A folder that exists is emptied only if
/// it holds a session of ours (session.db), or what is left of one that was killed while it was made, and nothing that
/// no run writes; an empty one is taken as it is; anything else is left alone and refused. `made` holds the folders
/// that were missing: keep them once something is in them. Returns why, for people; empty when the folder is
/// ready.   [main]
[[nodiscard]] std::string prepare_output(const std::string& folder, OutputLock& lock, MadeFolders& made);

}  // namespace kerf
