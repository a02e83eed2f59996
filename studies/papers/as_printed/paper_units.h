// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/describe.hpp"

/// Units and parameters that several of the papers' laws share.
namespace kerf::as_printed {

inline constexpr DisplayUnit n_per_mm3{"N/mm3", {{-2, 1, -2, 0, 0, 0, 0, 0}}};
inline constexpr DisplayUnit n_s_per_m{"N s/m", dimension::damping};
inline constexpr DisplayUnit n_per_density{"N cm3/g", {{4, 0, -2, 0, 0, 0, 0, 0}}};
inline constexpr DisplayUnit per_metre{"1/m", {{-1, 0, 0, 0, 0, 0, 0, 0}}};

/// A value in SI of a unit that has no literal.
[[nodiscard]] constexpr Quantity in(DisplayUnit unit, double si) noexcept { return {si, unit.dimension}; }

inline constexpr const char* femur_point =
    "no paper reports a coefficient; calibrated: thrust 198.4 N and torque 186.3 N mm of a 3.2 mm drill at 2 mm/s and "
    "1000 rpm [macavelia-2012], 45 % of the thrust on the chisel edge [saha-1982]";
inline constexpr const char* not_stated = "not stated in the paper: assumed";

template <class T>
[[nodiscard]] constexpr Param<T> element_interval(double T::*member) noexcept {
    using namespace literals;
    return param(member, {.id = "element_interval",
                          .help = "Distance of sample points along the edges.",
                          .unit = unit::mm,
                          .min = 0.01_mm,
                          .max = 5.0_mm,
                          .def = 0.1_mm,
                          .source = "[tsai-2007] section 5: 0.1 mm"});
}
template <class T>
[[nodiscard]] constexpr Param<T> voxel_width(double T::*member) noexcept {
    using namespace literals;
    return param(member, {.id = "voxel_width",
                          .help = "Distance of sample points on the drill's surface: one voxel.",
                          .unit = unit::mm,
                          .min = 0.05_mm,
                          .max = 2.0_mm,
                          .def = 1.0_mm,
                          .source = "[tsai-2007] section 4, [volumetric-drilling] section III.A"});
}
template <class T>
[[nodiscard]] constexpr Param<T> shank(double T::*member) noexcept {
    using namespace literals;
    return param(member, {.id = "shank",
                          .help = "How far behind the tip the surface has points.",
                          .unit = unit::mm,
                          .min = 1.0_mm,
                          .max = 200.0_mm,
                          .def = 100.0_mm,
                          .source = "[tsai-2007] section 4: 10 cm"});
}
template <class T>
[[nodiscard]] constexpr Param<T> softer(double T::*member) noexcept {
    return param(member,
                 {.id = "softer",
                  .help = "Coefficients of a less dense tissue, as a fraction of the densest one's.",
                  .min = 0.0,
                  .max = 1.0,
                  .def = 0.1,
                  .source = "determined empirically by type of bone, figures not stated; 1:10 for the layered slab"});
}

}  // namespace kerf::as_printed
