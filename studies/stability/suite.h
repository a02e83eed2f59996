// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/plugin/loader.h"
#include "studies/stability/finding.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

/// Everything the suite looks at, in the order of the tests. Deterministic: no clock, fixed seeds.   [main]
/// `plugin`: whose first tool and force are looked at. Error: it is not there. `papers`: where the papers' laws are, if
/// they were built.
[[nodiscard]] std::vector<Finding> run_suite(const PluginRegistry& plugins, const PluginRegistry& papers,
                                             const std::string& plugin, bool is_quick, const Report& as_found,
                                             std::string& error);

/// Whether what Kerf itself does fails nowhere. What is rendered as the papers print it may fail: that is what it is
/// there to show.
[[nodiscard]] bool is_kerf_stable(const std::vector<Finding>& findings);

}  // namespace kerf::stability
