// SPDX-License-Identifier: Apache-2.0
#include "core/field/cut/body_query.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace kerf {

namespace {

/// Calls `query(first, count)` for each block of the points.
template <class Query>
void in_blocks(std::uint32_t count, const Query& query) noexcept {
    for (std::size_t first = 0; first < count; first += block_capacity)
        query(first, std::min(block_capacity, count - first));
}

/// Writes a sample in air, member by member: clearing the whole struct takes longer than all other stages of a query.
void write_air(kerf_bone_sample& s) noexcept {
    s.engagement = s.gap = 0.0;
    for (double& weight : s.weight) weight = 0.0;
    for (double& density : s.density) density = 0.0;
    s.body = -1;
    s.reserved = 0;
}

/// Returns whether a coordinate lies outside the region along an axis.
bool is_beyond(const Lattice& grid, std::size_t axis, double at) noexcept {
    return at < grid.low[axis] || at > grid.high[axis];
}
/// Returns whether a point lies strictly inside the region: nothing is cut on its faces.
bool can_be_cut(const Lattice& grid, Vec3 p) noexcept {
    return p.x > grid.low[0] && p.y > grid.low[1] && p.z > grid.low[2] && p.x < grid.high[0] && p.y < grid.high[1] &&
           p.z < grid.high[2];
}

}  // namespace

void BodyQuery::sample(const Vec3* points, std::uint32_t count, Directions directions,
                       kerf_bone_sample* out) const noexcept {
    in_blocks(count, [&](std::size_t first, std::size_t n) {
        sample_block(points + first, n, directions.from(first), out + first);
    });
}

void BodyQuery::sample_block(const Vec3* points, std::size_t count, Directions directions,
                             kerf_bone_sample* out) const noexcept {
    LocatedBlock places;
    FloatBlock uncut, cut, engagement;
    grid_.locate(points, count, places);
    body_->surface.quanta_at(places, uncut);
    committed_->quanta_at(places, cut);
    std::size_t engaged_count = 0;
    for (std::size_t i = 0; i < count; ++i) engagement[i] = kerf::engagement(uncut[i], cut[i]);
    for (std::size_t i = 0; i < count; ++i) engaged_count += engagement[i] > 0.0f;
    if (engaged_count == 0) {
        std::for_each(out, out + count, write_air);
        return;
    }

    // Compute gaps only for points in bone, usually all of them, and tissues for all points of the block.
    BlockValues gap;
    if (engaged_count == count) {
        tracker_->gap(body_from_tool_, points, count, directions, gap);
    } else {
        std::array<Vec3, block_capacity> engaged, direction_of_engaged;
        std::size_t n = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (engagement[i] <= 0.0f) continue;
            direction_of_engaged[n] = directions[i];
            engaged[n++] = points[i];
        }
        const Directions engaged_directions =
            directions.is_one() ? directions : Directions::each(direction_of_engaged.data());
        tracker_->gap(body_from_tool_, engaged.data(), engaged_count, engaged_directions, gap);
        for (std::size_t i = count; i-- > 0;) gap[i] = engagement[i] > 0.0f ? gap[--n] : 0.0;
    }
    for (std::size_t i = 0; grid_.lattice().is_bounded && i < count; ++i)
        if (!can_be_cut(grid_.lattice(), grid_ * points[i])) gap[i] = 0.0;

    std::array<FloatBlock, KERF_MAX_TISSUES> weight, density;
    const std::size_t tissues = body_->materials.size();
    material_weights(*body_, places, weight);
    for (std::size_t m = 0; m < tissues; ++m) {
        const Material& material = body_->materials[m];
        if (material.densities.is_empty())
            std::fill_n(density[m].begin(), count, static_cast<float>(material.density));
        else
            material.densities.at(places, material.density, density[m]);
    }
    block_kernel().rows(
        {engagement.data(), gap.data(), weight[0].data(), density[0].data(), block_capacity, tissues, body_id_}, count,
        out);
    for (std::size_t i = 0; engaged_count < count && i < count; ++i)
        if (engagement[i] <= 0.0f) write_air(out[i]);
}

double BodyQuery::present_distance(Vec3 p) const noexcept {
    const LocatedPoint place = locate(*body_, p);
    const double bone = std::max(body_->surface.at(place), committed_->at(place));
    if (bone >= body_->grid().clamp()) return bone;
    return std::max(bone, body_->region.contains(p) ? tracker_->depth_in_pending(p) : -body_->grid().clamp());
}

void BodyQuery::nearest(const Vec3* points, std::uint32_t count, kerf_surface_point* out) const noexcept {
    PendingSurface pending(*tracker_, body_from_tool_);
    Surface surface{body_->grid().quantum(), body_->grid().clamp(), {}};
    const double rows[3][3] = {{frame_.x.x, frame_.y.x, frame_.z.x},
                               {frame_.x.y, frame_.y.y, frame_.z.y},
                               {frame_.x.z, frame_.y.z, frame_.z.z}};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t n = 0; n < 3; ++n) surface.in_tool[axis][n] = static_cast<float>(rows[axis][n]);
    in_blocks(count, [&](std::size_t first, std::size_t n) {
        nearest_block(pending, surface, points + first, n, out + first);
    });
}

void BodyQuery::nearest_block(PendingSurface& pending, const Surface& surface, const Vec3* points, std::size_t count,
                              kerf_surface_point* out) const noexcept {
    LocatedBlock places;
    SlopeBlock slopes;
    const PointBox box = grid_.locate_box(points, count, places);
    const float minimum =
        block_kernel().slopes(body_->surface.shape(), committed_->shape(), count, places.places(), slopes.writable());
    const bool is_bounded = grid_.lattice().is_bounded;
    std::array<bool, block_capacity> can_rise;
    for (std::size_t i = 0; is_bounded && i < count; ++i) {  // outside the region, bone continues as on its face
        const Vec3 at = grid_ * points[i];
        can_rise[i] = can_be_cut(grid_.lattice(), at);
        if (is_beyond(grid_.lattice(), 0, at.x)) slopes.x[i] = 0.0f;
        if (is_beyond(grid_.lattice(), 1, at.y)) slopes.y[i] = 0.0f;
        if (is_beyond(grid_.lattice(), 2, at.z)) slopes.z[i] = 0.0f;
    }
    block_kernel().answer(surface, count, slopes.slopes(), out);
    pending.raise(points, count, box, surface.quantum * static_cast<double>(minimum),
                  is_bounded ? can_rise.data() : nullptr, out);
    if (body_id_ != 0)
        for (std::size_t i = 0; i < count; ++i)
            if (out[i].body >= 0) out[i].body = body_id_;
}

}  // namespace kerf
