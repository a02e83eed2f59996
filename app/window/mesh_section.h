// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "run/view/viewed_run.h"

namespace kerf::window {

/// A piece of a section's outline: its ends [m] in the plane.
using SectionLine = std::array<std::array<double, 2>, 2>;

/// Returns the outline in which a mesh meets the plane z = 0 of a frame.   [any] pure
[[nodiscard]] std::vector<SectionLine> section_of(const run::ViewedMesh& mesh, const Pose& plane_from_mesh);

}  // namespace kerf::window
