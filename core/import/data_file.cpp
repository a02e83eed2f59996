// SPDX-License-Identifier: Apache-2.0
#include "core/import/data_file.h"

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace kerf {

std::string found_data_file(const std::string& written, const std::string& document) {
    const std::filesystem::path beside = std::filesystem::path(document).parent_path() / written;
    std::error_code ignored;
    const char* data = std::getenv("KERF_DATA");
    if (!std::filesystem::exists(beside, ignored) && data && *data)
        return (std::filesystem::path(data) / written).string();
    return beside.string();
}

}  // namespace kerf
