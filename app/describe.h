// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "core/plugin/loader.h"

/// What plugins say of themselves, for people.
namespace kerf {

/// One line per component.   [main]
[[nodiscard]] std::string list_of_components(const PluginRegistry& plugins);

/// Every parameter, drive and signal of "PLUGIN", of "PLUGIN/COMPONENT", or of all when `wanted` is empty. Empty when
/// there is no such thing; then `error` says what there is.   [main]
[[nodiscard]] std::optional<std::string> description_of(const PluginRegistry& plugins, const std::string& wanted,
                                                        std::string& error);

}  // namespace kerf
