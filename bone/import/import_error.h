// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace kerf::bone {

/// An error of an import, thrown within it. `make_ct_bone` turns it into a Diagnostic.
struct ImportError {
    const char* code;
    std::vector<std::string> keys;  ///< path to the line of the anatomy that has to change
    std::string message;
};

}  // namespace kerf::bone
