// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/plugin/file_stamp.h"

/// The stamps of the plugins' files from before they were loaded: a file that changes later is not the loaded one.
namespace kerf::app {

/// Notes the stamp of each library in the folders.   [main] before they are loaded
void note_files_to_load(const std::vector<std::string>& folders);

/// Returns the noted stamp of a file; all zero if none was noted.   [main]
[[nodiscard]] FileStamp stamp_before_loading(const std::string& file);

}  // namespace kerf::app
