// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "kerf/cutter_parameters.hpp"
#include "kerf/plugin.hpp"
#include "twist_drill.h"

/// The drills with their parameters, SI.
namespace kerf::drilling {

inline constexpr std::size_t spindle_drive = 0;  ///< index of the one drive of every drill
inline constexpr double slowest_cut = 0.5;       ///< [1/s] from this speed on the drill removes bone

/// Parameters common to all drills.
struct DrillBit : MotorParameters {
    double diameter, point_angle, web, length, corner;
    double runout, helix_angle, mass, yield_strength;
    double spindle_speed;  ///< commanded

    // NOLINTNEXTLINE(readability-function-size): a table, one row for each parameter
    static constexpr auto common() {
        using namespace literals;
        return group(
            strategies("kerf.remesh_cgal.local", "kerf.remesh_cgal.exact"),
            param(&DrillBit::diameter, {.id = "diameter",
                                        .help = "Diameter over the lips.",
                                        .unit = unit::mm,
                                        .min = 0.5_mm,
                                        .max = 20.0_mm,
                                        .def = 3.2_mm,
                                        .source = "the drill of [macavelia-2012]"}),
            param(&DrillBit::point_angle, {.id = "point_angle",
                                           .help = "Full angle of the point.",
                                           .unit = unit::deg,
                                           .min = 60.0_deg,
                                           .max = 160.0_deg,
                                           .def = 118.0_deg,
                                           .source = "standard grind"}),
            param(&DrillBit::web, {.id = "web",
                                   .help = "Web thickness at the point, as a share of the diameter.",
                                   .min = 0.05,
                                   .max = 0.4,
                                   .def = 0.15,
                                   .source = "assumed: common for surgical twist drills"}),
            param(&DrillBit::length, {.id = "length",
                                      .help = "From the tip to the chuck, which bone does not stop.",
                                      .unit = unit::mm,
                                      .min = 10.0_mm,
                                      .max = 300.0_mm,
                                      .def = 80.0_mm,
                                      .source = "assumed"}),
            param(&DrillBit::corner,
                  {.id = "corner",
                   .help = "Length behind the corner that still cuts sideways, as a share of the diameter.",
                   .min = 0.05,
                   .max = 1.0,
                   .def = 0.25,
                   .source = "assumed"}),
            torque_parameter({.help = "The most the motor turns or brakes with.",
                              .min = 10.0_Nmm,
                              .max = 20000.0_Nmm,
                              .def = 2000.0_Nmm,
                              .source = "assumed: order of battery-driven surgical drills"}),
            param(&DrillBit::runout, {.id = "runout",
                                      .help = "How far the tip runs off the axis it turns about.",
                                      .unit = unit::mm,
                                      .min = 0.0,
                                      .max = 0.5_mm,
                                      .def = 0.0,
                                      .source = "a true bit; 0.05 mm is common"}),
            param(&DrillBit::helix_angle, {.id = "helix_angle",
                                           .help = "Helix of the flutes at the diameter: the rake of the lips.",
                                           .unit = unit::deg,
                                           .min = 0.0,
                                           .max = 45.0_deg,
                                           .def = 28.0_deg,
                                           .source = "assumed: that of the drill the coefficients were fitted with"}),
            run_up_parameter("Time the unloaded motor takes to 1000 rpm.", 200.0_ms,
                             "assumed: a controller's soft start; 0 makes the speed follow at once"),
            inertia_parameter({.help = "Of all that turns, at the chuck.",
                               .min = 1e-7_kg_m2,
                               .max = 0.01_kg_m2,
                               .def = 5e-5_kg_m2,
                               .source = "assumed: order of a small rotor behind its gear"}),
            param(&DrillBit::mass,
                  {.id = "mass",
                   .help = "Of drill and handpiece, centred where the hand holds them; felt across the shaft.",
                   .unit = unit::kg,
                   .min = 0.0,
                   .max = 5.0_kg,
                   .def = 0.5_kg,
                   .source = "assumed: order of a small surgical drill"}),
            param(&DrillBit::yield_strength, {.id = "yield_strength",
                                              .help = "Bending stress beyond which the bit stays bent, or breaks.",
                                              .unit = unit::N_per_mm2,
                                              .min = 100.0_N_per_mm2,
                                              .max = 5000.0_N_per_mm2,
                                              .def = 1000.0_N_per_mm2,
                                              .source = "assumed: order of hardened stainless steel"}),
            drive(&DrillBit::spindle_speed, {.id = "spindle_speed",
                                             .help = "Commanded speed of the spindle; negative in reverse.",
                                             .unit = unit::rpm,
                                             .min = -3000.0_rpm,
                                             .max = 3000.0_rpm,
                                             .def = 1000.0_rpm,
                                             .least = Quantity{slowest_cut, dimension::frequency}}),
            effect(&DrillBit::runout, {.id = "runout", .help = "A tip that runs off its axis cuts wide and swings."}));
    }
    [[nodiscard]] Motor motor() const noexcept {
        using namespace literals;
        return motor_reaching(1000.0_rpm);
    }

protected:
    /// Returns the geometry of the point, without an outline behind it.
    [[nodiscard]] TwistDrill point() const noexcept;
    [[nodiscard]] Outline outline_of(const TwistDrill& drill) const noexcept;
};

struct TwistBit : DrillBit {
    static constexpr auto about() {
        return describe("twist_drill", "Twist drill with two lips and a chisel edge.", common());
    }
    [[nodiscard]] TwistDrill drill() const noexcept { return point(); }
    [[nodiscard]] Outline outline() const noexcept { return outline_of(drill()); }
};

struct StepBit : DrillBit {
    double shoulder_diameter, shoulder_angle, shoulder_depth;

