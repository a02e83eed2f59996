// SPDX-License-Identifier: Apache-2.0
#include "breaking_wall.h"

#include <algorithm>
#include <cmath>

#include "kerf/assert.hpp"

namespace kerf::drilling {

namespace {

constexpr double clear = 0.25;        // [voxels] so far from its own hole's wall no way meets that
constexpr double begins_in = 1.5;     // [steps] a shell that begins no farther is pressed on: the first of them may be half in the hole
constexpr double of_one_wall = 0.7;   // cosine between the normals of its far side [judgement]
constexpr double worth_telling = 10.0; // [N] what crumbles under less is a sliver between two holes, or a rim [judgement]
constexpr double also_broken = 1.5;   // times what broke: a wall of a fifth more, to which its crack has not come [judgement]

/// The weaker of what is ahead of a piece and beside it. With nothing ahead it is at the far side already.
const Shell& weaker(const Shell& ahead, const Shell& beside) noexcept {
    return ahead.load > 0.0 && beside.load > 0.0 && beside.load < ahead.load ? beside : ahead;
}

/// The weaker of two that are the same wall as `shell`, or else itself; of a piece at the far side nobody knows which that is.
Shell same_wall(const Shell& shell, const Shell& ahead, const Shell& beside) noexcept {
    Shell whole = shell;
    double least = Shell::never;
    for (const Shell* there : {&ahead, &beside}) {
        if (there->load <= 0.0 || there->load >= least || (shell.load > 0.0 && dot(there->normal, shell.normal) < of_one_wall)) continue;
        whole = *there;
        least = there->load;
    }
    return whole;
}

}  // namespace

void WallAhead::look(std::span<const Piece> pieces, double step, double friction, const BoneQuery& bone) noexcept {
    KERF_ASSERT(pieces.size() <= pieces_of_side, "give the pieces of one side");

    // Ahead of each piece, and across its cone: a wall is met end on or alongside.
    std::array<WayOut, Shells::most> ways;
    for (std::size_t n = 0; n < pieces.size(); ++n) {
        const Vec3 inside = pieces[n].at + clear * bone.voxel() * pieces[n].normal;
        ways[2 * n] = {inside, {0, 0, 1}, pieces[n].normal.z};
        ways[2 * n + 1] = {inside, pieces[n].normal, pieces[n].normal.z};
    }
    const Shells shells({ways.data(), 2 * pieces.size()}, step, friction, bone);
    for (std::size_t n = 0; n < pieces.size(); ++n) {
        ahead_[n * azimuth_count + next_] = shells.on(2 * n);
        beside_[n * azimuth_count + next_] = shells.on(2 * n + 1);
    }
    next_ = (next_ + 1) % azimuth_count;
    step_ = step;
    has_seen_ = true;
}

void WallAhead::forget() noexcept {
    if (has_seen_) *this = {};
}

PressedWall::PressedWall(std::span<const double> crushes, const WallAhead& wall, double broken) noexcept {
    KERF_ASSERT(crushes.size() <= WallAhead::most_pieces && crushes.size() % azimuth_count == 0, "give whole rings of pieces, few enough");

    share_.fill(1.0);
    std::array<Side, azimuth_count> sides;
    std::array<bool, WallAhead::most_pieces> is_in_shell{};
    for (std::size_t n = 0; n < crushes.size(); ++n) {
        const Shell& shell = weaker(wall.ahead(n), wall.beside(n));
        is_in_shell[n] = crushes[n] > 0.0 && shell.load < Shell::never && shell.before < begins_in * wall.step();
        if (!is_in_shell[n]) continue;
        Side& side = sides[n % azimuth_count];
        const std::size_t behind = n + azimuth_count;
        side.shell = behind < crushes.size() ? same_wall(shell, wall.ahead(behind), wall.beside(behind)) : shell;
        side.crushes += crushes[n];
    }
    for (Side& side : sides) {
        if (side.crushes > 0.0 && broken > 0.0) side.share = std::clamp((side.shell.load / broken - 1.0) / (also_broken - 1.0), 0.0, 1.0);
        side.crushes *= side.share;
        is_broken_ = is_broken_ || side.share < 1.0;
    }

    std::array<double, azimuth_count> gives;  // [–] share of each side in what its wall bears
    for (std::size_t i = 0; i < azimuth_count; ++i) {
        double bears = 0.0, together = 0.0, count = 0.0;
        for (std::size_t other = 0; other < azimuth_count; ++other) {
            if (sides[other].crushes <= 0.0 || (other != i && dot(sides[other].shell.normal, sides[i].shell.normal) < of_one_wall)) continue;
            bears += sides[other].shell.load;
            together += sides[other].crushes;
            count += 1.0;
        }
        const bool breaks = sides[i].crushes > 0.0 && together * count > bears;
        if (breaks) breaks_ = std::max(breaks_, bears / count);
        gives[i] = sides[i].share * (breaks ? bears / (count * together) : 1.0);
    }
    for (std::size_t n = 0; n < crushes.size(); ++n)
        if (is_in_shell[n]) share_[n] = gives[n % azimuth_count];
}

bool BrokenWall::break_under(double load) noexcept {
    const bool was_told = load_ >= worth_telling;
    load_ = std::max(load_, load);
    away_ = 0.0;
    return !was_told && load_ >= worth_telling;
}

void BrokenWall::go(double along, bool is_in_it, double radius) noexcept {
    away_ = is_in_it ? 0.0 : away_ + std::abs(along);
    if (away_ > radius) load_ = 0.0;
}

}  // namespace kerf::drilling
