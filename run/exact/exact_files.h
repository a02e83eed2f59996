// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bone/exact/exact_surface.h"
#include "run/exact/exact_strategies.h"
#include "session/recording.h"

namespace kerf {

/// Returns an exact surface as results show it.   [any] pure.
[[nodiscard]] ExactRow exact_row(const ExactSurface& made, const ExactStrategies& strategies);

/// Writes bone-exact.stl, bone-exact-1.stl … into a folder, in the place of those there. Returns why not, for people,
/// or an empty text.   [main]
[[nodiscard]] std::string write_exact_surfaces(const std::string& folder, const ExactSurface& made);

}  // namespace kerf
