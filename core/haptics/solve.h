// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/haptics/channel.h"
#include "core/haptics/inertia.h"

/// The tick's solve: the one motion at which hand and bone balance.
namespace kerf {

using Mat6 = std::array<std::array<double, 6>, 6>;

/// A spring and damper to the hand that gives way at a limit; one for forces, one for torques.
/// Its force on the tool at rate u is f = y min(1, limit/|y|) with y = pull − drag u.
struct CouplingBlock {
    Vec3 pull{};         ///< K e + B û_hand, at u = 0 [N] or [N·m]
    double drag = 0.0;   ///< B + T K [N·s/m] or [N·m·s/rad], > 0
    double limit = 0.0;  ///< device limit / force scale [N] or [N·m], > 0
};

/// What one balance can hold: a plugin's law, the wall of the region, a body that cannot be cut, and what a held body
/// touches.
inline constexpr std::size_t most_held_channels = 8;
inline constexpr std::size_t most_channels = KERF_MAX_CHANNELS + 2 + most_held_channels;

/// Everything one tick has to balance, tool frame, about the tip. Bone newtons.
struct Balance {
    CouplingBlock force;  ///< acts at the grip
    CouplingBlock torque;
    Vec3 grip{};           ///< from the tip [m]
    Inertia inertia{};     ///< of the tool
    Vec6 previous_rate{};  ///< of the tool in the step before, tool frame: with it goes what the inertia keeps
    double dt = 1e-3;      ///< [s]
    std::span<const kerf_channel> channels;
    Vec6 following{};  ///< Σ follow λ̄ and the law's own wrench: what is no resistance to the rate
    /// One-sided damper between tool and hand (resolutions R5): λ = damping max(0, along·v_tip − from).
    Vec3 release_along{};
    double release_damping = 0.0;       ///< [N·s/m]
    double release_from = 0.0;          ///< [m/s]
    Vec3 hand_velocity{}, hand_turn{};  ///< of the hand at the grip [m/s, rad/s]; not part of the balance
};

struct Motion {
    Vec6 rate{};                                 ///< of the tool, tool frame [m/s, rad/s]
    std::array<double, most_channels> lambda{};  ///< [N]
    double release = 0.0;                        ///< [N] of the release damper
    Vec3 force{}, torque{};                      ///< of the coupling on the tool; the force acts at the grip
    int iterations = 0;
    double residual = 0.0;  ///< [–] relative
    bool has_converged = false;
};

inline constexpr int iteration_cap =
    40;  ///< the 32 of resolutions R1 are enough without mass; with it one random law of 100 000 needs them all

/// Solves  Jᵀf(u) − (M/T)(u − u_prev) − Σ d λ(dᵀu) + following = 0.
///
/// The left side is minus the gradient of a strictly convex function of u (every λ rises, the coupling is a Huber
/// spring), so there is one answer. Newton with an exact line search finds it: a loose one does not.
/// Pre: every channel is_sound, and there are at most `most_channels`.   [haptic, nonblocking]
///
/// Source: docs/design/tick.md, "The solve".
[[nodiscard]] Motion solve(const Balance& balance) noexcept;
/// The same from another start; the answer must not depend on it.   [any]
[[nodiscard]] Motion solve_from(const Balance& balance, const Vec6& start) noexcept;

/// What every part carries at a given rate, balanced or not.   [haptic, nonblocking]
[[nodiscard]] Motion at_rate(const Balance& balance, const Vec6& rate) noexcept;

}  // namespace kerf
