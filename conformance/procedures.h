// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "conformance/check.h"

namespace kerf::conformance {

/// Level 5: runs whole procedures with the plugin, each by `kerf` itself, and adds to the report whether their
/// rehearsals end as they expect, whether a replay gives the same bits, and whether the plugin's twin does.   [main]
void check_procedures(const CheckRequest& request, PluginReport& report,
                      const std::function<void(const TestResult&)>& on_result);

/// The ids of these tests.   [any]
[[nodiscard]] std::vector<std::string> procedure_tests();

}  // namespace kerf::conformance
