// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/force.hpp"
#include "twist_drill.h"

/// How hard the bit is bent.
namespace kerf::drilling {

/// The largest bending stress in the bit [Pa], held at its chuck and loaded where its channels push and by what follows
/// them, as it was given:
///
///     σ = |M| / W,    W = I / (d/2) = π d³/64,    I = ½ π d⁴/64
///
/// at the chuck and wherever something pushes; d the bit's diameter there, half of the round section's I left by the
/// flutes [assumed]. Leaves out torsion, thrust and notches.   [haptic, nonblocking]
[[nodiscard]] double bending_stress(const TwistDrill& drill, const Advance& advance) noexcept;

}  // namespace kerf::drilling
