// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "kerf/force.hpp"

/// Thickness and strength of the bone between a tip and free space behind that bone.
namespace kerf::drilling {

/// A straight ray through bone that starts at a point on a cone.
struct Ray {
    Vec3 from, along;   ///< tool frame [m]; unit
    double min_cosine;  ///< [–] sin p, p the cone's half angle; lower limit of n̂·ẑ
};

/// The shell at the far side of a ray: the last bone that has more than half of the ray's greatest strength.
struct Shell {
    static constexpr double never = 1e300;
    double load = 0.0;    ///< [N] thrust along the shaft that breaks it out; 0 without bone, `never` without a far side
                          ///< in reach
    double before = 0.0;  ///< [m] along the ray to the shell
    double air = 0.0;     ///< [m] along the ray to the first bone
    Vec3 normal{};        ///< unit, outward normal of its far side
    Vec3 far{};           ///< [m] exit of the ray from the shell, tool frame
};

/// The shells on a few rays and the load that breaks each. The model is a wide plate under one point load. It cracks
/// along radial lines and along a ring.
///
///     P = 4π m (c + μ √(1 − c²)),    m = σ t²/6,    σ = 133/193 S(ρ)
///
/// with m [N] the cracking moment per width, t [m] the thickness, σ [Pa] the average strength over the thickness, c the
/// larger of n̂·ẑ and sin p, n̂ the normal of the far side.
///
/// Source: 4π m by yield lines [johansen-1962]; σ [reilly-burstein-1975]; docs/models/drilling.md.
class Shells {
public:
    static constexpr std::size_t max_rays = 32;

    /// Samples at most `max_rays` rays. `step` [m] is the distance between samples on a ray, which has 32 at most.
    /// `friction` [–] is that of the tip on bone.   [haptic, nonblocking]
    Shells(std::span<const Ray> rays, double step, double friction, const BoneQuery& bone) noexcept;

    [[nodiscard]] const Shell& on(std::size_t ray) const noexcept { return shell_[ray]; }

private:
    static constexpr std::size_t max_steps = 32;
    /// Samples of the bone on a ray, one for each step.
    struct Section {
        std::array<double, max_steps> strength;  ///< [Pa] bone strength times bone fraction; 0 in air
        std::array<double, max_steps> bone;      ///< [–] bone fraction
        double strongest = 0.0;                  ///< [Pa]
        std::size_t begins = 0;                  ///< step at which bone begins
        std::size_t ends = 0;                    ///< step at which bone ends; 0: none yet

        void add(std::size_t step, double sigma, double engagement) noexcept;
        /// Returns the last run of strong steps: its first step, and one past its last.
        [[nodiscard]] std::pair<std::size_t, std::size_t> shell() const noexcept;
        [[nodiscard]] double mean() const noexcept;  ///< [Pa] over the shell's bone
    };
    /// Rays that reached a far side, and where their shells lie on them.
    struct Ended {
        std::array<std::size_t, max_rays> ray;
        std::array<double, max_rays> near, far;  ///< [m]
        std::size_t count = 0;
    };
    using Sections = std::array<Section, max_rays>;

    void follow(std::span<const Ray> rays, double step, const BoneQuery& bone, Sections& sections,
                Ended& ended) noexcept;
    static void find_sides(std::span<const Ray> rays, double step, const BoneQuery& bone, const Sections& sections,
                           Ended& ended) noexcept;
    void find_loads(std::span<const Ray> rays, double step, double friction, const BoneQuery& bone,
                    const Sections& sections, const Ended& ended) noexcept;

    std::array<Shell, max_rays> shell_;
};

}  // namespace kerf::drilling
