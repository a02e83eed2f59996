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

/// The cutting edges in bone: their positions, the bone that they meet, and their forces at a feed rate.
namespace kerf::drilling {

inline constexpr std::size_t max_chisel_points = 32;  ///< per half of the chisel edge
inline constexpr std::size_t max_edge_points = lip_count * largest_element_count + 2 * max_chisel_points;

/// Returns the distance [m] of the drill's land and shank from the wall of a hole of `radius` [m]: their play, or the
/// position error of the wall where that is larger.
[[nodiscard]] inline double inside_of_hole(const DrillParameters& law, const BoneQuery& bone, double radius) noexcept {
    return std::max(law.clearance, bone.wall_error(radius));
}

/// The edges on the drill and the points at which they sample bone. They depend on parameters and grid only.
struct EdgeLayout {
    Lip lip;
    /// The end of a lip runs along the wall of its own hole. Its sample point is moved back along the lip, by the
    /// position error of this wall.
    struct SamplePoint {
        double kept;  ///< [–] fraction of its distance from the axis
        double z;     ///< [m]
    };
    std::array<SamplePoint, largest_element_count> sample_point;  ///< for each piece
    std::array<double, largest_element_count>
        rake_factor;            ///< [–] factor on the lips' forces, 1 for the drill of the fit
    std::size_t chisel_points;  ///< on each half of the chisel edge
    double chisel_width;        ///< [m] that each of them represents

    EdgeLayout() = default;
    EdgeLayout(const TwistDrill& drill, const DrillParameters& law, const BoneQuery& bone) noexcept;
};

/// All cutting edges, with one bone sample each.
struct Edges {
    const TwistDrill& drill;  ///< Pre: this and the next member outlive the edges
    const EdgeLayout& layout;
    std::array<Vec3, max_edge_points> point;
    std::array<Vec3, max_edge_points> out;  ///< for each point, the unit vector from the axis to it; zero on the axis
    std::array<kerf_bone_sample, max_edge_points> sample;
    std::array<double, max_edge_points> resistance;  ///< [–] for each point, relative to the reference tissue
    std::size_t lip_points = 0, count = 0;
    std::array<ChipFraction, max_edge_points> takes;  ///< for each point; undefined without resistance

    /// Turns all pieces, the first lip to `angle` [rad], and samples bone at their points.
    Edges(const TwistDrill& of, const EdgeLayout& at, const DrillParameters& law, const BoneQuery& bone,
          double angle) noexcept;
    /// Computes the chip and edge fraction of each piece of a drill that turns n times a second. The chip thickness
    /// follows from the piece's motion along its own normal:
    ///
    ///     c_0 = c_k + (n_r v_r + n_z (v_z − v̄_z))/(n_z v̄_z),   0 … 2
    ///
    /// with c_k the fraction of its lip (1 without runout), v the piece's average rate over half a turn, and v̄_z the
    /// tool's rate along its axis. So a compliant drill with runout centres itself. A tool without forward motion has
    /// even chips.
    void divide_feed(const Travel& travel, double n, double min_gap, double edge_depth) noexcept;
    /// Returns the index of a lip point along its lip.
    [[nodiscard]] std::size_t index_on_lip(std::size_t i) const noexcept {
        return i < layout.lip.count ? i : i - layout.lip.count;
    }
    [[nodiscard]] const LipElement& element(std::size_t i) const noexcept {
        return layout.lip.element[index_on_lip(i)];
    }

    /// Returns the fraction of the edges in bone [–].
    [[nodiscard]] double engagement() const noexcept {
        double sum = 0.0;
        for (std::size_t i = 0; i < count; ++i) sum += sample[i].engagement;
        return sum / static_cast<double>(count);
    }

    /// Returns the smallest gap to the front of the edges in bone [m], or 0 without any.
    [[nodiscard]] double min_gap() const noexcept {
        double least = 1e300;
        for (std::size_t i = 0; i < count; ++i)
            if (sample[i].engagement > 0.0) least = std::min(least, sample[i].gap);
        return least < 1e299 ? least : 0.0;
    }
};

/// Forces of the edges at one feed rate, tool frame, about the tip [N, N·m].
struct EdgeForces {
    Vec6 normal{};   ///< on the bone, along the normals of the cut surfaces; the tool's motion works against it
    Vec6 cutting{};  ///< on the tool, along the cut surfaces; the drive works against it

    [[nodiscard]] double thrust() const noexcept { return normal[2]; }
    [[nodiscard]] double torque() const noexcept { return -cutting[5]; }
};

/// Returns the forces at `feed_rate` [m/s] and `revolutions` [1/s].
/// Pre: `divide_feed` was called.
[[nodiscard]] EdgeForces edge_forces(const Edges& edges, const DrillParameters& law, double revolutions,
                                     double feed_rate) noexcept;

}  // namespace kerf::drilling
