// SPDX-License-Identifier: Apache-2.0
#include "app/procedure_files.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "text/regular_file.h"

namespace kerf::app {

namespace {

namespace fs = std::filesystem;

/// Returns whether a file states a kind other than a procedure. Such files are often in the same folder.
bool is_of_another_kind(const fs::path& file) {
    constexpr std::size_t head_size = 4096;
    std::ifstream in = text::open_regular_file(file.string());
    std::string head(head_size, '\0');
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
    const std::size_t at = ("\n" + head).find("\nkind:");
    if (at == std::string::npos) return false;
    return head.substr(at, head.find('\n', at) - at).find("Procedure") == std::string::npos;
}

}  // namespace

std::vector<std::string> procedures_in(const std::string& folder) {
    std::vector<std::string> files;
    std::error_code error;
    for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
         entry.increment(error)) {
        const fs::path file = entry->path();
        const bool is_yaml = file.extension() == ".yaml" || file.extension() == ".yml";
        if (is_yaml && !is_of_another_kind(file)) files.push_back(file.string());
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace kerf::app
