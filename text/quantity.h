// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/plugin/unit.h"
#include "kerf/abi.h"
#include "kerf/math.hpp"
#include "text/read_codes.h"

/// Numbers with their unit, as people write them: "3.2 mm", "1.85 g/cm3". The computer's locale plays no part.
namespace kerf {

/// What a value must be. `unit` is the one that messages use; "" for a plain number.
struct QuantityNeed {
    kerf_dimension dimension{};
    std::string unit;
    double min = 0.0, max = 0.0;  ///< SI, both allowed
};

/// What is wrong with a value, without its place.
struct QuantityProblem {
    Code code{};
    std::string message;
    std::string write;
};

/// A value in SI, or why there is none.
template <class T>
struct Parsed {
    std::optional<T> value;
    QuantityProblem problem;
};

/// Reads `text` as one quantity; a plain number may be a fraction, "1/50". `name` is what the messages call it.   [any]
Parsed<double> parse_quantity(std::string_view text, const std::string& name, const QuantityNeed& need);

/// Reads three numbers and one unit, "3.0 193.0 -60.5 mm"; no unit for a direction, "0 0 1".   [any]
Parsed<Vec3> parse_vector(std::string_view text, const std::string& name, const QuantityNeed& need);

/// What to say of `3,2 mm`, with the digits before the comma and all that follows it. `1,000` may be meant either way.
/// [any]
QuantityProblem decimal_comma(const std::string& name, const std::string& before, const std::string& behind);

/// A regular expression (ECMA 262) for the texts that `parse_quantity` does not refuse for their form or unit. Of units
/// made of several it sees only that they are units.   [any]
std::string quantity_pattern(const QuantityNeed& need);

/// The same for `parse_vector`.   [any]
std::string vector_pattern(const QuantityNeed& need);

/// `value` in `unit`, at most ten digits: "0.5 mm".   [any]
std::string quantity_text(double value, std::string_view unit);

}  // namespace kerf
