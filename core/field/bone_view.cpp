// SPDX-License-Identifier: Apache-2.0
#include "core/field/bone_view.h"

#include <algorithm>

namespace kerf {

void BoneView::sample(const Vec3* points, std::uint32_t count, Vec3 direction, kerf_bone_sample* out) const noexcept {
    const Vec3 direction_in_body = rotate(body_from_tool_.rotation, direction);
    PointBlock block;
    for (std::size_t first = 0; first < count; first += block_capacity) {
        transform(body_from_tool_, points + first, std::min(block_capacity, count - first), block);
        sample_block(block, direction_in_body, out + first);
    }
}

void BoneView::nearest(const Vec3* points, std::uint32_t count, kerf_surface_point* out) const noexcept {
    PointBlock block;
    for (std::size_t first = 0; first < count; first += block_capacity) {
        transform(body_from_tool_, points + first, std::min(block_capacity, count - first), block);
        nearest_block(block, out + first);
    }
}

void BoneView::committed_distance(const PlaceBlock& places, BlockValues& distances) const noexcept {
    BlockValues cut;
    body_->surface.at(places, distances);
    committed_->at(places, cut);
    for (std::size_t i = 0; i < places.count; ++i) distances[i] = distances[i] < cut[i] ? cut[i] : distances[i];
}

void BoneView::sample_block(const PointBlock& points, Vec3 direction, kerf_bone_sample* out) const noexcept {
    PlaceBlock places;
    BlockValues engagement;
    locate(*body_, points, places);
    committed_distance(places, engagement);
    const double h = body_->grid().spacing;
    for (std::size_t i = 0; i < points.count; ++i) engagement[i] = coverage(engagement[i], h);

    // Whatever lies in air is answered; the others go on.
    std::array<std::uint8_t, block_capacity> lane;
    PointBlock engaged;
    PlaceBlock engaged_places;
    for (std::size_t i = 0; i < points.count; ++i) {
        out[i] = kerf_bone_sample{};
        out[i].body = -1;
        out[i].engagement = engagement[i];
        if (engagement[i] <= 0.0) continue;
        lane[engaged.count] = static_cast<std::uint8_t>(i);
        engaged.add(points[i]);
        engaged_places.add(places, i);
    }
    if (engaged.count == 0) return;

    BlockValues gap;
    std::array<BlockValues, KERF_MAX_TISSUES> weight;
    tracker_->gap(engaged, direction, gap);
    material_weights(*body_, engaged_places, weight);
    for (std::size_t i = 0; i < engaged.count; ++i) {
        kerf_bone_sample& s = out[lane[i]];
        s.body = 0;
        s.gap = body_->region.contains(engaged[i]) ? gap[i] : 0.0;
        for (std::size_t m = 0; m < body_->materials.size(); ++m) {
            s.weight[m] = weight[m][i];
            s.density[m] = body_->materials[m].density;
        }
    }
    for (std::size_t m = 0; m < body_->materials.size(); ++m) {
        const Material& material = body_->materials[m];
        if (material.densities.is_empty()) continue;
        BlockValues density;
        material.densities.at(engaged_places, material.density, density);
        for (std::size_t i = 0; i < engaged.count; ++i) out[lane[i]].density[m] = density[i];
    }
}

double BoneView::present_distance(Vec3 p) const noexcept {
    const BrickPlace place = locate(*body_, p);
    const double bone = std::max(body_->surface.at(place), committed_->at(place));
    if (bone >= body_->grid().clamp()) return bone;
    return std::max(bone, body_->region.contains(p) ? tracker_->depth_in_pending(p) : -body_->grid().clamp());
}

void BoneView::raise_to_present(const PointBlock& points, const BlockValues& bounds,
                                BlockValues& distances) const noexcept {
    const double clamp = body_->grid().clamp();
    std::array<std::uint8_t, block_capacity> lane;
    PointBlock concerned;
    for (std::size_t i = 0; i < points.count; ++i) {
        if (distances[i] >= clamp) continue;
        if (bounds[i] < distances[i] || !body_->region.contains(points[i])) {
            distances[i] = std::max(distances[i], -clamp);
            continue;
        }
        lane[concerned.count] = static_cast<std::uint8_t>(i);
        concerned.add(points[i]);
    }
    if (concerned.count == 0) return;
    BlockValues depth;
    tracker_->depth_in_pending(concerned, depth);
    for (std::size_t i = 0; i < concerned.count; ++i) distances[lane[i]] = std::max(distances[lane[i]], depth[i]);
}

void BoneView::nearest_block(const PointBlock& points, kerf_surface_point* out) const noexcept {
    const double clamp = body_->grid().clamp();
    PlaceBlock places;
    BlockValues distance;
    locate(*body_, points, places);
    committed_distance(places, distance);

    // Far outside there is nothing to raise.
    std::array<std::uint8_t, block_capacity> lane;
    PointBlock near;
    BlockValues near_distance, bound;
    for (std::size_t i = 0; i < points.count; ++i) {
        out[i] = kerf_surface_point{};
        out[i].body = -1;
        out[i].distance = distance[i];
        if (distance[i] >= clamp) continue;
        lane[near.count] = static_cast<std::uint8_t>(i);
        near_distance[near.count] = distance[i];
        near.add(points[i]);
    }
    if (near.count == 0) return;
    tracker_->depth_bound(near, bound);
    raise_to_present(near, bound, near_distance);

    // Only where there is a surface near, it has a normal.
    PointBlock at_surface;
    BlockValues surface_bound;
    for (std::size_t i = 0; i < near.count; ++i) {
        kerf_surface_point& s = out[lane[i]];
        s.distance = near_distance[i];
        if (s.distance >= clamp || s.distance <= -clamp) continue;
        s.body = 0;
        lane[at_surface.count] = lane[i];
        surface_bound[at_surface.count] = bound[i];
        at_surface.add(near[i]);
    }
    if (at_surface.count == 0) return;
    const double e = 0.5 * body_->grid().spacing;
    for (std::size_t i = 0; i < at_surface.count; ++i) surface_bound[i] += e;  // within reach of the points beside

    const Vec3 steps[] = {{e, 0, 0}, {0, e, 0}, {0, 0, e}};
    std::array<BlockValues, 3> gradient;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        PointBlock beside;
        BlockValues after, before;
        const auto present_at = [&](Vec3 by, BlockValues& d) {
            shift(at_surface, by, beside);
            locate(*body_, beside, places);
            committed_distance(places, d);
            raise_to_present(beside, surface_bound, d);
        };
        present_at(steps[axis], after);
        present_at(-steps[axis], before);
        for (std::size_t i = 0; i < at_surface.count; ++i) gradient[axis][i] = after[i] - before[i];
    }
    const Quat tool_from_body = conjugate(body_from_tool_.rotation);
    for (std::size_t i = 0; i < at_surface.count; ++i)
        out[lane[i]].normal = rotate(tool_from_body, normalized(Vec3{gradient[0][i], gradient[1][i], gradient[2][i]}));
}

}  // namespace kerf
