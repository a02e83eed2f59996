// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "studies/chart/drill/scene.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// What opens a pedicle by hand: a cone on a straight shaft, pushed and not turned.
struct Awl {
    double diameter = 4e-3;       ///< [m] of the shaft [assumed]
    double point_angle = 0.5236;  ///< [rad] full: 30° [assumed]
    double friction = 0.3;        ///< [–] steel on wet bone [assumed]
};

/// What pushes it along a scene's way. Bone is crushed along the cone's normals and rubs on it,
///
///     F = ∫ S(ρ) (1 + μ cot p) dA_z,    S = 68 MPa (ρ / 1 g/cm³)²        [N]
///
/// but for a shell with free space behind it, which breaks out under
///
///     P = 4π m (c + μ √(1 − c²)),    m = σ t²/6,    σ = 133/193 S(ρ)     [N]
///
/// if that is less than what crushes it, and bears nothing from then on; c the larger of its far side's n̂·ẑ and sin p.
/// By the midpoint rule over the cone in the exact bone, the shells on rays ahead of each place and along its normal.
/// The shaft behind the cone is left out. Where a shell begins and what is one wall is judged as the plugin does: what
/// agrees with it is told of grids, rings and ticks, not of the law.
///
/// Source: S from [carter-hayes-1977], σ from [reilly-burstein-1975], 4π m by yield lines [johansen-1962]; the law of
/// the drilling plugin's still tip, docs/models/drilling.md.
class PushedAwl {
public:
    /// @param scene  outlives it
    PushedAwl(const Awl& awl, const Scene& scene) noexcept : awl_(awl), scene_(&scene) {}

    /// [N] with its tip at `depth` [m], no less deep than before.   [main]
    double push_at(double depth);
    [[nodiscard]] bool has_broken() const noexcept { return broken_.load > 0.0; }  ///< some shell

private:
    static constexpr int rings = 32, sides = 16;
    struct Shell {
        double load = 0.0;    ///< [N] under which it breaks out
        double before = 0.0;  ///< [m] from the cone to it
        Vec3 normal{};        ///< unit, outwards, of its far side
    };
    /// Places on one side of the cone that press in a shell: what crushes them, and what it bears.
    struct Side {
        double crushes = 0.0;  ///< [N]
        Shell shell{};
    };
    [[nodiscard]] Vec3 place(int ring, int side) const noexcept;  ///< tool frame [m]
    [[nodiscard]] double strength_at(Vec3 body) const;            ///< [Pa]; 0 in air
    /// The shell that is weakest, ahead of a place or along its normal; none where bone has no far side near by, or
    /// there is no bone.
    [[nodiscard]] std::optional<Shell> shell_before(int ring, int side, const Pose& body_from_awl) const;
    [[nodiscard]] std::optional<Shell> shell_on(Vec3 from, Vec3 along, const Pose& body_from_awl) const;
    [[nodiscard]] double what_shells_bear(const std::array<Side, sides>& all);

    Awl awl_;
    const Scene* scene_;
    Shell broken_;  // the last
};

}  // namespace kerf::chart
