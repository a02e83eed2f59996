// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>

#include "text/distinguishing_digits.h"
#include "text/quantity.h"

/// Lengths in messages of checks.
namespace kerf::run {

/// Returns a length [m] as millimetres, with at most this many decimals.   [any]
inline std::string in_mm(double length, int decimals = 2) {
    const double step = 1e-3 * std::pow(10.0, -decimals);
    return text::quantity_text(std::round(length / step) * step, "mm");
}

/// Returns the texts of a length and its bound [m], with the decimals that make them differ.   [any]
inline text::ComparedTexts compared_in_mm(double length, double bound, int decimals = 2) {
    return text::compared(length, bound, decimals, 6, [](double value, int digits) { return in_mm(value, digits); });
}

}  // namespace kerf::run
