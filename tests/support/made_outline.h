// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

#include "core/haptics/tool.h"

namespace kerf::test {

/// A tool's outline as its plugin makes it.
inline ToolOutline outline(const ToolSetup& setup) {
    ToolOutline out;
    std::string error;
    if (!outline_of(setup, out, error)) throw std::runtime_error(error);
    return out;
}

}  // namespace kerf::test
