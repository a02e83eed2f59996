// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "core/haptics/law/tool.h"
#include "core/plugin/loader.h"

/// Tools and laws by their names. For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// The plugins that are compared: Kerf's own, and the papers' laws, which no procedure finds.
struct Plugins {
    const PluginRegistry* own = nullptr;     ///< must hold kerf.drilling
    const PluginRegistry* papers = nullptr;  ///< papers.as_printed, papers.sawing; without them methods are left out
};

using Values = std::map<std::string, double>;  ///< SI, by the id of a parameter or drive

/// Null: the registry has no such component.
[[nodiscard]] const ComponentInfo* info_of(const PluginRegistry& registry, const std::string& plugin,
                                           const std::string& id);

/// A tool and a force of one plugin.
struct NamedSetup {
    std::string plugin{}, tool{}, force{};
    Values set{};  ///< parameters and drives of either; the others keep their defaults

    [[nodiscard]] bool is_in(const PluginRegistry& registry) const;
    /// Pre: it is in the registry. Values of other names are ignored.   [main]
    [[nodiscard]] ToolSetup in(const PluginRegistry& registry) const;
    /// Every parameter and drive of both, with its default where `set` has none. Pre: it is in the registry.
    [[nodiscard]] Values all(const PluginRegistry& registry) const;
};

}  // namespace kerf::chart
