// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "documents/anatomy.h"
#include "run/view/viewed_run.h"

namespace kerf::run {

inline constexpr std::size_t max_zone_triangles = 20000;

/// Returns the surface of a zone's solids, with fewer than `max_zone_triangles`; empty for a zone without solids. Its
/// points are about `spacing` [m] apart, or more if the zone is large for that.   [main]
[[nodiscard]] ViewedMesh zone_shape(const documents::Zone& zone, double spacing);

}  // namespace kerf::run
