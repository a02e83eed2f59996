// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "documents/procedure.h"

namespace kerf::run {

/// Returns whether a value is within its bound.   [any] pure, nonblocking
[[nodiscard]] inline bool is_within(const documents::Bound& bound, double value) noexcept {
    return bound.at_least.value_or(-HUGE_VAL) <= value && value <= bound.at_most.value_or(HUGE_VAL);
}

}  // namespace kerf::run
