// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "kerf/abi.h"

namespace kerf {

/// Returns the SI unit of a dimension by name: "N*m", "kg/m^3", "1/s"; empty for a plain number. `parse_unit` reads it
/// back as a unit of factor 1.   [any]
[[nodiscard]] std::string si_unit(const kerf_dimension& dimension);

/// Returns the SI unit of values in `display_unit`: "m" for "mm". A unit that `parse_unit` does not know is returned
/// unchanged, as its values are not converted.   [any]
[[nodiscard]] std::string si_unit_of(std::string_view display_unit);

}  // namespace kerf
