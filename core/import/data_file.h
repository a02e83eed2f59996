// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf {

/// Where a file or folder that a document names is: in the document's folder, or else in KERF_DATA. It need not exist.
/// [main]
[[nodiscard]] std::string found_data_file(const std::string& written, const std::string& document);

}  // namespace kerf
