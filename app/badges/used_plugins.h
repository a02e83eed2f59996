// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/badges/badge_store.h"
#include "app/commands.h"
#include "documents/procedure.h"

namespace kerf::app {

/// The plugins that an operation uses, with the warnings about them. Each is printed once.
class UsedPlugins {
public:
    explicit UsedPlugins(const Environment& with) : with_(with), store_(BadgeStore::of_environment()) {}

    /// Adds the plugins of a procedure's steps and of a device. Prints a warning for each without a badge of
    /// required_level.   [main]
    /// @param device  as in `--device`; empty: none
    void add(const documents::Procedure& procedure, const std::string& device = "");

    /// Returns a line for each plugin that is not shipped, with its badge: "  example.peck (peck.so): never checked".
    [[nodiscard]] std::string lines() const;
    /// Returns file, SHA-256 and badge of each plugin that is not shipped, for the session: "example.peck badge" and
    /// "never checked".
    [[nodiscard]] std::vector<std::pair<std::string, std::string>> parts() const;
    /// Prints a warning for each plugin whose file was replaced after it was loaded.   [main] after the last tick
    void warn_of_replaced() const;

private:
    struct Used {
        std::string id, file, digest, badge;  ///< the badge in words; empty: none is wanted
        bool is_shipped = false;
    };
    void add_one(const std::string& id, bool is_in_ticks);
    [[nodiscard]] static bool is_replaced(const Used& used);

    Environment with_;
    BadgeStore store_;
    std::vector<Used> used_;
    bool has_missed_folder_ = false;
};

}  // namespace kerf::app
