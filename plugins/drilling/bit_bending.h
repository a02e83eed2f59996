// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/force.hpp"
#include "twist_drill.h"

/// Bending stress of the bit.
namespace kerf::drilling {

/// Returns the largest bending stress in the bit [Pa]. The chuck clamps the bit; each channel force and
/// `advance.following` load it.
///
///     σ = |M| / W,    W = I / (d/2) = π d³/64,    I = ½ π d⁴/64
///
/// evaluated at the chuck and at the height of each force. d is the bit's diameter there; the flutes leave half of the
/// round section's I [assumed]. Leaves out torsion, thrust and notches.   [haptic, nonblocking]
[[nodiscard]] double bending_stress(const TwistDrill& drill, const Advance& advance) noexcept;

}  // namespace kerf::drilling
