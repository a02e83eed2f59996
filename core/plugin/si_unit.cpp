// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/si_unit.h"

#include <array>
#include <cstddef>
#include <utility>

#include "core/plugin/unit.h"
#include "kerf/units.hpp"

namespace kerf {
namespace {

struct NamedDimension {
    kerf_dimension dimension;
    const char* name;
};

// Energy has the dimension of torque, so it is in N*m, too.
const std::array named{
    NamedDimension{dimension::force, "N"},
    NamedDimension{dimension::torque, "N*m"},
    NamedDimension{dimension::angular_stiffness, "N*m/rad"},
    NamedDimension{dimension::force_per_length, "N/m"},
    NamedDimension{dimension::pressure, "Pa"},
    NamedDimension{dimension::power, "W"},
    NamedDimension{dimension::damping, "N*s/m"},
};

constexpr std::array base_units{"m", "kg", "s", "A", "K", "mol", "cd", "rad"};

std::string power(const char* unit, int exponent) {
    return exponent == 1 ? unit : std::string(unit) + "^" + std::to_string(exponent);
}

}  // namespace

std::string si_unit(const kerf_dimension& dimension) {
    for (const NamedDimension& one : named)
        if (one.dimension == dimension) return one.name;
    std::string above, below;
    for (std::size_t i = 0; i < base_units.size(); ++i) {
        // NOLINTNEXTLINE(bugprone-signed-char-misuse): a small signed number, not a character
        const auto exponent = static_cast<int>(dimension.exponent[i]);
        if (exponent > 0) above += (above.empty() ? "" : "*") + power(base_units[i], exponent);
        if (exponent < 0) below += "/" + power(base_units[i], -exponent);
    }
    if (above.empty() && !below.empty()) above = "1";
    return above + below;
}

std::string si_unit_of(std::string_view display_unit) {
    if (display_unit.empty()) return {};
    const auto unit = parse_unit(display_unit);
    return unit ? si_unit(unit->dimension) : std::string(display_unit);
}

}  // namespace kerf
