// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>

#include "drill_parameters.h"
#include "kerf/force.hpp"

/// The cutting edges in the bone: where they are, what they meet, what they give at one feed rate.
namespace kerf::drilling {

inline constexpr double left_behind = 0.1e-3;  ///< [m] edges farther from the front than the nearest by this wait (R2)
inline constexpr std::size_t most_chisel_points = 32;  ///< per half of the chisel edge
inline constexpr std::size_t most_edge_points = lip_count * largest_element_count + 2 * most_chisel_points;

/// Share of the reference tissue's resistance at a sample, zero in air.
[[nodiscard]] double resistance(const kerf_bone_sample& sample, std::uint32_t tissues, double reference_density) noexcept;

/// Everything that cuts, sampled once.
struct Edges {
    TwistDrill drill;
    Lip lip;
    std::array<Vec3, most_edge_points> point;
    std::array<kerf_bone_sample, most_edge_points> sample;
    std::array<double, most_edge_points> resistance;  ///< [–] of each, as shares of the reference tissue's
    std::size_t lip_points = 0, chisel_points = 0, count = 0;
    double lag = 0.0;  ///< [m] of the second lip

    [[nodiscard]] double chisel_width() const noexcept { return drill.chisel_radius() / static_cast<double>(chisel_points); }

    std::array<double, largest_element_count> rake_factor;  ///< [–] on the lips' forces, 1 for the drill they were fitted with

    /// Places all pieces, the first lip at `angle` [rad], and asks the bone about them.
    void ask(const TwistDrill& of, const Tick& tick, const BoneQuery& bone, double angle) noexcept;
    /// Of a piece of a lip, its place along it.
    [[nodiscard]] std::size_t place_on_lip(std::size_t i) const noexcept { return i < lip.count ? i : i - lip.count; }
    [[nodiscard]] const LipElement& element(std::size_t i) const noexcept { return lip.element[place_on_lip(i)]; }

    [[nodiscard]] std::size_t lip_of(std::size_t i) const noexcept { return i < lip_points && i >= lip.count ? 1 : 0; }
    /// How far a piece is behind the front, less what its lip always is.
    [[nodiscard]] double gap(std::size_t i) const noexcept {
        return lip_of(i) == 0 ? sample[i].gap : std::max(0.0, sample[i].gap - lag);
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
            if (sample[i].engagement > 0.0) least = std::min(least, gap(i));
        return least < 1e299 ? least : 0.0;
    }
};

/// How two lips share the feed when the tip runs out: the first takes what the second is too far behind to reach.
///
///     t_2 = max(0, f/2 − G),   t_1 = f − t_2,    G the lag of the second lip, f the feed per revolution
///
/// Taken at the last tick's feed, as shares of f/2, so that the law stays linear in the rate.
struct LipShare {
    double chip[lip_count] = {1.0, 1.0};  ///< [–] of the even chip thickness
    double edge[lip_count] = {1.0, 1.0};  ///< [–] whether the edge is in the cut, softened over a tenth of the feed
};
[[nodiscard]] LipShare share_of_lips(double lag, double feed_per_revolution) noexcept;

/// What the edges give at one feed rate: forces that do not work against the feed, per newton of thrust.
struct Side {
    double thrust = 0.0, torque = 0.0;
    Vec3 lateral{}, moment{};
};

[[nodiscard]] Side side_forces(const Edges& edges, const Tick& tick, double revolutions, double feed_rate, double least_gap) noexcept;

}  // namespace kerf::drilling
