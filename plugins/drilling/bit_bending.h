// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "kerf/force.hpp"
#include "twist_drill.h"

/// Bending stress of the bit.
namespace kerf::drilling {

/// Bending stress [Pa] at the surface of the bit.
struct Bending {
    double about_x = 0.0, about_y = 0.0;  ///< by the moment about the tool's axes

    [[nodiscard]] double stress() const noexcept { return std::sqrt(about_x * about_x + about_y * about_y); }
};

/// Returns the bending of the section with the largest stress. The chuck clamps the bit; each channel force and
/// `advance.following` load it.
///
///     σ = |M| / W,    W = I / (d/2) = π d³/64,    I = ½ π d⁴/64
///
/// evaluated at the chuck and at the height of each force. d is the bit's diameter there; the flutes leave half of the
/// round section's I [assumed]. Leaves out torsion, thrust and notches.   [haptic, nonblocking]
[[nodiscard]] Bending bending_of(const TwistDrill& drill, const Advance& advance) noexcept;

}  // namespace kerf::drilling
