// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "run/view/viewed_run.h"

namespace kerf::run {

inline constexpr double pointer_length = 0.1, pointer_diameter = 3e-3;  ///< [m]

/// Returns a plain pointer in the frame of a tool: a cone of a right angle, and a cylinder of `diameter` [m] behind it,
/// `pointer_length` long. It replaces a tool of unknown shape.   [main]
[[nodiscard]] ViewedMesh pointer_shape(double diameter);

}  // namespace kerf::run
