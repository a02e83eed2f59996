// SPDX-License-Identifier: Apache-2.0
#include "wall_ahead.h"

#include "kerf/assert.hpp"

namespace kerf::drilling {

namespace {

constexpr double clear = 0.25;  // [voxels] start of a ray off the cone, so that it misses the wall of the tip's own
                                // hole

}  // namespace

void WallAhead::sample_side(std::span<const Piece> pieces, double step, double friction,
                            const BoneQuery& bone) noexcept {
    KERF_ASSERT(pieces.size() <= pieces_of_side, "give the pieces of one side");

    // Two rays from each piece, along the shaft and along the cone's normal. So a wall is found end on or alongside.
    std::array<Ray, Shells::max_rays> rays;
    for (std::size_t n = 0; n < pieces.size(); ++n) {
        const Vec3 inside = pieces[n].at + clear * bone.voxel() * pieces[n].normal;
        rays[ahead_of(n)] = {inside, {0, 0, 1}, pieces[n].normal.z};
        rays[along_normal(n)] = {inside, pieces[n].normal, pieces[n].normal.z};
    }
    const Shells shells({rays.data(), 2 * pieces.size()}, step, friction, bone);
    for (std::size_t n = 0; n < pieces.size(); ++n) {
        const std::size_t piece = n * azimuth_count + next_;
        shell_[ahead_of(piece)] = shells.on(ahead_of(n));
        shell_[along_normal(piece)] = shells.on(along_normal(n));
    }
    next_ = (next_ + 1) % azimuth_count;
    step_ = step;
    has_seen_ = true;
}

void WallAhead::forget() noexcept {
    if (has_seen_) *this = {};
}

}  // namespace kerf::drilling
