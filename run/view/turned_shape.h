// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/haptics/law/tool.h"
#include "run/view/facets.h"
#include "run/view/grooves.h"

/// Solids of revolution with grooves, as rows of points.
namespace kerf::run {

/// Adds a row around the axis at `z`, where the outline has `radius` [m]. `is_grooved` false: a circle.
void add_row(Rows& rows, const Grooves& grooves, double z, double radius, bool is_grooved);

/// Returns the rows of a tool from its tip to its end, both closed. Its bore, if it has one, is open at the tip.
/// [main]
[[nodiscard]] Rows turned_rows(const ToolOutline& outline, const Grooves& grooves);

/// Adds rows that close the end of a solid at `z` [m], where it has `radius` [m]: with a hexagonal socket, as deep as
/// `depth` [m] towards the tip; flat if `depth` is 0.
void add_end(Rows& rows, const Grooves& grooves, double z, double radius, double depth);

}  // namespace kerf::run
