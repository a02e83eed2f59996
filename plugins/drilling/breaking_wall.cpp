// SPDX-License-Identifier: Apache-2.0
#include "breaking_wall.h"

#include <algorithm>
#include <cmath>

#include "kerf/assert.hpp"

namespace kerf::drilling {

namespace {

constexpr double of_one_wall = 0.7;                     // cosine between the normals of one wall [judgement]
constexpr double all_broken = 1.25, none_broken = 1.5;  // times the load that broke [judgement]
constexpr double worth_telling = 10.0;  // [N] a weaker break is a sliver between two holes, or a rim [judgement]
constexpr double far_away = 4.0;        // times `within`, which is two radii [judgement]

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

double BrokenWall::is_left_of(const Shell& shell) const noexcept {
    if (!is_there() || !is_part_of(shell, shell_, within_)) return 1.0;
    return std::clamp((shell.load / shell_.load - all_broken) / (none_broken - all_broken), 0.0, 1.0);
}

bool BrokenWall::break_out(const Shell& shell) noexcept {
    const bool is_same = is_there() && is_part_of(shell, shell_, within_);
    const bool was_told = is_same && shell_.load >= worth_telling;
    if (!is_same || shell.load > shell_.load) shell_ = shell;
    away_ = {};
    return !was_told && shell_.load >= worth_telling;
}

void BrokenWall::go(const Vec6& rate, double dt, bool is_in_it) noexcept {
    if (!is_there()) return;
    const Vec3 moved = dt * Vec3{rate[0], rate[1], rate[2]}, turned = dt * Vec3{rate[3], rate[4], rate[5]};
    shell_.far = shell_.far - moved - cross(turned, shell_.far);
    shell_.normal = shell_.normal - cross(turned, shell_.normal);
    away_ = is_in_it ? Vec3{} : away_ + moved - cross(turned, away_);
    if (length(away_) > far_away * within_) *this = BrokenWall(within_);
}

// ---- Pressed wall ---------------------------------------------------------------------------------------------------

/// Returns the weaker shell of the two rays of a piece: along the shaft and along its normal. A piece with no bone
/// along the shaft is at the far side already, because bone behind free space is another wall.
PressedWall::Pressed PressedWall::pressed_by(std::size_t piece, const WallAhead& wall) noexcept {
    const auto has_bone = [&](std::size_t way) { return wall.on(way).load > 0.0 && wall.is_at_once(wall.on(way).air); };
    const std::size_t ahead = WallAhead::ahead_of(piece), beside = WallAhead::beside(piece);
    if (!has_bone(ahead)) return {true, no_way};
    const std::size_t way = has_bone(beside) && wall.on(beside).load < wall.on(ahead).load ? beside : ahead;
    return {wall.on(way).load < Shell::never && wall.is_at_once(wall.on(way).before), way};
}

/// Returns the weaker of the two rays of the piece behind that lead to the same wall, or else the given ray. For
/// `no_way` the wall is unknown, so any wall counts.
std::size_t PressedWall::whole_of(std::size_t way, std::size_t piece_behind, const WallAhead& wall,
                                  double within) noexcept {
    std::size_t whole = way;
    double least = Shell::never;
    for (const std::size_t there : {WallAhead::ahead_of(piece_behind), WallAhead::beside(piece_behind)}) {
        const Shell& shell = wall.on(there);
        if (shell.load <= 0.0 || shell.load >= least || (way != no_way && !is_one_wall(shell, wall.on(way), within)))
            continue;
        whole = there;
        least = shell.load;
    }
    return whole;
}

PressedWall::PressedWall(std::span<const double> crushes, std::span<const std::uint8_t> parts, const WallAhead& wall,
                         const BrokenWall& broken) noexcept {
    KERF_ASSERT(crushes.size() <= WallAhead::most_pieces && crushes.size() == azimuth_count * parts.size(),
                "give whole rings of pieces, few enough");

    share_.fill(1.0);
    const double within = broken.within();
    const auto are_one = [&](std::size_t a, std::size_t b) {
        return a != no_way && b != no_way && is_one_wall(wall.on(a), wall.on(b), within);
    };
    std::array<Group, WallAhead::most_pieces> groups;
    std::array<std::size_t, WallAhead::most_pieces> group_of;
    constexpr std::size_t none = WallAhead::most_pieces;
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
            const std::size_t whole = has_behind ? whole_of(pressed.way, n + azimuth_count, wall, within) : pressed.way;
            const bool goes_on = group != none && parts[ring - 1] == parts[ring] &&
                                 (whole == no_way || groups[group].way == no_way || are_one(whole, groups[group].way));
            if (!goes_on) groups[group = count++] = {};
            if (whole != no_way) groups[group].way = whole;
            groups[group].crushes += crushes[n];
            group_of[n] = group;
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        Group& group = groups[i];
        if (group.way != no_way) group.left = broken.is_left_of(wall.on(group.way));
        group.crushes *= group.left;
        is_broken_ = is_broken_ || group.left < 1.0;
    }

    std::array<double, WallAhead::most_pieces> gives;  // [–] resisting fraction of each group
    for (std::size_t i = 0; i < count; ++i) {
        double bears = 0.0, together = 0.0, sharing = 0.0;
        for (std::size_t other = 0; other < count; ++other) {
            if (groups[other].crushes <= 0.0 || (other != i && !are_one(groups[other].way, groups[i].way))) continue;
            bears += groups[other].way != no_way ? wall.on(groups[other].way).load : 0.0;
            together += groups[other].crushes;
            sharing += 1.0;
        }
        const bool breaks = groups[i].crushes > 0.0 && together * sharing > bears;
        if (breaks && groups[i].way != no_way &&
            (breaks_on_ == no_way || wall.on(groups[i].way).load > wall.on(breaks_on_).load))
            breaks_on_ = groups[i].way;
        gives[i] = groups[i].left * (breaks ? bears / (sharing * together) : 1.0);
    }
    for (std::size_t n = 0; n < crushes.size(); ++n)
        if (group_of[n] != none) share_[n] = gives[group_of[n]];
}

}  // namespace kerf::drilling
