// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "studies/chart/drill/lip_integral.h"
#include "studies/chart/drill/method.h"
#include "studies/chart/trial.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// S-16: from tick to tick no more than one point of 31 is worth [–].
inline constexpr double largest_step = 1.0 / 31.0;

/// The tests that apply to a force of drilling, each on one small block, at one fineness:
///
///     S-01  a hand pushes into the block at the device: stable in the sense of the stability suite
///     S-07  twice as many sample points change the force by less than 5 %
///     S-12  back into a hole that has been made: under 0.05 N
///     S-19  a drill that stands, its spindle switched off: every force finite
///     P9    a drill that stands while it turns: under 0.05 N; not of what is solved, as a led hand holds a stretch
///
/// [main]
[[nodiscard]] Standing standing_of(const Method& method, const CuttingLaw& law, const Fineness& fineness);

/// K_max [N/m]: the stiffest wall on which a bare device, without friction and counts, swings less and less. For what
/// is evaluated at the device's rate, whatever its law, that of a sampled spring; for what is solved, the stiffest
/// coupling, damped as it is by default.   [main]
[[nodiscard]] double stiffest(const Method& method, const CuttingLaw& law);

}  // namespace kerf::chart
