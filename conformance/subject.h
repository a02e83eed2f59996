// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "conformance/test.h"
#include "core/haptics/law/tool.h"
#include "core/plugin/loader.h"

namespace kerf::conformance {

/// What a test is about, loaded.
struct Subject {
    std::shared_ptr<Plugin> plugin;
    const kerf_component* tool = nullptr;   ///< of a tool, and of a law
    const kerf_component* force = nullptr;  ///< of a law
    const kerf_component* strategy = nullptr;
    const kerf_component* device = nullptr;  ///< the driver of devices

    /// The tool and the law with everything at its default.   [any]
    [[nodiscard]] ToolSetup setup() const;
};

/// A subject before it is loaded: it can cross processes.
struct SubjectName {
    Scope scope = Scope::plugin;
    std::string name;           ///< "burr", "burr with burring"; empty: the plugin
    int tool = -1, force = -1;  ///< indices of components; −1 for a law's tool: a stand-in
    int strategy = -1;          ///< index of a component
    int device = -1;            ///< index of a component
};

/// What a plugin holds: itself, its tools, its strategies, its drivers of devices, and each law with each tool that it
/// takes. A law that needs parameters of any tool comes with the plugin's tools that have them, or with a stand-in.
/// [any]
[[nodiscard]] std::vector<SubjectName> subjects_of(const kerf_entry& entry);

/// The subject of this name. Its texts live as long as the plugin.   [main]
[[nodiscard]] Subject subject_of(std::shared_ptr<Plugin> plugin, const SubjectName& name);

/// A powered ball with the parameters and drives that a law needs, for a law without a tool.   [main]
[[nodiscard]] const kerf_component& stand_in_for(const kerf_component& law);

}  // namespace kerf::conformance
