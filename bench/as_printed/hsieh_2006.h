// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "kerf/exact_math.hpp"
#include "kerf/force.hpp"

/// Sawing as [hsieh-2006] prints it, sections 2.2 to 2.4. Its equations have no numbers: they are cited by section.
/// Slips are kept; the marks E03-… say which, and the tests show what each does.
namespace kerf::as_printed {

/// The saw's parameters, in the order plugin.cpp declares them.
enum SawParameter : std::size_t {
    saw_length,
    saw_pitch,
    saw_teeth,
    saw_bend,
    saw_swing,
    saw_kerf,
    saw_parameter_count
};
inline constexpr std::size_t drive_oscillation = 0, saw_drive_count = 1;
inline constexpr std::size_t most_saw_teeth = 64;

/// β of the tooth `offset` = n p [m] from the saw's axis (2.2): tan⁻¹(l/(np − c(np)²)). As printed a right angle for
/// the tooth in the middle (E03-2), where the text wants teeth at small angles. Places and forces therefore take the
/// fraction turned over, tan⁻¹(np/(l − c(np)²)): the printed one puts no tooth near bone.
[[nodiscard]] double tooth_angle_as_printed(double length, double offset, double bend) noexcept;

/// A = Δ w p f/u (2.4) [m³]. As printed a volume, not the area it is called (E03-1); 1/0 for a saw that stands.
[[nodiscard]] double chip_as_printed(double width, double pitch, double feed_rate, double oscillation) noexcept;

/// F_x, F_z of a tooth at θ (2.4): F_z = cos θ F_n − sin θ F_l, F_x = sin θ F_l + cos θ F_n. As printed no rotation:
/// the force along the feed comes back across it (E03-3). F_l has no sign: it does not turn with the oscillation
/// (E03-4).
struct SawForce {
    double x, z;
};
[[nodiscard]] SawForce saw_force(SinCos theta, double normal, double lateral) noexcept;

struct Hsieh2006 {
    struct State {
        double phase = 0.0;  ///< [rad]
        Vec6 rate{};         ///< of the last interval, tool frame
    };
    enum Parameter : std::size_t {
        k_normal,
        k_lateral,
        k_radial,
        tooth_width,
        per_point,
        point_interval,
        force_parameter_count
    };
    enum Signal : std::size_t { teeth_in_bone, f_x, f_y, f_z, signal_count };
    static constexpr std::size_t drive_count = saw_drive_count;

    /// Teeth while it oscillates (2.4), immersed points while it is still (2.3). Nothing is removed while sawing (2.1).
    static void resist(const Tick& tick, const BoneQuery& bone, const State& state, Channels& channels) noexcept;
    static void commit(const Tick& tick, const BoneQuery& bone, const Advance& advance, State& state,
                       std::span<double> signals, Actions& actions) noexcept;
};
static_assert(ForceLaw<Hsieh2006>);

}  // namespace kerf::as_printed
