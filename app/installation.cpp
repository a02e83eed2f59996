// SPDX-License-Identifier: Apache-2.0
#include "app/installation.h"

#include <system_error>

namespace kerf::app {

Installation this_installation() {
    std::error_code error;
    const auto folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
    const bool is_helper = folder.filename() == "kerf" && folder.parent_path().filename() == "libexec";
    return {is_helper ? folder.parent_path().parent_path() : folder.parent_path()};
}

}  // namespace kerf::app
