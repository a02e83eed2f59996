// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

#include "core/haptics/law/tool.h"

namespace kerf::test {

/// A tool's outline as its plugin makes it.
inline ToolOutline outline(const ToolSetup& setup) {
    ToolOutline out;
    std::string error;
    if (!outline_of(setup, out, error)) throw std::runtime_error(error);
    return out;
}

/// The same with a shaft that does not bend: for questions of the tool's law alone.
inline ToolOutline rigid_outline(const ToolSetup& setup) {
    ToolOutline out = outline(setup);
    out.handling.bending = {};
    return out;
}

}  // namespace kerf::test
