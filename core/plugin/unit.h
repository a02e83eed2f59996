// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "kerf/abi.h"

/// The units that plugins declare and documents use.
namespace kerf {

/// A unit in terms of SI: a value in this unit, times `factor`, is SI.
struct Unit {
    double factor = 1.0;
    kerf_dimension dimension{};
};

/// One named unit. Its factor is a fraction of integers if possible, so that 1 g/cm3 is exactly 1000 kg/m³.
struct UnitSymbol {
    std::string_view name;
    double numerator, denominator;
    kerf_dimension dimension;
};

/// Maximum number of factors. A unit with more is unknown: no unit needs more, and this bounds the search in long
/// texts.
inline constexpr std::size_t max_unit_factors = 6;

/// Returns all named units.   [any]
[[nodiscard]] std::span<const UnitSymbol> unit_symbols() noexcept;

/// Parses a unit: "mm", "g/cm3", "N/mm^2", "1/s", "N m"; revolutions count as 1, so "rpm" is a frequency. Returns
/// nothing if it is unknown.   [any]
/// @param further  units in addition to `unit_symbols`
[[nodiscard]] std::optional<Unit> parse_unit(std::string_view text, std::span<const UnitSymbol> further = {});

}  // namespace kerf
