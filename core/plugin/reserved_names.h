// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// Ids of plugins that begin with `kerf.` belong to Kerf's own plugins.
namespace kerf {

/// From now on, this process refuses a plugin of such an id, unless it is in `own_folder` or its id is one of
/// `allowed`. Without a folder no id is reserved.   [main]
void reserve_names(std::string own_folder, std::vector<std::string> allowed);

/// Returns why a plugin of this id may not be used, behind its name; empty if it may. Remembers those that were
/// allowed. [main]
[[nodiscard]] std::string refusal_of_name(const std::string& plugin_id, const std::string& file);

/// Returns whether a plugin of this id is used that is not Kerf's own, because it was allowed.   [main]
[[nodiscard]] bool is_foreign_name(const std::string& plugin_id);

}  // namespace kerf
