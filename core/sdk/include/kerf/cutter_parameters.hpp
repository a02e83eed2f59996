// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/describe.hpp"
#include "kerf/spindle.hpp"

/// Parameters common to the laws and tools of powered cutters, each with one id, unit and range:
///
///     edge_force(&Law::thrust_edge, {"thrust_edge", "…", 500.0_N_per_mm, 60.0_N_per_mm, "…"})
///
/// Texts, defaults and bounds that differ between cutters are arguments.
namespace kerf {

/// The fields of a coefficient's description that differ from law to law.
struct CoefficientText {
    const char* id;
    const char* help;
    Amount max, def;
    const char* source;
};
/// Describes a force per width of cut, 0 to `text.max`.
template <class Law>
[[nodiscard]] constexpr Param<Law> edge_force(double Law::*member, CoefficientText text) {
    return param(member, {.id = text.id,
                          .help = text.help,
                          .unit = unit::N_per_mm,
                          .min = 0.0,
                          .max = text.max,
                          .def = text.def,
                          .source = text.source});
}
/// Describes a force per chip area, 0 to 10000 N/mm².
template <class Law>
[[nodiscard]] constexpr Param<Law> chip_force(double Law::*member, const char* id, const char* help, Amount def,
                                              const char* source) {
    using namespace literals;
    return param(member, {.id = id,
                          .help = help,
                          .unit = unit::N_per_mm2,
                          .min = 0.0,
                          .max = 10000.0_N_per_mm2,
                          .def = def,
                          .source = source});
}
/// Describes `edge_depth`, t_e of EdgeCoefficients, in µm.
template <class Law>
[[nodiscard]] constexpr Param<Law> edge_depth_of(double Law::*member, Quantity min, Quantity max, Quantity def,
                                                 const char* source) {
    return param(member, {.id = "edge_depth",
                          .help = "Chip thickness at which the edge force has built up.",
                          .unit = unit::um,
                          .min = min,
                          .max = max,
                          .def = def,
                          .source = source});
}
/// Describes `reference_density`: the coefficients are those of bone of this density.
template <class Law>
[[nodiscard]] constexpr Param<Law> reference_density_of(
    double Law::*member, const char* help = "Density of the bone the coefficients were fitted to.") {
    using namespace literals;
    return param(member, {.id = "reference_density",
                          .help = help,
                          .unit = unit::g_per_cm3,
                          .min = 0.5_g_per_cm3,
                          .max = 2.5_g_per_cm3,
                          .def = 1.85_g_per_cm3,
                          .source = "assumed: middle of the cortical range"});
}
/// Describes `contact_stiffness` of bone against parts that do not cut.
template <class Law>
[[nodiscard]] constexpr Param<Law> contact_stiffness_of(double Law::*member, const char* help) {
    using namespace literals;
    return param(member, {.id = "contact_stiffness",
                          .help = help,
                          .unit = unit::N_per_mm,
                          .min = 1.0_N_per_mm,
                          .max = 10000.0_N_per_mm,
                          .def = 500.0_N_per_mm,
                          .source = "assumed"});
}
/// Describes `friction` of steel on wet bone.
template <class Law>
[[nodiscard]] constexpr Param<Law> steel_friction(double Law::*member, const char* source = "assumed") {
    return param(member, {.id = "friction",
                          .help = "Friction of steel on wet bone.",
                          .min = 0.0,
                          .max = 1.5,
                          .def = 0.3,
                          .source = source});
}

/// The motor parameters of a tool. Tools derive from it.
struct MotorParameters {
    double motor_torque;  ///< [N·m] maximum, to drive or to brake
    double run_up;        ///< [s] unloaded, to the speed of `motor_reaching`; 0: the speed follows at once
    double inertia;       ///< [kg·m²] of all moving parts

    [[nodiscard]] constexpr Motor motor_reaching(double speed) const noexcept {
        return Motor::with_run_up(run_up, speed, motor_torque, inertia);
    }

    struct MotorText {
        const char* help;
        Amount min, max, def;
        const char* source;
    };
    [[nodiscard]] static constexpr Param<MotorParameters> torque_parameter(MotorText text) {
        return param(&MotorParameters::motor_torque, {.id = "motor_torque",
                                                      .help = text.help,
                                                      .unit = unit::N_m,
                                                      .min = text.min,
                                                      .max = text.max,
                                                      .def = text.def,
                                                      .source = text.source});
    }
    /// Describes `run_up`, 0 to 5 s.
    [[nodiscard]] static constexpr Param<MotorParameters> run_up_parameter(const char* help, Quantity def,
                                                                           const char* source) {
        using namespace literals;
        return param(&MotorParameters::run_up, {.id = "run_up",
                                                .help = help,
                                                .unit = unit::ms,
                                                .min = 0.0,
                                                .max = 5000.0_ms,
                                                .def = def,
                                                .source = source});
    }
    [[nodiscard]] static constexpr Param<MotorParameters> inertia_parameter(MotorText text) {
        return param(&MotorParameters::inertia, {.id = "inertia",
                                                 .help = text.help,
                                                 .unit = unit::kg_mm2,
                                                 .min = text.min,
                                                 .max = text.max,
                                                 .def = text.def,
                                                 .source = text.source});
    }
};

}  // namespace kerf