    static constexpr auto about() {
        using namespace literals;
        return describe(
            "step_drill", "Twist drill with a wider part behind the point: countersink, taper, step.", common(),
            param(&StepBit::shoulder_diameter,
                  {.id = "shoulder_diameter",
                   .help = "Diameter of the wider part behind the point: wider than `diameter`.",
                   .unit = unit::mm,
                   .min = 0.5_mm,
                   .max = 30.0_mm,
                   .def = 5.0_mm,
                   .source = "assumed"}),
            param(&StepBit::shoulder_angle,
                  {.id = "shoulder_angle",
                   .help = "Full angle of the cone up to it: 90 deg a countersink, a few degrees a taper.",
                   .unit = unit::deg,
                   .min = 2.0_deg,
                   .max = 160.0_deg,
                   .def = 90.0_deg,
                   .source = "common for countersinks"}),
            param(&StepBit::shoulder_depth, {.id = "shoulder_depth",
                                             .help = "From the tip to where that cone begins: no less than the point "
                                                     "is deep, half of `diameter` over tan(`point_angle`/2).",
                                             .unit = unit::mm,
                                             .min = 0.0,
                                             .max = 200.0_mm,
                                             .def = 10.0_mm,
                                             .source = "assumed"}));
    }
    [[nodiscard]] TwistDrill drill() const noexcept;
    [[nodiscard]] Outline outline() const noexcept;
};

struct ProfileBit : DrillBit {
    double shank_diameter;
    std::array<double, TwistDrill::max_corners> corner_depth, corner_diameter;

private:
    static constexpr const char* depth_id[] = {"depth_1", "depth_2", "depth_3", "depth_4",
                                               "depth_5", "depth_6", "depth_7", "depth_8"};
    static constexpr const char* diameter_id[] = {"diameter_1", "diameter_2", "diameter_3", "diameter_4",
                                                  "diameter_5", "diameter_6", "diameter_7", "diameter_8"};

    template <std::size_t i>
    static constexpr auto corner() {
        using namespace literals;
        return group(
            param(+[](ProfileBit& bit) -> double& { return bit.corner_depth[i]; },
                  {.id = depth_id[i],
                   .help = "From the tip to this corner of the outline behind the point, 0.01 mm and more behind the "
                           "corner before; 0: neither this corner nor a further one exists.",
                   .unit = unit::mm,
                   .min = 0.0,
                   .max = 200.0_mm,
                   .def = 0.0,
                   .source = "as the tool is"}),
            param(
                +[](ProfileBit& bit) -> double& { return bit.corner_diameter[i]; },
                {.id = diameter_id[i],
                 .help =
                     "Diameter at this corner: that of the corner before, or wider by a degree of half angle and more.",
                 .unit = unit::mm,
                 .min = 0.0,
                 .max = 30.0_mm,
                 .def = 0.0,
                 .source = "as the tool is"}));
    }

public:
    static constexpr auto about() {
        using namespace literals;
        return []<std::size_t... I>(std::index_sequence<I...>) {
            return describe(
                "profile_drill",
                "Drill of any outline, with two lips along all that widens: several steps, an acorn, a ball on a thin "
                "shank; an awl with its spindle off.",
                common(),
                param(
                    &ProfileBit::shank_diameter,
                    {.id = "shank_diameter",
                     .help = "Diameter behind the corners and the land, where it is thinner than they are; 0: as wide.",
                     .unit = unit::mm,
                     .min = 0.0,
                     .max = 30.0_mm,
                     .def = 0.0,
                     .source = "as the tool is"}),
                corner<I>()...);
        }
        (std::make_index_sequence<TwistDrill::max_corners>{});
    }
    [[nodiscard]] TwistDrill drill() const noexcept;
    [[nodiscard]] Outline outline() const noexcept;
};

}  // namespace kerf::drilling
