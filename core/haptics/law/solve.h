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

/// A spring and damper between hand and tool, one for forces and one for torques. At the rate u its force on the tool
/// is pull − drag u. The parts across and along the shaft are each clamped to their limit.
struct CouplingBlock {
    Vec3 pull{};    ///< K e + B û_hand, at u = 0 [N] or [N·m]
    Split drag{};   ///< B + T K [N·s/m] or [N·m·s/rad], > 0
    Split limit{};  ///< [N] or [N·m], > 0
};

/// Capacity of a balance: a plugin's law, the region, a metal body, a sleeve's two ends and the held body's octants.
inline constexpr std::size_t max_held_channels = 8;
inline constexpr std::size_t max_balance_channels = KERF_MAX_CHANNELS + 4 + max_held_channels;

/// All forces that balance in one tick, in the tool frame about the tip. Bone newtons.
struct Balance {
    CouplingBlock force;  ///< acts at the centre
    CouplingBlock torque;
    Vec3 centre{};         ///< of the coupling's compliance, from the tip [m]
    Inertia inertia{};     ///< of the tool
    Vec6 previous_rate{};  ///< of the tool in the last step, tool frame: defines the momentum it had
    double dt = 1e-3;      ///< [s]
    std::span<const kerf_channel> channels;
    Vec6 following{};  ///< Σ follow λ̄ and the law's own wrench: loads that do not resist the rate
    /// One-sided damper between tool and hand: λ = damping max(0, along·v_tip − from).
    Vec3 release_along{};
    double release_damping = 0.0;       ///< [N·s/m]
    double release_from = 0.0;          ///< [m/s]
    Vec3 hand_velocity{}, hand_turn{};  ///< of the hand at the centre [m/s, rad/s]; not part of the balance
};

struct Motion {
    Vec6 rate{};                                        ///< of the tool, tool frame [m/s, rad/s]
    std::array<double, max_balance_channels> lambda{};  ///< [N]
    double release = 0.0;                               ///< [N] of the release damper
    Vec3 force{}, torque{};                             ///< of the coupling on the tool; the force acts at the centre
    int iterations = 0;
    double residual = 0.0;  ///< [–] relative
    bool has_converged = false;
};

inline constexpr int iteration_cap = 64;  ///< the hardest of 100 000 random laws needs 36

/// Solves  Jᵀf(u) − (M/T)(u − u_prev) − Σ d λ(dᵀu) + following = 0.
///
/// The left side is minus the gradient of a strictly convex function of u: every λ rises with dᵀu and the coupling is a
/// Huber spring. So there is exactly one solution. Newton's method with an exact line search finds it; with an inexact
/// one it may not.
/// Pre: every channel is_sound, and there are at most `max_balance_channels`.   [haptic, nonblocking]
///
/// Source: docs/design/tick.md, "The solve".
[[nodiscard]] Motion solve(const Balance& balance) noexcept;
/// Solves the same equation from another start. The solution must not depend on the start.   [any]
[[nodiscard]] Motion solve_from(const Balance& balance, const Vec6& start) noexcept;

/// Returns the forces of all parts at a given rate, balanced or not.   [haptic, nonblocking]
[[nodiscard]] Motion at_rate(const Balance& balance, const Vec6& rate) noexcept;

}  // namespace kerf
