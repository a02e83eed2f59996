// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "burr_head.h"
#include "kerf/cutter_parameters.hpp"
#include "kerf/outline.hpp"
#include "kerf/plugin.hpp"

/// The burrs with their parameters.
namespace kerf::burring {

inline constexpr double slowest_cut = 1000.0 / 60.0;  ///< [1/s] from this speed on the burr removes bone [assumed]

/// Parameters common to all burrs, SI.
struct Burr : MotorParameters {
    double diameter, blades, neck_diameter, length;
    double spindle_speed;  ///< commanded

    static constexpr auto common() {
        using namespace literals;
        return group(strategies("kerf.burring.displace", "kerf.remesh_cgal.local", "kerf.remesh_cgal.exact"),
                     param(&Burr::diameter, {.id = "diameter",
                                             .help = "Largest diameter of the head.",
                                             .unit = unit::mm,
                                             .min = 0.5_mm,
                                             .max = 12.0_mm,
                                             .def = 4.0_mm,
                                             .source = "4.0 mm [mandibular-angle]"}),
                     param(&Burr::blades, {.id = "blades",
                                           .help = "Cutting blades around the head, a whole number.",
                                           .min = 1.0,
                                           .max = 40.0,
                                           .def = 6.0,
                                           .source = "six [mandibular-angle]"}),
                     param(&Burr::neck_diameter, {.id = "neck_diameter",
                                                  .help = "Diameter of the smooth shaft behind the head.",
                                                  .unit = unit::mm,
                                                  .min = 0.2_mm,
                                                  .max = 6.0_mm,
                                                  .def = 1.6_mm,
                                                  .source = "assumed"}),
                     param(&Burr::length, {.id = "length",
                                           .help = "From the tip to the handpiece.",
                                           .unit = unit::mm,
                                           .min = 10.0_mm,
                                           .max = 150.0_mm,
                                           .def = 45.0_mm,
                                           .source = "assumed"}),
                     torque_parameter({.help = "The most the motor turns or brakes with.",
                                       .min = 0.5_Nmm,
                                       .max = 500.0_Nmm,
                                       .def = 30.0_Nmm,
                                       .source = "assumed: order of electric high-speed handpieces"}),
                     run_up_parameter("Time the unloaded motor takes to 50000 rpm.", 500.0_ms,
                                      "assumed: a controller's soft start; 0 makes the speed follow at once"),
                     inertia_parameter({.help = "Of all that turns, at the burr.",
                                        .min = 1e-9_kg_m2,
                                        .max = 1e-4_kg_m2,
                                        .def = 2e-7_kg_m2,
                                        .source = "assumed: order of a small rotor"}),
                     drive(&Burr::spindle_speed, {.id = "spindle_speed",
                                                  .help = "Commanded speed of the burr; negative in reverse.",
                                                  .unit = unit::rpm,
                                                  .min = -80000.0_rpm,
                                                  .max = 80000.0_rpm,
                                                  .def = 50000.0_rpm,
                                                  .least = Quantity{slowest_cut, dimension::frequency}}));
    }
    [[nodiscard]] double radius() const noexcept { return 0.5 * diameter; }
    [[nodiscard]] Motor motor() const noexcept {
        using namespace literals;
        return motor_reaching(50000.0_rpm);
    }

protected:
    /// Returns the outline, or an error that names parameters which do not fit together.
    [[nodiscard]] Outline outline_of(const BurrHead& head) const noexcept;
};

/// A ball of blades.
struct RoundBurr : Burr {
    static constexpr auto about() { return describe("round_burr", "Ball with blades on a thin neck.", common()); }
    [[nodiscard]] BurrHead head() const noexcept;
    [[nodiscard]] Outline outline() const noexcept;
};

/// A cylinder with blades on its end and side.
struct CylindricalBurr : Burr {
    double head_length, corner_radius;

    static constexpr auto about() {
        using namespace literals;
        return describe("cylindrical_burr", "Cylinder with blades on its side and on its flat end.", common(),
                        param(&CylindricalBurr::head_length, {.id = "head_length",
                                                              .help = "Length of the head.",
                                                              .unit = unit::mm,
                                                              .min = 0.5_mm,
                                                              .max = 40.0_mm,
                                                              .def = 8.0_mm,
                                                              .source = "assumed"}),
                        param(&CylindricalBurr::corner_radius, {.id = "corner_radius",
                                                                .help = "Of the rounded corner between end and side.",
                                                                .unit = unit::mm,
                                                                .min = 0.05_mm,
                                                                .max = 6.0_mm,
                                                                .def = 0.3_mm,
                                                                .source = "assumed"}));
    }
    [[nodiscard]] BurrHead head() const noexcept;
    [[nodiscard]] Outline outline() const noexcept;
};

/// A ball that narrows to a cone behind its equator.
struct PearBurr : Burr {
    double head_length, taper;

    static constexpr auto about() {
        using namespace literals;
        return describe("pear_burr", "Pear with blades: a ball that narrows to a cone towards the neck.", common(),
                        param(&PearBurr::head_length,
                              {.id = "head_length",
                               .help = "Length of the head: more than the ball's part, which goes to 90° + `taper`.",
                               .unit = unit::mm,
                               .min = 0.5_mm,
                               .max = 40.0_mm,
                               .def = 6.0_mm,
                               .source = "assumed"}),
                        param(&PearBurr::taper, {.id = "taper",
                                                 .help = "Angle of the cone's side to the axis.",
                                                 .unit = unit::deg,
                                                 .min = 1.0_deg,
                                                 .max = 45.0_deg,
                                                 .def = 12.0_deg,
                                                 .source = "assumed"}));
    }
    [[nodiscard]] BurrHead head() const noexcept;
    [[nodiscard]] Outline outline() const noexcept;
};

}  // namespace kerf::burring
