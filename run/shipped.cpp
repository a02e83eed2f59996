// SPDX-License-Identifier: Apache-2.0
#include "run/shipped.h"

#include <filesystem>
#include <system_error>

namespace kerf::run {

std::string shipped_or_own(const std::string& name, const std::string& shipped_folder) {
    namespace fs = std::filesystem;
    std::error_code error;
    if (name.empty() || fs::exists(name, error) || fs::path(name).is_absolute()) return name;
    const fs::path shipped = fs::path(shipped_folder) / name;
    return fs::is_regular_file(shipped, error) ? shipped.string() : name;
}

}  // namespace kerf::run
