// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "core/plugin/loader.h"
#include "run/exact/exact_strategies.h"

namespace kerf::app {

/// The files of this Kerf, below one prefix, which the user may move as a whole.
struct Installation {
    std::filesystem::path prefix;

    /// bin/kerf
    [[nodiscard]] std::string program() const { return (prefix / "bin" / "kerf").string(); }
    /// A program that `kerf` starts: libexec/kerf/NAME.
    [[nodiscard]] std::string helper(const std::string& name) const {
        return (prefix / "libexec" / "kerf" / name).string();
    }
    /// The folder of the plugins that procedures may name.
    [[nodiscard]] std::string plugins() const { return (prefix / "lib" / "kerf").string(); }
    /// The folder of the laws as printed in papers, for charts and the stability suite only.
    [[nodiscard]] std::string printed_laws() const { return (prefix / "lib" / "kerf-papers").string(); }
    [[nodiscard]] std::string procedures() const { return (prefix / "share" / "kerf" / "procedures").string(); }
    /// The folder of the files that an administrator installs: rules for devices, limits of the system.
    [[nodiscard]] std::string system_files() const { return (prefix / "share" / "kerf" / "system").string(); }
    /// The program that calls the remeshing strategies of `plugins`.
    [[nodiscard]] run::StrategyHost strategies(const PluginRegistry& plugins) const {
        return {helper("kerf-remesh"), &plugins.catalog()};
    }
};

/// Returns the installation of the program that runs, which is in its bin or its libexec/kerf.   [main]
[[nodiscard]] Installation this_installation();

}  // namespace kerf::app
