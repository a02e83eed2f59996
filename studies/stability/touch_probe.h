// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/scene/simulation.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

/// A thin probe of 60 mm that touches at `points` places (1 … 1000), spread evenly from the tip to its end, each of
/// `stiffness` [N/m]: the smallest law with a wall in it. More than a law has channels share them, neighbours together.
/// Held at its middle where it has several points, behind its end where it has one.
[[nodiscard]] ToolSetup touch_probe(int points, double stiffness);

inline constexpr double probe_length = 60e-3;  ///< [m]
inline constexpr double rigid = 2e7;           ///< [N/m] a wall far beyond what any device renders

}  // namespace kerf::stability
