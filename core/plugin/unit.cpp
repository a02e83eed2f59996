// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/unit.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "kerf/units.hpp"

namespace kerf {
namespace {

constexpr kerf_dimension energy = dimension::torque, energy_per_time{{2, 1, -3, 0, 0, 0, 0, 0}};

constexpr std::array symbols{
    UnitSymbol{"1", 1, 1, dimension::none},
    UnitSymbol{"%", 1, 100, dimension::none},
    UnitSymbol{"m", 1, 1, dimension::length},
    UnitSymbol{"cm", 1, 100, dimension::length},
    UnitSymbol{"mm", 1, 1e3, dimension::length},
    UnitSymbol{"um", 1, 1e6, dimension::length},
    UnitSymbol{"\u00B5m", 1, 1e6, dimension::length},  // micro sign
    UnitSymbol{"\u03BCm", 1, 1e6, dimension::length},  // Greek mu
    UnitSymbol{"rad", 1, 1, dimension::angle},
    UnitSymbol{"deg", pi, 180, dimension::angle},
    UnitSymbol{"turns", 2.0 * pi, 1, dimension::angle},
    UnitSymbol{"s", 1, 1, dimension::time},
    UnitSymbol{"ms", 1, 1e3, dimension::time},
    UnitSymbol{"us", 1, 1e6, dimension::time},
    UnitSymbol{"\u00B5s", 1, 1e6, dimension::time},
    UnitSymbol{"\u03BCs", 1, 1e6, dimension::time},
    UnitSymbol{"min", 60, 1, dimension::time},
    UnitSymbol{"Hz", 1, 1, dimension::frequency},
    UnitSymbol{"kHz", 1e3, 1, dimension::frequency},
    UnitSymbol{"rpm", 1, 60, dimension::frequency},
    UnitSymbol{"kg", 1, 1, dimension::mass},
    UnitSymbol{"g", 1, 1e3, dimension::mass},
    UnitSymbol{"mg", 1, 1e6, dimension::mass},
    UnitSymbol{"N", 1, 1, dimension::force},
    UnitSymbol{"mN", 1, 1e3, dimension::force},
    UnitSymbol{"kN", 1e3, 1, dimension::force},
    UnitSymbol{"Nm", 1, 1, dimension::torque},
    UnitSymbol{"Nmm", 1, 1e3, dimension::torque},
    UnitSymbol{"J", 1, 1, energy},
    UnitSymbol{"mJ", 1, 1e3, energy},
    UnitSymbol{"W", 1, 1, energy_per_time},
    UnitSymbol{"mW", 1, 1e3, energy_per_time},
    UnitSymbol{"Pa", 1, 1, dimension::pressure},
    UnitSymbol{"kPa", 1e3, 1, dimension::pressure},
    UnitSymbol{"MPa", 1e6, 1, dimension::pressure},
    UnitSymbol{"GPa", 1e9, 1, dimension::pressure},
    UnitSymbol{"ml", 1, 1e6, dimension::volume},
};

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t' || text.front() == '\n'))
        text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\n')) text.remove_suffix(1);
    return text;
}

/// Removes the power, 2 to 4, at the end of a factor such as "mm3", "mm^3" or "mm³" and returns it; 1 if there is none.
int take_power(std::string_view& factor) {
    int power = 1;
    if (factor.size() < 2) return power;
    if (factor.ends_with("²") || factor.ends_with("³")) {
        power = factor.ends_with("²") ? 2 : 3;
        factor.remove_suffix(std::string_view("²").size());
    } else if (factor.back() >= '2' && factor.back() <= '4') {
        power = factor.back() - '0';
        factor.remove_suffix(1);
        if (factor.ends_with("^")) factor.remove_suffix(1);
    }
    return power;
}

const UnitSymbol* find(std::span<const UnitSymbol> among, std::string_view name) {
    const auto at = std::find_if(among.begin(), among.end(), [&](const UnitSymbol& s) { return s.name == name; });
    return at != among.end() ? &*at : nullptr;
}

}  // namespace

std::span<const UnitSymbol> unit_symbols() noexcept { return symbols; }

std::optional<Unit> parse_unit(std::string_view text, std::span<const UnitSymbol> further) {
    text = trimmed(text);
    double numerator = 1.0, denominator = 1.0;
    std::array<int, 8> exponents{};
    bool is_divided = false;
    for (std::size_t count = 0;; ++count) {
        // Read one factor, up to the next operator.
        if (count == max_unit_factors) return std::nullopt;
        const std::size_t end = text.find_first_of("/* ");
        std::string_view factor = text.substr(0, end);
        const int power = take_power(factor);
        const UnitSymbol* symbol = find(symbols, factor);
        if (symbol == nullptr) symbol = find(further, factor);
        if (symbol == nullptr) return std::nullopt;
        for (int i = 0; i < power; ++i) {
            numerator *= is_divided ? symbol->denominator : symbol->numerator;
            denominator *= is_divided ? symbol->numerator : symbol->denominator;
        }
        for (std::size_t i = 0; i < exponents.size(); ++i)
            exponents[i] += (is_divided ? -power : power) * symbol->dimension.exponent[i];

        // The operator: a slash divides by the next factor alone.
        if (end == std::string_view::npos) break;
        is_divided = text[end] == '/';
        text.remove_prefix(end + 1);
    }
    Unit unit;
    unit.factor = numerator / denominator;
    for (std::size_t i = 0; i < exponents.size(); ++i) unit.dimension.exponent[i] = static_cast<int8_t>(exponents[i]);
    return unit;
}

}  // namespace kerf
