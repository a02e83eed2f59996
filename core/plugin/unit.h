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

/// Maximum number of factors of a unit. A text with more is no unit: none needs more, and this bounds the time to parse
/// a long text.
inline constexpr std::size_t max_unit_factors = 6;

/// Returns all named units.   [any]
[[nodiscard]] std::span<const UnitSymbol> unit_symbols() noexcept;

/// Parses a unit such as "mm", "g/cm3", "N/mm^2", "1/s" or "N m". A revolution has no dimension, so "rpm" is a
/// frequency. Returns no value if the unit is unknown.   [any]
/// @param further  units in addition to `unit_symbols`
[[nodiscard]] std::optional<Unit> parse_unit(std::string_view text, std::span<const UnitSymbol> further = {});

}  // namespace kerf
