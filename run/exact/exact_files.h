// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bone/exact/exact_surface.h"
#include "run/exact/exact_strategies.h"
#include "session/recording.h"

namespace kerf::run {

/// Returns an exact surface as a row of the results.   [any] pure.
[[nodiscard]] session::ExactRow exact_row(const bone::ExactSurface& made, const ExactStrategies& strategies);

/// Writes bone-exact.stl, bone-exact-1.stl … into a folder and replaces existing ones. Returns the error as text, empty
/// on success.   [main]
[[nodiscard]] std::string write_exact_surfaces(const std::string& folder, const bone::ExactSurface& made);

}  // namespace kerf::run
