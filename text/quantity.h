// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/plugin/unit.h"
#include "kerf/abi.h"
#include "kerf/math.hpp"
#include "text/code.h"

/// Quantities as people write them: "3.2 mm", "1.85 g/cm3". Independent of the computer's locale.
namespace kerf::text {

/// Requirements on a value. `unit` is the unit of messages; "" for a plain number.
struct QuantityNeed {
    kerf_dimension dimension{};
    std::string unit;
    double min = 0.0, max = 0.0;  ///< SI, both inclusive
};

/// A problem with a value, without its position.
struct QuantityProblem {
    Code code{};
    std::string message;
    std::string write;
};

/// A value in SI, or the problem that prevents it.
template <class T>
struct Parsed {
    std::optional<T> value;
    QuantityProblem problem;
};

/// Parses one quantity. A plain number may be a fraction, "1/50". `name` names the value in messages.   [any]
Parsed<double> parse_quantity(std::string_view text, const std::string& name, const QuantityNeed& need);

/// Parses three numbers and one unit, "3.0 193.0 -60.5 mm". A direction has no unit, "0 0 1".   [any]
Parsed<Vec3> parse_vector(std::string_view text, const std::string& name, const QuantityNeed& need);

/// Returns the problem of a decimal comma as in `3,2 mm`, from the digits before the comma and the text after it.
/// `1,000` is ambiguous: the message then names both meanings. [any]
QuantityProblem decimal_comma(const std::string& name, const std::string& before, const std::string& behind);

/// Returns a regular expression (ECMA 262) for the texts whose form and unit `parse_quantity` accepts. Of a composed
/// unit it checks only that its parts are units.   [any]
std::string quantity_pattern(const QuantityNeed& need);

/// Returns the same for `parse_vector`.   [any]
std::string vector_pattern(const QuantityNeed& need);

/// Returns `value` in `unit`, with at most ten digits: "0.5 mm".   [any]
std::string quantity_text(double value, std::string_view unit);

}  // namespace kerf::text
