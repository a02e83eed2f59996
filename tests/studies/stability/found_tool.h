// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

#include "studies/stability/scope.h"
#include "studies/stability/tool_under_test.h"
#include "tests/support/drill_rig.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

/// The first tool of a plugin, as it was built.
inline ToolUnderTest tool_of(const char* plugin) {
    std::string error;
    const auto tool = find_tool(test::plugins(), plugin, error);
    if (!tool) throw std::runtime_error(error);
    return *tool;
}
inline ToolUnderTest the_drill() { return tool_of("kerf.drilling"); }
inline ToolUnderTest the_screw() { return tool_of("kerf.implant"); }

/// The papers' drill with their first law or another one, as they were built.
inline ToolUnderTest the_papers_drill(const std::string& law = "") {
    static const PluginRegistry papers = [] {
        PluginRegistry registry;
        registry.scan({KERF_BUILD_DIR "/lib/kerf-papers"});
        return registry;
    }();
    std::string error;
    const auto tool = find_tool(papers, "papers.as_printed", error, law);
    if (!tool) throw std::runtime_error(error);
    return *tool;
}

/// One device under one hand.
inline Scope only(const char* device, const TestHand& hand, int max_delay) {
    Scope scope;
    scope.devices = {*find_device(device)};
    scope.hands = {hand};
    scope.max_delay = max_delay;
    scope.is_quick = true;
    return scope;
}

}  // namespace kerf::stability
