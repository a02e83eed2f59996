// SPDX-License-Identifier: Apache-2.0
#include "bone/import/data_file.h"

#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "text/inside_folder.h"

namespace kerf::bone {

std::string found_data_file(const std::string& written, const std::string& document) {
    const std::filesystem::path beside = std::filesystem::path(document).parent_path() / written;
    std::error_code ignored;
    const char* data = std::getenv("KERF_DATA");
    if (!std::filesystem::exists(beside, ignored) && data && *data)
        return (std::filesystem::path(data) / written).string();
    return beside.string();
}

bool is_data_file_inside(const std::string& path, const std::string& document, text::Diagnostics& diagnostics) {
    const char* data = std::getenv("KERF_DATA");
    if (text::is_inside_folder(path, std::filesystem::path(document).parent_path().string()) ||
        (data && *data && text::is_inside_folder(path, data)))
        return true;
    diagnostics.push_back(text::error_about(path, "E0619",
                                            "a link leads out of the document's folder and of KERF_DATA. "
                                            "Put the file itself there."));
    return false;
}

}  // namespace kerf::bone
