// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace kerf::bone {

/// A measured quantity and its standard uncertainty, in the unit of the quantity: m or rad.
///
/// The uncertainty is one standard deviation, not an interval: k = 1 in the terms of [gum-2008].
struct Measured {
    double value = 0.0;
    double uncertainty = 0.0;  ///< ≥ 0
};

}  // namespace kerf::bone
