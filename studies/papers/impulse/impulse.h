// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "kerf/math.hpp"

/// Impulses of a rigid tool that strikes rigid bone at many points at once. All SI, in one frame.
namespace kerf::papers {

/// A symmetric 3 × 3 matrix.
struct Symmetric3 {
    double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;

    [[nodiscard]] constexpr Vec3 operator*(Vec3 v) const noexcept {
        return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z};
    }
};
/// Returns the inverse. Pre: positive definite.   [any] pure.
[[nodiscard]] Symmetric3 inverse_of(const Symmetric3& m) noexcept;

/// The striking body.
struct RigidTool {
    double mass;                 ///< M [kg] > 0
    Symmetric3 inverse_inertia;  ///< J⁻¹ [1/(kg·m²)] about its centre of mass
};
/// Its motion.
struct RigidMotion {
    Vec3 velocity;  ///< [m/s] of its centre of mass
    Vec3 turn;      ///< ω [rad/s]

    [[nodiscard]] Vec3 at(Vec3 r) const noexcept { return velocity + cross(turn, r); }  ///< [m/s]
};

/// Returns the change of velocity at a point per impulse there [1/kg].
///
///     K = I/M − [r]ₓ J⁻¹ [r]ₓ
///
/// with r from the centre of mass to the point [m]. Symmetric and positive definite; no eigenvalue is below 1/M, since
/// [r]ₓ is skew and −[r]ₓ J⁻¹ [r]ₓ = [r]ₓᵀ J⁻¹ [r]ₓ.   [any] pure.
///
/// Source: [mandibular-angle], below equation (1), whose sign of the second term is wrong (E04-1); this one after
/// [guendelman-2003].
[[nodiscard]] Symmetric3 collision_matrix(const RigidTool& tool, Vec3 r) noexcept;

/// How two bodies strike.
struct Restitution {
    double restitution;  ///< e [–] 0 … 1
    double friction;     ///< μ [–]
};

/// A point at which the tool strikes bone.
struct Strike {
    Vec3 r;                 ///< [m] from the centre of mass
    Vec3 normal;            ///< N, unit, out of the bone
    double softness = 0.0;  ///< [1/kg] ≥ 0: compliance of the bone, as of a tooth that is partly in it
    Vec3 impulse{};         ///< [N·s] on the tool: the result

    // Worked out by the solver.
    Symmetric3 k, softened, inverse;  ///< K of `collision_matrix`; K with the softness; the inverse of that
    double rebound = 0.0;             ///< [m/s] along the normal, after the strike: −e u_n
};

/// Result of all strikes together.
struct Struck {
    RigidMotion motion;     ///< of the tool after them
    double energy = 0.0;    ///< [J] change of its kinetic energy, ≤ 0
    double fraction = 1.0;  ///< [–] of the solution that was applied: below 1 where all of it would make energy
};

inline constexpr int impulse_sweeps = 16;  ///< over all strikes, in turn from either end

/// Returns the motion after strikes at many points at the same time; writes their impulses.
///
///     sticking   p = K⁻¹ (−e u_n N − u)
///     sliding    p = j (N − μ T),    j = −(1 + e) u_n / (Nᵀ K (N − μ T))
///
/// with u the velocity of the tool at the point, u_n = u·N, T the unit tangential velocity. A strike sticks if its
/// impulse then lies in the friction cone. Points that leave the bone (u_n ≥ 0) are not reversed, and no impulse pulls.
///
/// Sequential impulses: each strike is solved with the effect of all others, in a fixed number of sweeps and a fixed
/// order, so that N strikes do not act N times. At the end all impulses are multiplied by one fraction if they would
/// create kinetic energy, as Newton's restitution with friction may.   [haptic, nonblocking] no allocation.
///
/// Source: [mandibular-angle] equations (1) and (2) with E04-1 … E04-5 corrected; the sweeps after [guendelman-2003];
/// the fraction is ours.
Struck solve_strikes(const RigidTool& tool, const RigidMotion& before, const Restitution& law,
                     std::span<Strike> strikes) noexcept;

}  // namespace kerf::papers
