// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

#include "conformance/stability/tool_under_test.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

inline const PluginRegistry& built_plugins() {
    static const PluginRegistry registry = [] {
        PluginRegistry r;
        r.scan({KERF_BUILD_DIR "/lib/kerf"});
        return r;
    }();
    return registry;
}

/// The drilling plugin, as it was built.
inline ToolUnderTest the_drill() {
    std::string error;
    const auto tool = find_tool(built_plugins(), "kerf.drilling", error);
    if (!tool) throw std::runtime_error(error);
    return *tool;
}

/// One device under one hand.
inline Scope only(const char* device, const TestHand& hand, int most_delay) {
    Scope scope;
    scope.devices = {*find_device(device)};
    scope.hands = {hand};
    scope.most_delay = most_delay;
    scope.is_quick = true;
    return scope;
}

}  // namespace kerf::stability
