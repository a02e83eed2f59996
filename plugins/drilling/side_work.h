// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drill_parameters.h"

/// What cutting sideways takes from the spindle, and how it pulls across the motion.
namespace kerf::drilling {

/// Of a ring of edges, a turn's mean.
struct SideWork {
    double across = 0.0;  ///< [N] on the tool, against ẑ × the way it goes
    double torque = 0.0;  ///< [N·m] against the spindle

    SideWork& operator+=(const SideWork& other) noexcept {
        across += other.across;
        torque += other.torque;
        return *this;
    }
};

/// What edges meet: the bone's resistance, times the share of an even chip and of its edge force that they take [–].
struct Met {
    double chip = 0.0, edge = 0.0;
};

/// A ring of edges that goes sideways.
struct SideRing {
    double radius = 0.0;     ///< [m]
    double width = 0.0;      ///< [m] of one lip's edge
    double thickness = 0.0;  ///< [m] of the chip where the ring faces its way, n_r s/(lips n)
    double fed = 0.0;        ///< [–] of that, the chip of the feed, κ = n_z v_z/(n_r s); 0 for a land
    Met ahead{}, beside{};   ///< at the azimuth of its way, and the mean of 45° to either side
};

/// Returns what the ring does beyond what the lips' shares of the feed say: they take up to 2 κ at an azimuth.
///
///     G = (z/2π) ∫ cos θ b m (K_ce Δβ + K_cc Δt) dθ,    M the same with r for cos θ,    over cos θ > κ
///     Δt = t (cos θ − κ),    Δβ = β(t (κ + cos θ)) − β(2 κ t)
///
/// A land takes all of it, κ = 0: then the chip part of 2π n M is K_cc times the volume.   [any] pure, nonblocking.
[[nodiscard]] SideWork side_work(const SideRing& ring, const EdgeCoefficients& cutting) noexcept;

}  // namespace kerf::drilling
