// SPDX-License-Identifier: Apache-2.0
#include "breaking_wall.h"

#include <algorithm>
#include <cmath>

#include "kerf/assert.hpp"

namespace kerf::drilling {

namespace {

constexpr double of_one_wall = 0.7;                     // cosine between the normals of one wall [judgement]
constexpr double all_broken = 1.25, none_broken = 1.5;  // times the load that broke [judgement]
constexpr double min_reported_load = 10.0;  // [N] a weaker break is a sliver between two holes, or a rim [judgement]
constexpr double far_away = 4.0;            // times `within`, which is two radii [judgement]

/// Returns whether two far sides have similar normals and are at most `within` [m] apart along them.
bool is_one_wall(const Shell& a, const Shell& b, double within) noexcept {
    return dot(a.normal, b.normal) >= of_one_wall && std::abs(dot(a.normal + b.normal, b.far - a.far)) <= 2.0 * within;
}

/// Returns whether a far side is part of a wall. Near a hole the wall may be bent inwards.
bool is_part_of(const Shell& shell, const Shell& wall, double within) noexcept {
    return dot(shell.normal, wall.normal) >= 0.0 && std::abs(dot(wall.normal, shell.far - wall.far)) <= within;
}

}  // namespace

// ---- Broken wall ----------------------------------------------------------------------------------------------------

double BrokenWall::fraction_intact(const Shell& shell) const noexcept {
    if (!is_there() || !is_part_of(shell, shell_, within_)) return 1.0;
    return std::clamp((shell.load / shell_.load - all_broken) / (none_broken - all_broken), 0.0, 1.0);
}

bool BrokenWall::break_out(const Shell& shell) noexcept {
    const bool is_same = is_there() && is_part_of(shell, shell_, within_);
    const bool was_reported = is_same && shell_.load >= min_reported_load;
    if (!is_same || shell.load > shell_.load) shell_ = shell;
    away_ = {};
    return !was_reported && shell_.load >= min_reported_load;
}

void BrokenWall::move_with_tip(const Vec6& rate, double dt, bool is_pressed_on) noexcept {
    if (!is_there()) return;
    const Vec3 moved = dt * Vec3{rate[0], rate[1], rate[2]}, turned = dt * Vec3{rate[3], rate[4], rate[5]};
    shell_.far = shell_.far - moved - cross(turned, shell_.far);
    shell_.normal = shell_.normal - cross(turned, shell_.normal);
    away_ = is_pressed_on ? Vec3{} : away_ + moved - cross(turned, away_);
    if (length(away_) > far_away * within_) *this = BrokenWall(within_);
}

// ---- Pressed wall ---------------------------------------------------------------------------------------------------

/// Returns the weaker shell of the two rays of a piece: along the shaft and along its normal. A piece with no bone
/// along the shaft is at the far side already, because bone behind free space is another wall.
PressedWall::Pressed PressedWall::pressed_by(std::size_t piece, const WallAhead& wall) noexcept {
    const auto has_bone = [&](std::size_t ray) { return wall.on(ray).load > 0.0 && wall.is_at_once(wall.on(ray).air); };
    const std::size_t ahead = WallAhead::ahead_of(piece), along_normal = WallAhead::along_normal(piece);
    if (!has_bone(ahead)) return {true, no_ray};
    const std::size_t ray =
        has_bone(along_normal) && wall.on(along_normal).load < wall.on(ahead).load ? along_normal : ahead;
    return {wall.on(ray).load < Shell::never && wall.is_at_once(wall.on(ray).before), ray};
}

/// Returns the weaker of the two rays of the piece behind that lead to the same wall, or else the given ray. For
/// `no_ray` the wall is unknown, so any wall counts.
std::size_t PressedWall::whole_of(std::size_t ray, std::size_t piece_behind, const WallAhead& wall,
                                  double within) noexcept {
    std::size_t whole = ray;
    double smallest = Shell::never;
    for (const std::size_t there : {WallAhead::ahead_of(piece_behind), WallAhead::along_normal(piece_behind)}) {
        const Shell& shell = wall.on(there);
        if (shell.load <= 0.0 || shell.load >= smallest || (ray != no_ray && !is_one_wall(shell, wall.on(ray), within)))
            continue;
        whole = there;
        smallest = shell.load;
    }
    return whole;
}

PressedWall::PressedWall(std::span<const double> crushes, std::span<const std::uint8_t> parts, const WallAhead& wall,
                         const BrokenWall& broken) noexcept {
    KERF_ASSERT(crushes.size() <= WallAhead::max_pieces && crushes.size() == azimuth_count * parts.size(),
                "give whole rings of pieces, few enough");

    resisting_fraction_.fill(1.0);
    const double within = broken.within();
    const auto are_one = [&](std::size_t a, std::size_t b) {
        return a != no_ray && b != no_ray && is_one_wall(wall.on(a), wall.on(b), within);
    };
    std::array<Group, WallAhead::max_pieces> groups;
    std::array<std::size_t, WallAhead::max_pieces> group_of;
    constexpr std::size_t none = WallAhead::max_pieces;
    std::size_t count = 0;
    group_of.fill(none);
    for (std::size_t side = 0; side < azimuth_count; ++side) {
        std::size_t group = none;
        for (std::size_t ring = 0; ring < parts.size(); ++ring) {
            const std::size_t n = ring * azimuth_count + side;
            const Pressed pressed = crushes[n] > 0.0 ? pressed_by(n, wall) : Pressed{};
            if (!pressed.is_in_shell) {
                group = none;
                continue;
            }
            const bool has_behind = ring + 1 < parts.size() && parts[ring + 1] == parts[ring];
            const std::size_t whole = has_behind ? whole_of(pressed.ray, n + azimuth_count, wall, within) : pressed.ray;
            const bool continues =
                group != none && parts[ring - 1] == parts[ring] &&
                (whole == no_ray || groups[group].ray == no_ray || are_one(whole, groups[group].ray));
            if (!continues) groups[group = count++] = {};
            if (whole != no_ray) groups[group].ray = whole;
            groups[group].crushes += crushes[n];
            group_of[n] = group;
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        Group& group = groups[i];
        if (group.ray != no_ray) group.left = broken.fraction_intact(wall.on(group.ray));
        group.crushes *= group.left;
        is_broken_ = is_broken_ || group.left < 1.0;
    }

    std::array<double, WallAhead::max_pieces> resists;  // [–] resisting fraction of each group
    for (std::size_t i = 0; i < count; ++i) {
        double breaking_load = 0.0, together = 0.0, group_count = 0.0;
        for (std::size_t other = 0; other < count; ++other) {
            if (groups[other].crushes <= 0.0 || (other != i && !are_one(groups[other].ray, groups[i].ray))) continue;
            breaking_load += groups[other].ray != no_ray ? wall.on(groups[other].ray).load : 0.0;
            together += groups[other].crushes;
            group_count += 1.0;
        }
        const bool breaks = groups[i].crushes > 0.0 && together * group_count > breaking_load;
        if (breaks && groups[i].ray != no_ray &&
            (breaks_on_ == no_ray || wall.on(groups[i].ray).load > wall.on(breaks_on_).load))
            breaks_on_ = groups[i].ray;
        resists[i] = groups[i].left * (breaks ? breaking_load / (group_count * together) : 1.0);
    }
    for (std::size_t n = 0; n < crushes.size(); ++n)
        if (group_of[n] != none) resisting_fraction_[n] = resists[group_of[n]];
}

}  // namespace kerf::drilling
