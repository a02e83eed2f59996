// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "drill_parameters.h"
#include "kerf/force.hpp"

/// A tip that takes no bone by turning: pushed harder than the bone before it bears, it crushes its way, as an awl does.
namespace kerf::drilling {

/// Bone before the tip is crushed at one pressure along the normal of its cones, and rubs along their slope:
///
///     dF = S(ρ) (n̂ + μ t̂) dA,    F_z = ∫ S(ρ) (1 + μ cot p) dA_z
///
/// p the cone's half angle, A_z the cross-section. At any rate, as strength hardly depends on it: (1/s)^0.06.
///
/// Source: S from [carter-hayes-1977]; docs/models/drilling.md.
class CrushingTip {
public:
    CrushingTip() = default;
    CrushingTip(const TwistDrill& drill, const Tick& tick, const BoneQuery& bone) noexcept;

    /// [N] along the shaft that crush what the tip stands on; 0 where that is nothing.   [haptic, nonblocking]
    [[nodiscard]] double force(const BoneQuery& bone) const noexcept;
    /// A cut along the mean normal of what is crushed, and one each way across the shaft.   [haptic, nonblocking]
    void add_to(Channels& channels, const BoneQuery& bone) const noexcept;

private:
    static constexpr std::size_t most_rings = 24, most = azimuth_count * most_rings;
    /// A place on a cone, which stands for an eighth of a ring.
    struct Place {
        Vec3 out;       ///< unit, away from the shaft
        double height;  ///< [m] of its ring
        double ahead;   ///< [m²] area across the shaft
        double aside;   ///< [m²] area that it shows outwards
        Vec6 along;     ///< n̂ + μ t̂, and its moment about the tip, for one along the shaft [–], [m]
        double rubs;    ///< [–] 1 + μ cot p
    };
    /// Along the shaft: what crushes each place [N] and all of them, and the least way to bone [m].
    struct Ahead {
        std::array<double, most> force;
        double sum = 0.0, gap = 0.0;
    };
    [[nodiscard]] Ahead ahead_of(std::span<const kerf_bone_sample> samples, std::uint32_t tissues) const noexcept;

    std::array<Vec3, 2 * most> at_, direction_;  ///< each place twice: asked ahead, then asked aside
    std::array<Place, most> place_;
    std::size_t count_ = 0;
    double play_ = 0.0;  ///< [m] so far from bone a place presses no more on it sideways
};

/// How the tip stood on bone in a tick.
struct Standing {
    double force = 0.0;  ///< [N] along the shaft
    double depth = 0.0;  ///< [m] at the deepest place that carried

    explicit Standing(const Advance& advance) noexcept;
};
/// Whether bone gave way under it: pushed by more than crushes it, or as deep as nothing gives by its spring alone.   [haptic, nonblocking]
[[nodiscard]] bool begins_to_crush(const Standing& standing, const CrushingTip& tip, const BoneQuery& bone) noexcept;
/// Whether a tip that crushed has not been let go: until then it stands in what it crushed.   [haptic, nonblocking]
[[nodiscard]] bool still_crushes(const Advance& advance) noexcept;

}  // namespace kerf::drilling
