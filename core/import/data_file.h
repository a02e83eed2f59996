// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf {

/// Where a data file that a document names lies: in the document's folder, or else in KERF_DATA.   [main]
[[nodiscard]] std::string found_file(const std::string& written, const std::string& document);

}  // namespace kerf
