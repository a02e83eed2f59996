// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "text/source.h"

namespace kerf::bone {

/// Returns the path of a file or folder that a document names: in the document's folder, or else in KERF_DATA. It need
/// not exist.   [main]
[[nodiscard]] std::string found_data_file(const std::string& written, const std::string& document);

/// Returns whether such a path, with all links followed, stays in the document's folder or in KERF_DATA. Error: E0619.
/// [main]
[[nodiscard]] bool is_data_file_inside(const std::string& path, const std::string& document,
                                       text::Diagnostics& diagnostics);

}  // namespace kerf::bone
