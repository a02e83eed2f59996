// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "text/source.h"

namespace kerf {

/// Where a file or folder that a document names is: in the document's folder, or else in KERF_DATA. It need not exist.
/// [main]
[[nodiscard]] std::string found_data_file(const std::string& written, const std::string& document);

/// Whether such a path stays in the document's folder or in KERF_DATA once all links are followed. Error: E0619.
/// [main]
[[nodiscard]] bool is_data_file_inside(const std::string& path, const std::string& document, Diagnostics& diagnostics);

}  // namespace kerf
