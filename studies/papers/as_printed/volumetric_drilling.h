// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

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
    double k_n, k_f, softer, rake, element_interval, voxel_width, shank;

    struct Signals {
        double thrust = 0.0;
    };
    static constexpr auto about() {
        using namespace literals;
        return describe(
            "volumetric_drilling", "[volumetric-drilling] equations 1 and 2, as printed.",
            param(&VolumetricDrilling::k_n, {.id = "k_n",
                                             .help = "K_n of the densest tissue.",
                                             .unit = unit::N_per_mm2,
                                             .min = 0.0,
                                             .max = in(unit::N_per_mm2, 1e11),
                                             .def = 7621.0_N_per_mm2,
                                             .source = "no coefficient is reported: 1213 and 1033 N/mm2 of chip area "
                                                       "from [macavelia-2012], times 2 pi for t as printed"}),
            param(&VolumetricDrilling::k_f, {.id = "k_f",
                                             .help = "K_f of the densest tissue.",
                                             .unit = unit::N_per_mm2,
                                             .min = 0.0,
                                             .max = in(unit::N_per_mm2, 1e11),
                                             .def = 6491.0_N_per_mm2,
                                             .source = "no coefficient is reported: 1213 and 1033 N/mm2 of chip area "
                                                       "from [macavelia-2012], times 2 pi for t as printed"}),
            as_printed::softer(&VolumetricDrilling::softer),
            param(&VolumetricDrilling::rake, {.id = "rake",
                                              .help = "Rake angle.",
                                              .unit = unit::deg,
                                              .min = -30.0_deg,
                                              .max = 45.0_deg,
                                              .def = 0.0,
                                              .source = not_stated}),
            as_printed::element_interval(&VolumetricDrilling::element_interval),
            as_printed::voxel_width(&VolumetricDrilling::voxel_width), as_printed::shank(&VolumetricDrilling::shank),
            signal(&Signals::thrust, {.id = "thrust", .help = "Not kept.", .unit = unit::N}), budget_us(1000));
    }

    using State = LastInterval;

    void resist(const Held<PaperBit>& tool, const BoneQuery& bone, const State& state,
                Channels& channels) const noexcept;
    /// Asks where shell, inside and the shell's ways of this interval lie, one voxel apart: a host that wears bone
    /// where it is asked about takes what the paper takes. An isotropic way crosses 1 + 1.5 L voxels, and points one
    /// voxel apart are in at most 1 + L of them (E01-6).
    void commit(const Held<PaperBit>& tool, const BoneQuery& bone, const Advance& advance, State& state,
                Signals& signals, Actions& actions) const noexcept;
};

}  // namespace kerf::as_printed
