// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf {

/// Returns the grade of a screw in a pedicle by how far its thread leaves the bone: A not at all, B under 2 mm, C under
/// 4 mm, D under 6 mm, E more [gertzbein-robbins-1990]. Where the breach lies between `least` and `most` [m] and they
/// differ in grade, both: "B/C".   [any] pure.
[[nodiscard]] std::string gertzbein_robbins(double least, double most);

}  // namespace kerf
