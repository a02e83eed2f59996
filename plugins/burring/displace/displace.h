// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "wall.h"

namespace kerf::burring::displacement {

/// Moves the part of a surface that lies inside a swept burr onto the burr.
///
/// Faces near the burr are split in four, in their planes, until they are as fine as the wall will be. The rim, where
/// the surface meets the burr, gets vertices on both. The vertices within it move along rays from the axis of the burr
/// to where these leave it. That is all that the burr removes if every ray meets the surface inside the burr once and
/// from the air: then each such face looks at the axis. Where one does not, another wall lies in the way of the burr,
/// and the cut is declined.
///
/// What is less than half of `tolerance` deep stays. A vertex within a quarter of it outside may be on the rim. All
/// other vertices outside stay bit for bit.
///
/// @param locked      of each vertex: 1 must not move; may be empty
/// @param tolerance   [m] that the wall may be off the burr; it decides how fine the wall is
/// Returns declined, with the reason, for a cut that this method cannot make; refused for a bad mesh.   [worker]
[[nodiscard]] Outcome displace(Triangles& mesh, const std::vector<std::uint8_t>& locked, const SweptBurr& burr,
                               double tolerance, const Cancelled& cancelled, std::string& why);

}  // namespace kerf::burring::displacement
