// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "kerf/force.hpp"

/// How thick the bone is before a tip that has free space behind it, and what that bears.
namespace kerf::drilling {

/// A straight way through bone, from a place on a cone.
struct WayOut {
    Vec3 from, along;  ///< tool frame [m]; unit
    double least;      ///< [–] sin p, p the cone's half angle
};

/// The shell at the far side of a way: what is there more than half as strong as the strongest on it.
struct Shell {
    static constexpr double never = 1e300;
    double load = 0.0;    ///< [N] along the shaft under which it breaks out; 0 where there is no bone, `never` where
                          ///< there is no far side near by
    double before = 0.0;  ///< [m] of the way before it
    double air = 0.0;     ///< [m] of the way before any bone
    Vec3 normal{};        ///< unit, outwards, of its far side
    Vec3 far{};           ///< [m] where the way comes out of that, tool frame
};

/// The shells on a few ways, and what each bears: a plate on which one place presses and which goes on all round, and
/// which cracks outwards from there and in a ring.
///
///     P = 4π m (c + μ √(1 − c²)),    m = σ t²/6,    σ = 133/193 S(ρ)
///
/// m [N] the moment per width that cracks it, t [m] its thickness, σ [Pa] in the mean over that; c the larger of n̂·ẑ
/// and sin p, n̂ the normal of its far side.
///
/// Source: 4π m by yield lines [johansen-1962]; σ [reilly-burstein-1975]; docs/models/drilling.md.
class Shells {
public:
    static constexpr std::size_t most = 32;

    /// @param ways      #N ≤ most
    /// @param step      [m] from place to place on them: 32 at most
    /// @param friction  [–] of the tip on bone   [haptic, nonblocking]
    Shells(std::span<const WayOut> ways, double step, double friction, const BoneQuery& bone) noexcept;

    [[nodiscard]] const Shell& on(std::size_t way) const noexcept { return shell_[way]; }

private:
    static constexpr std::size_t most_steps = 32;
    /// What lies on a way, step by step.
    struct Section {
        std::array<double, most_steps> strength;  ///< [Pa] times how much of it is bone; 0 in air
        std::array<double, most_steps> bone;      ///< [–] how much of it
        double strongest = 0.0;                   ///< [Pa]
        std::size_t begins = 0;                   ///< step at which bone begins
        std::size_t ends = 0;                     ///< step at which bone ends; 0: none yet

        void add(std::size_t step, double sigma, double engagement) noexcept;
        /// The last run of steps that are strong: from the first, up to the second of them.
        [[nodiscard]] std::pair<std::size_t, std::size_t> shell() const noexcept;
        [[nodiscard]] double mean() const noexcept;  ///< [Pa] over the shell's bone
    };
    /// Ways that came to a far side, and where their shells lie on them.
    struct Ended {
        std::array<std::size_t, most> way;
        std::array<double, most> near, far;  ///< [m]
        std::size_t count = 0;
    };
    using Sections = std::array<Section, most>;

    void follow(std::span<const WayOut> ways, double step, const BoneQuery& bone, Sections& sections,
                Ended& ended) noexcept;
    static void find_sides(std::span<const WayOut> ways, double step, const BoneQuery& bone, const Sections& sections,
                           Ended& ended) noexcept;
    void tell(std::span<const WayOut> ways, double step, double friction, const BoneQuery& bone,
              const Sections& sections, const Ended& ended) noexcept;

    std::array<Shell, most> shell_;
};

}  // namespace kerf::drilling
