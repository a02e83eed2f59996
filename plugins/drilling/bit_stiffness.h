// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/outline.hpp"
#include "twist_drill.h"

/// How the bit bends, held at its chuck: stainless steel, half of the round section's I left by the flutes [assumed]. A
/// cone counts as wide as it ends; what is wider than the shank as the shank.
namespace kerf::drilling {

/// Returns what a force across the tip does to it:
///
///     δ = Σ (x₂³ − x₁³) / 3 E I_i,    s = Σ (x₂² − x₁²) / 2 E I_i,    I_i = ½ π d_i⁴/64
///
/// summed over its pieces of one diameter d_i, from x₁ to x₂ behind the tip.   [any] pure.
[[nodiscard]] Outline::Bending tip_bending(const TwistDrill& drill) noexcept;

/// Returns how stiffly a part of the bit at `z` ≤ 0 stands against bone of the stiffness `contact` [N/m], if the host
/// bends the bit by `tip_bending`: the bone in series with what is left over. A force at a = −z in the shape of the
/// tip's bending moves its own place by (δ − a s)²/δ; the bit gives way by
///
///     ∫ (x − a)² / E I dx,    a … l
///
/// The rest is 0 from some 0.7 l on, where the shape would give more.   [any] pure.
[[nodiscard]] double shank_stiffness(const TwistDrill& drill, Outline::Bending tip, double z, double contact) noexcept;

}  // namespace kerf::drilling
