// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "app/badges/badge_store.h"
#include "app/installation.h"
#include "core/plugin/loader.h"
#include "text/file_digest.h"

namespace kerf::app {

/// The knowledge of Kerf about the file of a loaded plugin.
struct PluginVerdict {
    bool is_shipped = false;   ///< a plugin of Kerf's own, in the program's own folder: the kit passes it in CI
    bool is_replaced = false;  ///< the file is another one than was loaded
    text::FileDigest file{};   ///< without a digest: not read, or not that of the loaded file
    std::optional<Badge> badge{};
    std::string fault{};  ///< of the badge's file, for people; empty: none

    [[nodiscard]] bool is_sufficient() const noexcept {
        return is_shipped || (badge && badge->level >= required_level);
    }
    /// Returns "shipped with Kerf", "checked: level 4, all of 96 tests", "never checked", or why it is not known.
    [[nodiscard]] std::string words() const;
};

/// Reads the file and the badge of a plugin. Reads no badge of a shipped plugin.
/// @param wants_digest   reads the file of a shipped plugin, too   [main]
[[nodiscard]] PluginVerdict verdict_on(const std::string& id, const std::string& file, const Installation& here,
                                       const BadgeStore& store, bool wants_digest = false);

/// Returns the path of the library of a plugin; empty for the core's own, and for an unknown id.   [main]
[[nodiscard]] std::string file_of_plugin(const PluginRegistry& plugins, const std::string& id);

}  // namespace kerf::app
