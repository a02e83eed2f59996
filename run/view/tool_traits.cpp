// SPDX-License-Identifier: Apache-2.0
#include "run/view/tool_traits.h"

#include <cstdint>
#include <string_view>

#include "kerf/units.hpp"

namespace kerf::run {

namespace {

/// Returns whether `is` accepts the value of a drive in turns or strokes per time.
template <class Is>
bool has_drive(const ToolSetup& setup, const Is& is) {
    if (setup.tool == nullptr || setup.tool->tool == nullptr) return false;
    const kerf_tool& tool = *setup.tool->tool;
    for (std::uint32_t i = 0; i < tool.drive_count && i < setup.drives.size(); ++i) {
        const kerf_dimension& of = tool.drives[i].dimension;
        if ((of == dimension::frequency || of == dimension::turn_speed) && is(setup.drives[i])) return true;
    }
    return false;
}

}  // namespace

std::optional<double> parameter(const ToolSetup& setup, const char* id, const kerf_dimension& dimension) {
    if (setup.tool == nullptr) return std::nullopt;
    for (std::uint32_t i = 0; i < setup.tool->param_count && i < setup.tool_parameters.size(); ++i) {
        const kerf_param& one = setup.tool->params[i];
        if (std::string_view(one.id) == id && one.dimension == dimension) return setup.tool_parameters[i];
    }
    return std::nullopt;
}

bool is_powered(const ToolSetup& setup) {
    return has_drive(setup, [](double) { return true; });
}

bool is_running(const ToolSetup& setup) {
    return has_drive(setup, [](double value) { return value != 0.0; });
}

}  // namespace kerf::run
