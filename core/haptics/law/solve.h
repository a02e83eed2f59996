// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/haptics/law/channel.h"
#include "core/haptics/law/inertia.h"
#include "core/haptics/law/split.h"

/// The solve of a tick: finds the one motion at which hand and bone are in balance.
namespace kerf {

using Mat6 = std::array<std::array<double, 6>, 6>;

/// A spring and damper between hand and tool, for forces or for torques. At the tool's velocity v (of the centre), or
/// its angular velocity, the force or torque on the tool is pull − drag v. Its parts across and along the shaft are
/// clamped to their limits separately.
struct CouplingBlock {
    Vec3 pull{};    ///< K × stretch + B × the hand's velocity: the force at v = 0 [N] or [N·m]
    Split drag{};   ///< B + T K [N·s/m] or [N·m·s/rad], > 0
    Split limit{};  ///< [N] or [N·m], > 0
};

/// Capacity of a balance: the channels of a plugin's law, and one for the region, for a metal body, for each of a
/// sleeve's two ends, and for each octant of the held body.
inline constexpr std::size_t max_held_channels = 8;
inline constexpr std::size_t max_balance_channels = KERF_MAX_CHANNELS + 4 + max_held_channels;

/// All forces that balance in one step of a tick, in the tool frame about the tip. Bone newtons.
struct Balance {
    CouplingBlock force;  ///< acts at the centre
    CouplingBlock torque;
    Vec3 centre{};         ///< of the coupling's compliance, from the tip [m]
    Inertia inertia{};     ///< of the tool
    Vec6 previous_rate{};  ///< of the tool in the last step, tool frame: u_prev of the inertia's term
    double dt = 1e-3;      ///< [s]
    std::span<const kerf_channel> channels;
    Vec6 following{};  ///< Σ follow λ̄ and the law's own wrench: loads that do not resist the rate
    /// One-sided damper between tool and hand. Its force on the tool is −release_along release_damping
    /// max(0, release_along·v_tip − release_from), with the unit vector `release_along`.
    Vec3 release_along{};
    double release_damping = 0.0;       ///< [N·s/m]
    double release_from = 0.0;          ///< [m/s]
    Vec3 hand_velocity{}, hand_turn{};  ///< of the hand at the centre [m/s, rad/s]; the solve does not read them
};

/// A rate of the tool and all forces at that rate, tool frame.
struct Motion {
    Vec6 rate{};                                        ///< of the tool [m/s, rad/s]
    std::array<double, max_balance_channels> lambda{};  ///< of each channel [N]
    double release = 0.0;                               ///< [N] of the release damper, against its direction
    Vec3 force{}, torque{};                             ///< of the coupling on the tool; the force acts at the centre
    int iterations = 0;
    double residual = 0.0;  ///< [–] force out of balance, relative to the sum of the forces' sizes at rest
    bool has_converged = false;
};

inline constexpr int iteration_cap = 64;  ///< the hardest of 100 000 random laws needs 36

/// Returns the rate u of the tool, about its tip, that solves
///
///     Jᵀf(J u) − (M/T)(u − u_prev) − Σ d λ(dᵀu) + following − release = 0
///
/// J maps u to the velocities at the centre, f is the coupling. The left side is minus the gradient of a strictly
/// convex function of u: no λ falls with dᵀu, and the coupling is a Huber spring. So there is exactly one solution.
/// Newton's method with an exact line search finds it; with an inexact search it may fail. On failure `has_converged`
/// is false. Pre: every channel is_sound, and there are at most `max_balance_channels`.   [haptic, nonblocking]
///
/// Source: docs/design/tick.md, "The solve".
[[nodiscard]] Motion solve(const Balance& balance) noexcept;
/// Solves the same equation, starting at the rate `start`. The solution must not depend on the start.   [any]
[[nodiscard]] Motion solve_from(const Balance& balance, const Vec6& start) noexcept;

/// Returns the forces of coupling, release damper and channels at a given rate, balanced or not.
/// [haptic, nonblocking]
[[nodiscard]] Motion at_rate(const Balance& balance, const Vec6& rate) noexcept;

}  // namespace kerf
