// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "documents/procedure.h"

namespace kerf::run {

/// Returns whether a value is within its bound.   [any] pure, nonblocking
[[nodiscard]] inline bool is_within(const documents::Bound& bound, double value) noexcept {
    return bound.at_least.value_or(-HUGE_VAL) <= value && value <= bound.at_most.value_or(HUGE_VAL);
}

/// Returns whether all values within ± `uncertainty` are within the bound, or all beyond the same end of it. Negative
/// values count only if the quantity is signed: an angle of 0 ± 1° lies between 0 and 1°.   [any] pure
[[nodiscard]] inline bool is_decided(const documents::Bound& bound, double value, double uncertainty,
                                     bool is_signed) noexcept {
    const double low = is_signed ? value - uncertainty : std::max(0.0, value - uncertainty);
    const double high = value + uncertainty;
    const bool is_inside = is_within(bound, low) && is_within(bound, high);
    return is_inside || high < bound.at_least.value_or(-HUGE_VAL) || low > bound.at_most.value_or(HUGE_VAL);
}

}  // namespace kerf::run
