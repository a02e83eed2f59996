// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/plugin/loader.h"

/// Describes plugins and their components, for people.
namespace kerf::app {

/// Returns words on the verdict of `kerf check` on a plugin; empty for none.
using BadgeWords = std::function<std::string(const std::string& plugin_id)>;

/// Returns one line for each component, then one for each plugin that has words.   [main]
[[nodiscard]] std::string list_of_components(const PluginRegistry& plugins, const BadgeWords& badge = {});

/// Returns every parameter, drive and signal of "PLUGIN", of "PLUGIN/COMPONENT", or of all if `wanted` is empty.
/// Returns nothing if there is no such component; then `error` lists the known ones.   [main]
[[nodiscard]] std::optional<std::string> description_of(const PluginRegistry& plugins, const std::string& wanted,
                                                        std::string& error, const BadgeWords& badge = {});

}  // namespace kerf::app
