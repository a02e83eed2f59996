// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugins/implant/screw_thread.h"

/// Twelve screws in foam of 237.2 kg/m³ (PCF 15), inserted to 25 mm. Source: [weidling-2022], table 2.
namespace kerf::test {

struct MeasuredScrew {
    const char* name;
    double outer, core, pitch;  ///< [m]
    double contact;             ///< [m²]
    double torque;              ///< [N·m]
};
inline constexpr double weidling_density = 237.2;  // [kg/m³]
inline constexpr MeasuredScrew weidling[] = {
    {"1a-6", 6.0e-3, 3.65e-3, 3.0e-3, 429e-6, 1.36},   {"1a-7", 7.0e-3, 4.04e-3, 3.0e-3, 532e-6, 1.88},
    {"2a-6", 6.0e-3, 3.86e-3, 3.0e-3, 430e-6, 1.31},   {"2a-7", 7.0e-3, 3.94e-3, 3.0e-3, 519e-6, 1.83},
    {"3a-6.2", 6.2e-3, 4.36e-3, 2.0e-3, 548e-6, 1.82}, {"3a-7", 7.0e-3, 5.03e-3, 2.0e-3, 599e-6, 2.50},
    {"4-6.5", 6.5e-3, 4.15e-3, 4.0e-3, 464e-6, 1.32},  {"4-7.5", 7.5e-3, 4.78e-3, 4.0e-3, 564e-6, 1.72},
    {"5-6.5", 6.5e-3, 4.25e-3, 2.75e-3, 591e-6, 1.72}, {"5-7.5", 7.5e-3, 4.99e-3, 2.75e-3, 716e-6, 2.59},
    {"6-6.5", 6.5e-3, 4.45e-3, 2.8e-3, 500e-6, 1.20},  {"6-7.5", 7.5e-3, 5.10e-3, 2.8e-3, 605e-6, 1.67},
};

/// Radius of a hole for it [m], 10 % narrower than its core. All twelve compact bone; by how much is not known, and the
/// pressure of the law is full from 2 % on.
inline double pilot_radius_of(const MeasuredScrew& s) { return 0.45 * s.core; }

/// 25 mm of thread behind a short tip; nothing is known of its flutes, so it has none.
inline implant::ScrewThread thread_of(const MeasuredScrew& s) {
    return {.outer = s.outer,
            .outer_at_tip = s.outer,
            .core = s.core,
            .core_at_tip = s.core,
            .pitch = s.pitch,
            .starts = 1.0,
            .length = s.core + 25e-3,
            .flank_angle = 0.26,
            .flutes = 0.0,
            .flute_length = 0.0,
            .head = 12e-3,
            .seat = s.core + 25e-3,
            .takes_chips_out = false};
}

}  // namespace kerf::test
