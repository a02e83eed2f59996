// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/badges/badge_store.h"
#include "conformance/result.h"

namespace kerf::app {

/// Returns the badge of a plugin whose tests of a level, without `--only`, ran to their end. Its level is 0 if no test
/// ran.   [any] pure.
[[nodiscard]] Badge badge_of(const conformance::PluginReport& report, const std::string& digest, int requested);

/// The badge of one file that `kerf check` tests: reads the file before the tests, and keeps the verdict after them.
class BadgeKeeper {
public:
    /// [main] before the tests
    BadgeKeeper(const BadgeStore& store, std::string file);
    /// Keeps the verdict, unless the file has changed or no test ran. Prints why it cannot; that is no failure. [main]
    void keep(const conformance::PluginReport& report, int requested) const;

private:
    const BadgeStore& store_;
    std::string file_, digest_, fault_;
};

}  // namespace kerf::app
