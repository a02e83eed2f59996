// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "core/plugin/loader.h"

/// Describes plugins and their components, for people.
namespace kerf::app {

/// Returns one line for each component.   [main]
[[nodiscard]] std::string list_of_components(const PluginRegistry& plugins);

/// Returns every parameter, drive and signal of "PLUGIN", of "PLUGIN/COMPONENT", or of all if `wanted` is empty.
/// Returns nothing if there is no such component; then `error` lists the known ones.   [main]
[[nodiscard]] std::optional<std::string> description_of(const PluginRegistry& plugins, const std::string& wanted,
                                                        std::string& error);

}  // namespace kerf::app
