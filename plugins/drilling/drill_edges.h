// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "bone_strength.h"
#include "chip_share.h"
#include "drill_parameters.h"
#include "kerf/force.hpp"
#include "twist_drill.h"

/// The cutting edges in the bone: where they are, what they meet, what they give at one feed rate.
namespace kerf::drilling {

inline constexpr std::size_t most_chisel_points = 32;  ///< per half of the chisel edge
inline constexpr std::size_t most_edge_points = lip_count * largest_element_count + 2 * most_chisel_points;

/// [m] how far inside its hole of `radius` the drill's land and shank lie: their play, or more where the hole's wall is
/// not known so well (B5).
[[nodiscard]] inline double inside_of_hole(const DrillParameters& law, const BoneQuery& bone, double radius) noexcept {
    return std::max(law.clearance, bone.wall_error(radius));
}

/// Where the edges are on the drill, and where they are asked about: what follows from parameters and grid alone.
struct EdgePlaces {
    Lip lip;
    /// The end of a lip runs along the wall of its own hole: it is asked about no nearer to it than the wall is known
    /// (B5), back along the lip.
    struct Asked {
        double kept;  ///< [–] of its way from the axis
        double z;     ///< [m]
    };
    std::array<Asked, largest_element_count> asked;  ///< of each piece
    std::array<double, largest_element_count>
        rake_factor;            ///< [–] on the lips' forces, 1 for the drill they were fitted with
    std::size_t chisel_points;  ///< on each half of the chisel edge
    double chisel_width;        ///< [m] that each of them stands for

    EdgePlaces() = default;
    EdgePlaces(const TwistDrill& drill, const DrillParameters& law, const BoneQuery& bone) noexcept;
};

/// Everything that cuts, sampled once.
struct Edges {
    const TwistDrill& drill;  ///< this and the next must outlive it
    const EdgePlaces& places;
    std::array<Vec3, most_edge_points> point;
    std::array<Vec3, most_edge_points> out;  ///< of each, the unit vector from the axis to it; nothing on the axis
    std::array<kerf_bone_sample, most_edge_points> sample;
    std::array<double, most_edge_points> resistance;  ///< [–] of each, as shares of the reference tissue's
    std::size_t lip_points = 0, count = 0;
    std::array<Taken, most_edge_points> takes;  ///< of each; where there is no resistance nothing is said

    /// Turns all pieces, the first lip to `angle` [rad], and asks the bone about them.
    Edges(const TwistDrill& of, const EdgePlaces& at, const DrillParameters& law, const BoneQuery& bone,
          double angle) noexcept;
    /// Says what each piece takes where the drill turns n times a second: a chip is as thick as the piece moves along
    /// its own normal,
    ///
    ///     c_0 = c_k + (n_r v_r + n_z (v_z − v̄_z))/(n_z v̄_z),   0 … 2
    ///
    /// with c_k its lip's share (1 but for a tip that runs off), v the piece's mean rate over half a turn and v̄_z the
    /// tool's along its axis. So a drill that is free to give way where its tip runs off centres itself. A tool that
    /// does not go forwards has even chips.
    void share_out(const Travel& travel, double n, double least_gap, double edge_depth) noexcept;
    /// Of a piece of a lip, its place along it.
    [[nodiscard]] std::size_t place_on_lip(std::size_t i) const noexcept {
        return i < places.lip.count ? i : i - places.lip.count;
    }
    [[nodiscard]] const LipElement& element(std::size_t i) const noexcept {
        return places.lip.element[place_on_lip(i)];
    }

    /// Share of the edges in bone.
    [[nodiscard]] double engagement() const noexcept {
        double sum = 0.0;
        for (std::size_t i = 0; i < count; ++i) sum += sample[i].engagement;
        return sum / static_cast<double>(count);
    }

    /// The least way to the front among edges in bone; 0 when none is.
    [[nodiscard]] double least_gap() const noexcept {
        double least = 1e300;
        for (std::size_t i = 0; i < count; ++i)
            if (sample[i].engagement > 0.0) least = std::min(least, sample[i].gap);
        return least < 1e299 ? least : 0.0;
    }
};

/// What the edges give at one feed rate, tool frame, about the tip [N, N·m].
struct EdgeForces {
    Vec6 normal{};   ///< on the bone, along the normals of the surfaces they cut: what the tool's motion works against
    Vec6 cutting{};  ///< on the tool, along those surfaces: the drive works against it

    [[nodiscard]] double thrust() const noexcept { return normal[2]; }
    [[nodiscard]] double torque() const noexcept { return -cutting[5]; }
};

/// Pre: shared out.
[[nodiscard]] EdgeForces edge_forces(const Edges& edges, const DrillParameters& law, double revolutions,
                                     double feed_rate) noexcept;

}  // namespace kerf::drilling
