// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "printed_drill.h"

/// Drilling as [tsai-2007] prints it, sections 5.1 to 5.3. Its equations have no numbers: they are cited by section and
/// place. Slips are kept; the marks E00-… say which, and the tests show what each does.
namespace kerf::as_printed {

/// K_H, K_T and K_V are linear in the radius (5.1, last paragraph).
struct LinearInRadius {
    double at_axis;    ///< [N/m²]
    double per_metre;  ///< [N/m³]
    [[nodiscard]] double at(double r) const noexcept { return at_axis + per_metre * r; }
};

/// f = (f_q − r ω)/pps (5.1, first paragraph): feed per revolution [m] of an element at `r` [m].
/// As printed: a number less a product of numbers, so that tilting lowers the feed on both sides (E00-4), and 1/0 for a
/// drill that stands (E00-5). Not limited to what goes forward.
[[nodiscard]] double feed_per_revolution(double feed_rate, double r, double tilt_rate, double revolutions) noexcept;

/// Thrust and radial force of a lip's element at `r` [m] from its loads F_T and F_V [N] (5.1, second display):
///
///     trust  =  cos θ F_T + √(r² − b²)/r sin θ F_V
///     radius =  √(r² − b²)/r sin θ F_T − cos θ F_V
///
/// θ is not defined in the text; read as the point's half angle. As printed its rows have length cos i instead of 1, so
/// that force is lost (E00-1).
struct ThrustAndRadius {
    double thrust, radius;
};
[[nodiscard]] ThrustAndRadius lip_transform(double r, double half_web, SinCos theta, double f_t, double f_v) noexcept;

/// F_x, F_y from F_tang and F_radius (5.1, last display): a rotation by α.
struct Lateral {
    double x, y;
};
[[nodiscard]] Lateral lateral_force(double f_radius, double f_tang, SinCos alpha) noexcept;

/// Sums over all elements (5.1 second display, 5.2). As printed F_tang, F_radius, T_radius and T_thrust are plain sums
/// over both lips, which cannot cancel (E00-2), and T_thrust is a sum of moments about axes that differ (E00-3).
struct DrillingSums {
    double tang = 0.0, thrust = 0.0, radius = 0.0;                       ///< [N]
    double torque_tang = 0.0, torque_radius = 0.0, torque_thrust = 0.0;  ///< [N·m]
};

/// The force along the axis [N] that is rendered: F_thrust, and T_thrust "as a cyclic force adding to" it (5.2, last
/// paragraph), as the paper's device has no torques. By which length [m] a torque becomes a force is not stated: `arm`;
/// 0 leaves it out.
[[nodiscard]] double rendered_thrust(const DrillingSums& sum, double arm) noexcept;

struct Tsai2007 {
    double k_h, k_h_slope, k_t, k_t_slope, k_v, k_v_slope, k_c, sideways, element_interval, voxel_width, shank, softer,
        torque_arm;

    struct Signals {
        double f_tang = 0.0, f_radius = 0.0, t_tang = 0.0, t_radius = 0.0, t_thrust = 0.0;
    };
    static constexpr auto about() {
        using namespace literals;
        return describe(
            "tsai_2007", "[tsai-2007] sections 5.1 to 5.3, as printed.",
            param(&Tsai2007::k_h, {.id = "k_h",
                                   .help = "K_H at the axis: tangential.",
                                   .unit = unit::N_per_mm2,
                                   .min = 0.0,
                                   .max = in(unit::N_per_mm2, 1e11),
                                   .def = 1026.38_N_per_mm2,
                                   .source = femur_point}),
            param(&Tsai2007::k_h_slope, {.id = "k_h_slope",
                                         .help = "K_H per radius.",
                                         .unit = n_per_mm3,
                                         .min = in(n_per_mm3, -1e15),
                                         .max = in(n_per_mm3, 1e15),
                                         .def = 0.0,
                                         .source = not_stated}),
            param(&Tsai2007::k_t, {.id = "k_t",
                                   .help = "K_T at the axis: in the lip's plane, across the normal.",
                                   .unit = unit::N_per_mm2,
                                   .min = 0.0,
                                   .max = in(unit::N_per_mm2, 1e11),
                                   .def = 0.0,
                                   .source = not_stated}),
            param(&Tsai2007::k_t_slope, {.id = "k_t_slope",
                                         .help = "K_T per radius.",
                                         .unit = n_per_mm3,
                                         .min = in(n_per_mm3, -1e15),
                                         .max = in(n_per_mm3, 1e15),
                                         .def = 0.0,
                                         .source = not_stated}),
            param(&Tsai2007::k_v, {.id = "k_v",
                                   .help = "K_V at the axis: normal to the cut.",
                                   .unit = unit::N_per_mm2,
                                   .min = 0.0,
                                   .max = in(unit::N_per_mm2, 1e11),
                                   .def = 695.74_N_per_mm2,
                                   .source = femur_point}),
            param(&Tsai2007::k_v_slope, {.id = "k_v_slope",
                                         .help = "K_V per radius.",
                                         .unit = n_per_mm3,
                                         .min = in(n_per_mm3, -1e15),
                                         .max = in(n_per_mm3, 1e15),
                                         .def = 0.0,
                                         .source = not_stated}),
            param(&Tsai2007::k_c, {.id = "k_c",
                                   .help = "K_C of the chisel edge.",
                                   .unit = unit::N_per_mm2,
                                   .min = 0.0,
                                   .max = in(unit::N_per_mm2, 1e11),
                                   .def = 1269.67_N_per_mm2,
                                   .source = femur_point}),
            param(&Tsai2007::sideways, {.id = "sideways",
                                        .help = "Force of a surface point per speed into bone.",
                                        .unit = n_s_per_m,
                                        .min = 0.0,
                                        .max = in(n_s_per_m, 1e6),
                                        .def = in(n_s_per_m, 1.0),
                                        .source = not_stated}),
            as_printed::element_interval(&Tsai2007::element_interval), as_printed::voxel_width(&Tsai2007::voxel_width),
            as_printed::shank(&Tsai2007::shank), as_printed::softer(&Tsai2007::softer),
            param(&Tsai2007::torque_arm,
                  {.id = "torque_arm",
                   .help = "T_thrust over this length is added to the thrust, as a force; 0: it is not.",
                   .unit = unit::mm,
                   .min = 0.0,
                   .max = 300.0_mm,
                   .def = 0.0,
                   .source = "[tsai-2007] section 5.2 adds it and states no length: off"}),
            signal(&Signals::f_tang, {.id = "f_tang", .help = "F_tang: a sum without directions.", .unit = unit::N}),
            signal(&Signals::f_radius,
                   {.id = "f_radius", .help = "F_radius: a sum without directions.", .unit = unit::N}),
            signal(&Signals::t_tang, {.id = "t_tang", .help = "T_tang: against the spin.", .unit = unit::N_mm}),
            signal(&Signals::t_radius, {.id = "t_radius", .help = "T_radius.", .unit = unit::N_mm}),
            signal(&Signals::t_thrust, {.id = "t_thrust", .help = "T_thrust.", .unit = unit::N_mm}), budget_us(1000));
    }

    using State = LastInterval;

    void resist(const Held<PaperBit>& tool, const BoneQuery& bone, const State& state,
                Channels& channels) const noexcept;
    void commit(const Held<PaperBit>& tool, const BoneQuery& bone, const Advance& advance, State& state,
                Signals& signals, Actions& actions) const noexcept;
};

}  // namespace kerf::as_printed
