// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "core/field/grid/body.h"
#include "run/view/viewed_run.h"

namespace kerf::run {

inline constexpr std::size_t max_body_triangles = 60000;

/// Returns the surface of an uncut body in its frame, with fewer than `max_body_triangles`: that of all its samples, or
/// of every second, third … one.   [main]
[[nodiscard]] ViewedMesh body_shape(const Body& body);

}  // namespace kerf::run
