// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace kerf {

/// Eight directions around the axis of a solid of revolution, at which its outline is sampled.
inline constexpr double half_root = 0.70710678118654752440;
inline constexpr double azimuths[8][2] = {{1, 0},  {half_root, half_root},   {0, 1},  {-half_root, half_root},
                                          {-1, 0}, {-half_root, -half_root}, {0, -1}, {half_root, -half_root}};

}  // namespace kerf
