// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/outline.hpp"
#include "twist_drill.h"

/// Bending stiffness of the bit, clamped at its chuck. The material is stainless steel; the flutes leave half of the
/// round section's I [assumed]. A cone counts with its widest diameter, and the head with no more than the shank's.
namespace kerf::drilling {

/// Returns the deflection and slope of the tip per unit force across it [m/N, rad/N]:
///
///     δ = Σ (x₂³ − x₁³) / 3 E I_i,    s = Σ (x₂² − x₁²) / 2 E I_i,    I_i = ½ π d_i⁴/64
///
/// summed over the pieces of constant diameter d_i, from x₁ to x₂ behind the tip.   [any] pure.
[[nodiscard]] Outline::Bending tip_bending(const TwistDrill& drill) noexcept;

/// Returns the stiffness [N/m] of a contact point on the bit at `z` ≤ 0 [m], for a host that bends the bit by
/// `tip_bending`. It puts the bone's stiffness `contact` [N/m] in series with the compliance that the host leaves out.
/// The host's shape moves the point at a = −z by (δ − a s)²/δ per unit force there. The true compliance is
///
///     ∫ (x − a)² / E I dx,    a … l
///
/// The remainder vanishes from about 0.7 l on, where the host's shape would be more compliant.   [any] pure.
[[nodiscard]] double shank_stiffness(const TwistDrill& drill, Outline::Bending tip, double z, double contact) noexcept;

}  // namespace kerf::drilling
