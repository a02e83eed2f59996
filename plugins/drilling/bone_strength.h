// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kerf/abi.h"

/// Compressive strength of bone.
namespace kerf::drilling {

/// Returns the pressure [Pa] that crushes bone of density `rho` [kg/m³].
///
///     S = 68 MPa (ρ / 1 g/cm³)²    at 1/s
///
/// [any] pure.   Source: [carter-hayes-1977].
[[nodiscard]] constexpr double crushing_pressure(double rho) noexcept {
    const double grams_per_cm3 = 1e-3 * rho;
    return 68e6 * grams_per_cm3 * grams_per_cm3;
}

/// Returns the pressure [Pa] that crushes the bone at a sample: the weighted sum over its tissues.   [any] pure.
[[nodiscard]] inline double crushing_pressure(const kerf_bone_sample& sample, std::uint32_t tissues) noexcept {
    double pressure = 0.0;
    for (std::uint32_t i = 0; i < tissues; ++i) pressure += sample.weight[i] * crushing_pressure(sample.density[i]);
    return pressure;
}

}  // namespace kerf::drilling
