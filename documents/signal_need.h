// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plugin/component_info.h"
#include "core/plugin/unit.h"
#include "text/quantity.h"

namespace kerf::documents {

/// Returns what a bound on a signal must be: a number of the signal's dimension. A law declares no range, so the range
/// only keeps values finite.   [any]
inline text::QuantityNeed need_of(const SignalInfo& signal) {
    const double most = 1e12 * parse_unit(signal.display_unit).value_or(Unit{}).factor;
    return {signal.dimension, signal.display_unit, -most, most};
}

}  // namespace kerf::documents
