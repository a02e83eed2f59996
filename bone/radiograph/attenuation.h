// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How strongly tissues and metals attenuate X-rays, at one effective energy of 60 keV.
namespace kerf::bone {

/// Linear attenuation coefficients [1/m]: mass attenuation × density, [hubbell-seltzer-2004].
inline constexpr double water_attenuation = 20.59;         ///< 0.2059 cm²/g, 1.00 g/cm³
inline constexpr double titanium_attenuation = 345.2;      ///< 0.7661 cm²/g, 4.506 g/cm³
inline constexpr double steel_attenuation = 952.0;         ///< 1.205 cm²/g of iron, 7.9 g/cm³
inline constexpr double compact_bone_density = 1920.0;     ///< [kg/m³] cortical bone of ICRU 44
inline constexpr double compact_bone_attenuation = 60.44;  ///< 0.3148 cm²/g, 1.92 g/cm³

/// Returns the linear attenuation coefficient [1/m] of bone of an apparent density ≥ 0 [kg/m³].
///
///     μ(ρ) = μ_water + (μ_compact − μ_water) ρ / ρ_compact
///
/// Pores contain marrow, which counts as water: so does a tissue with hardly any bone, such as the canal of a shaft.
/// [any] pure.
[[nodiscard]] constexpr double bone_attenuation(double density) noexcept {
    return water_attenuation + (compact_bone_attenuation - water_attenuation) / compact_bone_density * density;
}

}  // namespace kerf::bone
