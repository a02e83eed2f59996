// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "printed_drill.h"

/// Drilling as [volumetric-drilling] prints it: force of an element that cuts two materials (equations 1 and 2), and
/// bone that goes where the points of the drill have met it (section III.A).
namespace kerf::as_printed {

/// Equation 2: dF_r, dF_c, dF_e from dF_n and dF_f [N], with rake φ, inclination τ and chip flow ψ. As printed dF_e
/// begins with the terms of dF_c, so that force is made out of nothing (E01-2).
struct ObliqueForce {
    double r, c, e;
};
[[nodiscard]] ObliqueForce oblique_force(double f_n, double f_f, SinCos rake, SinCos inclination, SinCos flow) noexcept;
/// The same with what E01-2 puts right: for tests.
[[nodiscard]] ObliqueForce oblique_force_corrected(double f_n, double f_f, SinCos rake, SinCos inclination,
                                                   SinCos flow) noexcept;

/// t = f_t/2 = U/(2ω) [m] (section III.B). As printed with the angular velocity, in rad/s: low by 2π (E01-3).
[[nodiscard]] double chip_thickness(double feed_rate, double revolutions) noexcept;

struct VolumetricDrilling {
    using State = LastInterval;
    enum Parameter : std::size_t {
        k_n,
        k_f,
        softer,
        rake,
        element_interval,
        voxel_width,
        shank,
        force_parameter_count
    };
    enum Signal : std::size_t { thrust, signal_count };
    static constexpr std::size_t drive_count = as_printed::drive_count;

    static void resist(const Tick& tick, const BoneQuery& bone, const State& state, Channels& channels) noexcept;
    /// Asks where shell, inside and the shell's ways of this interval lie, one voxel apart: a host that wears bone
    /// where it is asked about takes what the paper takes. An isotropic way crosses 1 + 1.5 L voxels, and points one
    /// voxel apart are in at most 1 + L of them (E01-6).
    static void commit(const Tick& tick, const BoneQuery& bone, const Advance& advance, State& state,
                       std::span<double> signals, Actions& actions) noexcept;
};
static_assert(ForceLaw<VolumetricDrilling>);

}  // namespace kerf::as_printed
