// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

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
    using State = LastInterval;
    enum Parameter : std::size_t {
        k_h,
        k_h_slope,
        k_t,
        k_t_slope,
        k_v,
        k_v_slope,
        k_c,
        sideways,
        element_interval,
        voxel_width,
        shank,
        softer,
        torque_arm,
        force_parameter_count
    };
    enum Signal : std::size_t { f_tang, f_radius, t_tang, t_radius, t_thrust, signal_count };
    static constexpr std::size_t drive_count = as_printed::drive_count;

    static void resist(const Tick& tick, const BoneQuery& bone, const State& state, Channels& channels) noexcept;
    static void commit(const Tick& tick, const BoneQuery& bone, const Advance& advance, State& state,
                       std::span<double> signals, Actions& actions) noexcept;
};
static_assert(ForceLaw<Tsai2007>);

}  // namespace kerf::as_printed
