// SPDX-License-Identifier: Apache-2.0
#include "core/field/bone_view.h"

#include <algorithm>

namespace kerf {

namespace {

/// Member by member: to clear the whole struct at once took longer than all other stages of a question.
void put_air(kerf_bone_sample& s, double engagement) noexcept {
    s.engagement = engagement;
    s.gap = 0.0;
    for (double& weight : s.weight) weight = 0.0;
    for (double& density : s.density) density = 0.0;
    s.body = -1;
    s.reserved = 0;
}

}  // namespace

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
    BlockValues uncut, cut, engagement;
    locate(*body_, points, places);
    body_->surface.at(places, uncut);
    committed_->at(places, cut);
    const double h = body_->grid().spacing;
    for (std::size_t i = 0; i < points.count; ++i) engagement[i] = kerf::engagement(uncut[i], cut[i], h);

    // Whatever lies in air is answered; the others go on.
    std::array<std::uint8_t, block_capacity> lane;
    PointBlock engaged;
    PlaceBlock engaged_places;
    for (std::size_t i = 0; i < points.count; ++i) {
        put_air(out[i], engagement[i]);
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

void BoneView::committed_distance(const PlaceBlock& places, SlopeBlock& distances) const noexcept {
    SlopeBlock cut;
    body_->surface.at(places, distances);
    if (!committed_->at(places, cut)) return;  // nowhere more than the surface's least
    const auto take_larger = [&](const BlockValues& more, BlockValues& of) {
        for (std::size_t i = 0; i < places.count; ++i) of[i] = distances.value[i] < cut.value[i] ? more[i] : of[i];
    };
    take_larger(cut.x, distances.x);
    take_larger(cut.y, distances.y);
    take_larger(cut.z, distances.z);
    take_larger(cut.value, distances.value);
}

void BoneView::level_beyond_region(const PointBlock& points, SlopeBlock& distances) const noexcept {
    // Beyond a face everything is as at the face.
    const Region& region = body_->region;
    for (std::size_t i = 0; i < points.count; ++i) {
        if (points.x[i] < region.low.x || points.x[i] > region.high.x) distances.x[i] = 0.0;
        if (points.y[i] < region.low.y || points.y[i] > region.high.y) distances.y[i] = 0.0;
        if (points.z[i] < region.low.z || points.z[i] > region.high.z) distances.z[i] = 0.0;
    }
}

void BoneView::nearest_block(const PointBlock& points, kerf_surface_point* out) const noexcept {
    const double clamp = body_->grid().clamp();
    PlaceBlock places;
    SlopeBlock committed;
    locate(*body_, points, places);
    committed_distance(places, committed);
    const bool has_region = !body_->region.is_everywhere();
    if (has_region) level_beyond_region(points, committed);

    // Far outside, and beyond the region, there is nothing to raise.
    std::array<std::uint8_t, block_capacity> lane;
    PointBlock uncut;
    BlockValues distance;
    for (std::size_t i = 0; i < points.count; ++i) {
        out[i] = kerf_surface_point{};
        out[i].body = -1;
        out[i].distance = committed.value[i];
        if (committed.value[i] >= clamp) continue;
        out[i].distance = std::max(committed.value[i], -clamp);
        if (has_region && !body_->region.contains(points[i])) continue;
        lane[uncut.count] = static_cast<std::uint8_t>(i);
        distance[uncut.count] = out[i].distance;
        uncut.add(points[i]);
    }
    CutTracker::PendingWalls wall;
    tracker_->raise_to_present(uncut, distance, wall);
    for (std::size_t i = 0; i < uncut.count; ++i) {
        if (wall[i] == CutTracker::none) continue;
        out[lane[i]].distance = distance[i];
        const Vec3 normal = tracker_->normal_of(wall[i], uncut[i]);
        committed.x[lane[i]] = normal.x;
        committed.y[lane[i]] = normal.y;
        committed.z[lane[i]] = normal.z;
    }

    // Only where there is a surface near, it has a normal: the gradient of whichever field the surface is.
    PointBlock normals;
    normals.count = points.count;
    block_kernel().unit(conjugate(body_from_tool_.rotation), points.count,
                        {committed.x.data(), committed.y.data(), committed.z.data()}, normals.writable());
    for (std::size_t i = 0; i < points.count; ++i) {
        if (out[i].distance >= clamp || out[i].distance <= -clamp) continue;
        out[i].body = 0;
        out[i].normal = normals[i];
    }
}

}  // namespace kerf
