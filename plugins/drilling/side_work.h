// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drill_parameters.h"

/// Spindle torque of sideways cutting, and its pull across the motion.
namespace kerf::drilling {

/// Mean force and torque over a turn of a ring of edges.
struct SideWork {
    double across = 0.0;  ///< [N] on the tool, against ẑ × the direction of motion
    double torque = 0.0;  ///< [N·m] against the spindle

    SideWork& operator+=(const SideWork& other) noexcept {
        across += other.across;
        torque += other.torque;
        return *this;
    }
};

/// Bone resistance times the fraction of an even chip, and of its edge force [–].
struct Resistance {
    double chip = 0.0, edge = 0.0;
};

/// A ring of edges that moves sideways.
struct SideRing {
    double radius = 0.0;             ///< [m]
    double width = 0.0;              ///< [m] of one lip's edge
    double thickness = 0.0;          ///< [m] chip thickness in the direction of motion, n_r s/(lips n)
    double fed = 0.0;                ///< [–] part of it that the feed removes, κ = n_z v_z/(n_r s); 0 for a land
    Resistance ahead{}, sideways{};  ///< in the direction of motion, and the average of 45° to either side
};

/// Returns the force and torque of the ring beyond those of the lips' feed, which removes up to 2 κ at an azimuth:
///
///     G = (z/2π) ∫ cos θ b m (K_ce Δβ + K_cc Δt) dθ,    M the same with r for cos θ,    over cos θ > κ
///     Δt = t (cos θ − κ),    Δβ = β(t (κ + cos θ)) − β(2 κ t)
///
/// A land has κ = 0. Then the chip part of 2π n M is K_cc times the removed volume per time.   [any] pure, nonblocking.
[[nodiscard]] SideWork side_work(const SideRing& ring, const EdgeCoefficients& cutting) noexcept;

}  // namespace kerf::drilling
