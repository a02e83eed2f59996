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
/// the surface meets the burr, gets its own vertices. Vertices within the rim move along rays from the burr's axis to
/// the points where these rays leave the burr. This is correct if every ray meets the surface inside the burr once, and
/// from the air: then each face inside faces the axis. If a face does not, another wall is inside the burr, and the cut
/// is declined.
///
/// Surface less than half of `tolerance` deep stays. A vertex up to a quarter of it outside may become part of the rim.
/// All other vertices outside stay bit for bit.
///
/// @param locked     #vertices, 1: the vertex must not move; may be empty
/// @param tolerance  [m] largest distance of the wall from the burr; it sets the wall's resolution
/// @return declined, with the reason, for a cut that this method cannot make; refused for a bad mesh   [worker]
[[nodiscard]] Outcome displace(Triangles& mesh, const std::vector<std::uint8_t>& locked, const SweptBurr& burr,
                               double tolerance, const Cancelled& cancelled, std::string& why);

}  // namespace kerf::burring::displacement
