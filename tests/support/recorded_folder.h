// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <string>

namespace kerf::test {

/// Returns the folder of an operation's session, "pedicle-screw/expert", that a ctest fixture has left
/// (kerf_add_operation); empty where a test runs without ctest, and has to run the operation too.
inline std::string recorded_folder(const std::string& operation) {
    const char* folder = std::getenv("KERF_OPERATIONS");
    return folder != nullptr ? std::string(folder) + "/" + operation : std::string();
}

}  // namespace kerf::test
