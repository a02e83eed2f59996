// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf::documents {

/// A dimension as it was measured on a bone.
struct MeasuredDimension {
    std::string name;    ///< of the dimension
    double value = 0.0;  ///< SI
};

}  // namespace kerf::documents
