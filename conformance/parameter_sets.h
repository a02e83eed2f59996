// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "kerf/abi.h"

namespace kerf::conformance {

/// Values of a component's parameters, and how they differ from the defaults.
struct ParameterSet {
    std::string name;  ///< "`diameter` at 1 mm", "set 12 of the random ones: diameter 3.2 mm, …"
    std::vector<double> values;
};

/// "`diameter` 3.2 mm", in the unit that it is shown in.   [any]
[[nodiscard]] std::string named(const kerf_param& row, double value);
/// Whether a parameter counts things: its range and default are whole numbers without a unit.   [any]
[[nodiscard]] bool is_count(const kerf_param& row);
/// The defaults of a component's parameters.   [any]
[[nodiscard]] std::vector<double> default_parameters(const kerf_component& component);

/// The defaults, each parameter at either end of its range, all of them at theirs, and `random` sets spread over all
/// ranges. The same in every run.   [any]
[[nodiscard]] std::vector<ParameterSet> parameter_sets(const kerf_component& component, int random);

/// Values of a tool's drives: the defaults, all at rest, and each at either end of its range.   [any]
[[nodiscard]] std::vector<ParameterSet> drive_sets(const kerf_component& tool);

/// The drives of a tool, all as near to 0 as their ranges allow.   [any]
[[nodiscard]] std::vector<double> drives_at_rest(const kerf_component& tool);

}  // namespace kerf::conformance
