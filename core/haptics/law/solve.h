// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/haptics/law/channel.h"
#include "core/haptics/law/inertia.h"
#include "core/haptics/law/split.h"

/// The tick's solve: the one motion at which hand and bone balance.
namespace kerf {

using Mat6 = std::array<std::array<double, 6>, 6>;

/// A spring and damper to the hand that gives way at its limits; one for forces, one for torques. Its force on the tool
/// at rate u is pull − drag u, its part across the shaft and its part along it cut to their limits.
struct CouplingBlock {
    Vec3 pull{};    ///< K e + B û_hand, at u = 0 [N] or [N·m]
    Split drag{};   ///< B + T K [N·s/m] or [N·m·s/rad], > 0
    Split limit{};  ///< [N] or [N·m], > 0
};

/// What one balance can hold: a plugin's law, the wall of the region, a body that cannot be cut, and what a held body
/// touches.
inline constexpr std::size_t most_held_channels = 8;
inline constexpr std::size_t most_channels = KERF_MAX_CHANNELS + 4 + most_held_channels;

/// Everything one tick has to balance, tool frame, about the tip. Bone newtons.
struct Balance {
    CouplingBlock force;  ///< acts at the centre
    CouplingBlock torque;
    Vec3 centre{};         ///< of the coupling's compliance, from the tip [m]
    Inertia inertia{};     ///< of the tool
    Vec6 previous_rate{};  ///< of the tool in the step before, tool frame: with it goes what the inertia keeps
    double dt = 1e-3;      ///< [s]
    std::span<const kerf_channel> channels;
    Vec6 following{};  ///< Σ follow λ̄ and the law's own wrench: what is no resistance to the rate
    /// One-sided damper between tool and hand (resolutions R5): λ = damping max(0, along·v_tip − from).
    Vec3 release_along{};
    double release_damping = 0.0;       ///< [N·s/m]
    double release_from = 0.0;          ///< [m/s]
    Vec3 hand_velocity{}, hand_turn{};  ///< of the hand at the centre [m/s, rad/s]; not part of the balance
};

struct Motion {
    Vec6 rate{};                                 ///< of the tool, tool frame [m/s, rad/s]
    std::array<double, most_channels> lambda{};  ///< [N]
    double release = 0.0;                        ///< [N] of the release damper
    Vec3 force{}, torque{};                      ///< of the coupling on the tool; the force acts at the centre
    int iterations = 0;
    double residual = 0.0;  ///< [–] relative
    bool has_converged = false;
};

inline constexpr int iteration_cap = 64;  ///< of 100 000 random laws the hardest needs 36

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
