// SPDX-License-Identifier: Apache-2.0
#include "bone/radiograph/attenuation_image.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kerf::bone {
namespace {

constexpr int edge = AttenuationImage::block_edge;
constexpr double far_away = 10.0;  // [m] beyond any picture

bool same(const Pose& a, const Pose& b) noexcept {
    return a.position == b.position && a.rotation.w == b.rotation.w && a.rotation.x == b.rotation.x &&
           a.rotation.y == b.rotation.y && a.rotation.z == b.rotation.z;
}

/// Returns the box of a brick in which bone depends on its samples. Beyond the region, bone continues as at its face.
Box box_of_brick(const Body& body, std::size_t brick) {
    const Grid& grid = body.grid();
    const auto at = grid.brick_coordinates(brick);
    Box box{grid.sample_position(at[0] * brick_edge, at[1] * brick_edge, at[2] * brick_edge),
            grid.sample_position((at[0] + 1) * brick_edge, (at[1] + 1) * brick_edge, (at[2] + 1) * brick_edge)};
    const auto extend = [&](double& low, double& high, double region_low, double region_high) {
        if (low <= region_low) low = -far_away;
        if (high >= region_high) high = far_away;
    };
    extend(box.low.x, box.high.x, body.region.low.x, body.region.high.x);
    extend(box.low.y, box.high.y, body.region.low.y, body.region.high.y);
    extend(box.low.z, box.high.z, body.region.low.z, body.region.high.z);
    return box;
}

/// Returns a box around the bone and its cavities before any cut, body frame.
Box bounds_of(const Body& body) {
    Box all = empty_box;
    for (std::size_t brick = 0; brick < body.grid().brick_count(); ++brick)
        if (body.surface.has_inside(brick) || (!body.hollow.is_empty() && body.hollow.has_inside(brick)))
            all = joined(all, box_of_brick(body, brick));
    return all;
}

/// Returns a box along the axes of frame a around a box of frame b.
Box box_in(const Frame& a_from_b, const Box& box) noexcept {
    const Vec3 centre = a_from_b * (0.5 * (box.low + box.high)), half = 0.5 * (box.high - box.low);
    const auto reach = [&](double x, double y, double z) {
        return std::abs(x) * half.x + std::abs(y) * half.y + std::abs(z) * half.z;
    };
    const Vec3 all{reach(a_from_b.x.x, a_from_b.y.x, a_from_b.z.x), reach(a_from_b.x.y, a_from_b.y.y, a_from_b.z.y),
                   reach(a_from_b.x.z, a_from_b.y.z, a_from_b.z.z)};
    return {centre - all, centre + all};
}

/// Sums over the bodies at a block of points.
struct Coverage {
    FloatBlock bone{}, air{};  ///< [–] fractions of the voxels
    FloatBlock attenuation{};  ///< [1/m] of the bone, times its fraction
};

}  // namespace

Box bone_box(const Body& body, const Pose& world_from_body) {
    const Frame frame = frame_of(world_from_body);
    const Grid& grid = body.grid();
    Box all = empty_box;
    for (std::size_t brick = 0; brick < grid.brick_count(); ++brick) {
        if (!body.surface.has_inside(brick)) continue;
        const auto at = grid.brick_coordinates(brick);
        const std::int16_t* sample = body.surface.stored(brick);
        std::array<int, 3> low{stored_edge, stored_edge, stored_edge}, high{-1, -1, -1};
        if (sample == nullptr) low = {0, 0, 0}, high = {brick_edge, brick_edge, brick_edge};
        for (int i = 0; sample != nullptr && i < stored_samples; ++i) {
            if (sample[i] >= 0) continue;
            const std::array<int, 3> s{i % stored_edge, i / stored_edge % stored_edge, i / stored_edge / stored_edge};
            for (std::size_t a = 0; a < 3; ++a) low[a] = std::min(low[a], s[a]), high[a] = std::max(high[a], s[a]);
        }
        const auto corner = [&](const std::array<int, 3>& s) {
            return grid.sample_position(at[0] * brick_edge + s[0], at[1] * brick_edge + s[1],
                                        at[2] * brick_edge + s[2]);
        };
        all = joined(all, box_in(frame, {corner(low), corner(high)}));
    }
    return all;
}

/// A body where an update finds it.
struct AttenuationImage::Placed {
    const AttenuatingBody* body;
    Frame body_from_world;
    GridFrame grid;
    Box bounds;  ///< of the bone, body frame

    Placed(const AttenuatingBody& one, const Box& bone)
        : body(&one),
          body_from_world(frame_of(inverse(one.world_from_body))),
          grid(one.bone->grid(), one.bone->region, body_from_world),
          bounds(bone) {}

    /// Returns whether bone or a cavity of the body may cover a part of a voxel whose centre lies in a box, world
    /// frame.
    [[nodiscard]] bool reaches(const Box& world, double voxel) const {
        const Body& bone = *body->bone;
        const Grid& of = bone.grid();
        const Box box = grown(box_in(body_from_world, world), 0.5 * voxel + of.spacing);
        if (!meet(box, bounds)) return false;
        const Vec3 low = bone.region.nearest(box.low), high = bone.region.nearest(box.high);
        const auto brick = [&](double p, double origin, std::size_t axis) {
            const double at = std::floor((p - origin) / (brick_edge * of.spacing));
            return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(of.bricks[axis] - 1)));
        };
        for (int k = brick(low.z, of.origin.z, 2); k <= brick(high.z, of.origin.z, 2); ++k)
            for (int j = brick(low.y, of.origin.y, 1); j <= brick(high.y, of.origin.y, 1); ++j)
                for (int i = brick(low.x, of.origin.x, 0); i <= brick(high.x, of.origin.x, 0); ++i) {
                    const std::size_t at = of.brick_index(i, j, k);
                    if (bone.surface.has_inside(at) || (!bone.hollow.is_empty() && bone.hollow.has_inside(at)))
                        return true;
                }
        return false;
    }

    /// Adds the body to the sums at a block of points, world frame.
    void add(const Vec3* points, std::size_t count, double voxel, Coverage& sums) const {
        const Body& bone = *body->bone;
        const float ramp = static_cast<float>(voxel / bone.grid().spacing);
        LocatedBlock at;
        grid.locate(points, count, at);
        FloatBlock distance, other;
        if (body->has_air && !bone.hollow.is_empty()) {
            bone.hollow.quanta_at(at, other);
            for (std::size_t i = 0; i < count; ++i) sums.air[i] = std::max(sums.air[i], coverage(other[i], ramp));
        }
        bone.surface.quanta_at(at, distance);
        body->cut->quanta_at(at, other);
        bool is_there = false;
        FloatBlock left;
        for (std::size_t i = 0; i < count; ++i) {
            left[i] = coverage(std::max(distance[i], other[i]), ramp);
            sums.bone[i] += left[i];
            is_there = is_there || left[i] > 0.0f;
        }
        if (!is_there) return;

        // From here on `left` is the fraction of the voxel that no tissue has taken yet.
        const std::size_t last = bone.materials.size() - 1;
        for (std::size_t m = 0; m <= last; ++m) {
            const Material& material = bone.materials[m];
            FloatBlock weight = left;
            if (m < last) {
                material.border.quanta_at(at, other);
                for (std::size_t i = 0; i < count; ++i) {
                    weight[i] = left[i] * coverage(other[i], ramp);
                    left[i] -= weight[i];
                }
            }
            if (!material.densities.is_empty()) {
                material.densities.at(at, material.density, other);
                for (std::size_t i = 0; i < count; ++i)
                    sums.attenuation[i] += weight[i] * static_cast<float>(bone_attenuation(std::max(other[i], 0.0f)));
            } else {
                const float attenuation = static_cast<float>(bone_attenuation(material.density));
                for (std::size_t i = 0; i < count; ++i) sums.attenuation[i] += weight[i] * attenuation;
            }
        }
    }
};

AttenuationImage AttenuationImage::around(const Box& world, const Size& size) {
    AttenuationImage image;
    const Vec3 extent = world.high - world.low;
    const double longest = std::max({extent.x, extent.y, extent.z});
    const bool is_box = is_finite(world.low) && is_finite(world.high) && extent.x >= 0.0 && extent.y >= 0.0 &&
                        extent.z >= 0.0 && longest > 0.0 && longest < far_away;
    if (!is_box) return image;

    // A voxel to spare on either side: the border of bone may cover a part of it.
    const int count = std::clamp(size.voxels, 16, 256);
    image.spacing_ = std::max(longest / (count - 3), std::max(size.finest, 1e-6));
    const double h = image.spacing_;
    const std::array<double, 3> lengths{extent.x, extent.y, extent.z};
    std::array<double, 3> low{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        image.voxels_[axis] = std::min(256, static_cast<int>(std::ceil(lengths[axis] / h - 1e-9)) + 3);
        image.blocks_[axis] = (image.voxels_[axis] + edge - 1) / edge;
        low[axis] = -0.5 * (image.voxels_[axis] - 1) * h;
    }
    const Vec3 centre = 0.5 * (world.low + world.high);
    image.origin_ = centre + Vec3{low[0], low[1], low[2]};
    const Vec3 around = std::sqrt(3.0) * Vec3{-low[0] + h, -low[1] + h, -low[2] + h};
    const double skin = std::max(size.soft_tissue, 0.0);
    image.soft_tissue_ = {centre, around + Vec3{skin, skin, skin}};

    const auto [nx, ny, nz] = image.voxels_;
    image.values_.assign(index(nx) * index(ny) * index(nz), water_value);
    image.spans_.assign(index(ny) * index(nz), Span{});
    image.is_stale_.assign(index(image.blocks_[0]) * index(image.blocks_[1]) * index(image.blocks_[2]), 0);
    return image;
}

void AttenuationImage::mark(const Box& box_in_body, const Pose& world_from_body) {
    if (!(box_in_body.low.x <= box_in_body.high.x)) return;
    const Box box = box_in(frame_of(world_from_body), box_in_body);
    std::array<int, 3> first{}, last{};
    const auto range = [&](double low, double high, double origin, std::size_t axis) {
        // A voxel depends on the fields at its centre.
        const double end = voxels_[axis] - 1.0;
        const double from = std::floor((low - origin) / spacing_ - 1e-6),
                     to = std::ceil((high - origin) / spacing_ + 1e-6);
        if (!(to >= 0.0 && from <= end)) return false;
        first[axis] = static_cast<int>(std::max(from, 0.0)) / edge;
        last[axis] = static_cast<int>(std::min(to, end)) / edge;
        return true;
    };
    if (!range(box.low.x, box.high.x, origin_.x, 0) || !range(box.low.y, box.high.y, origin_.y, 1) ||
        !range(box.low.z, box.high.z, origin_.z, 2))
        return;
    for (int k = first[2]; k <= last[2]; ++k)
        for (int j = first[1]; j <= last[1]; ++j) {
            const std::size_t row = (index(k) * index(blocks_[1]) + index(j)) * index(blocks_[0]);
            std::fill(is_stale_.begin() + static_cast<std::ptrdiff_t>(row + index(first[0])),
                      is_stale_.begin() + static_cast<std::ptrdiff_t>(row + index(last[0]) + 1), std::uint8_t{1});
        }
}

void AttenuationImage::mark_changes(std::span<const AttenuatingBody> bodies) {
    known_.resize(std::max(bodies.size(), known_.size()));
    for (std::size_t b = 0; b < known_.size(); ++b) {
        KnownBody& known = known_[b];
        const AttenuatingBody body = b < bodies.size() ? bodies[b] : AttenuatingBody{};
        const bool is_same = known.bone != nullptr && known.bone == body.bone && known.has_air == body.has_air &&
                             same(known.world_from_body, body.world_from_body);
        if (is_same && body.changed) {
            for (const std::size_t brick : *body.changed)
                if (brick < body.bone->grid().brick_count())
                    mark(box_of_brick(*body.bone, brick), body.world_from_body);
            continue;
        }
        mark(known.bounds, known.world_from_body);
        if (known.bone != body.bone)
            known.bounds =
                body.bone == nullptr ? empty_box : grown(bounds_of(*body.bone), spacing_ + body.bone->grid().spacing);
        known.bone = body.bone;
        known.has_air = body.has_air;
        known.world_from_body = body.world_from_body;
        mark(known.bounds, known.world_from_body);
    }
    known_.resize(bodies.size());
}

void AttenuationImage::fill_block(std::array<int, 3> first, std::span<const Placed> bodies) {
    constexpr int layers = static_cast<int>(block_capacity) / (edge * edge);  // of a block of points
    const std::array<int, 3> end{std::min(first[0] + edge, voxels_[0]), std::min(first[1] + edge, voxels_[1]),
                                 std::min(first[2] + edge, voxels_[2])};
    const auto centre = [&](int i, int j, int k) {
        return origin_ + spacing_ * Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
    };
    std::array<Vec3, block_capacity> points;
    for (int from = first[2]; from < end[2]; from += layers) {
        const int to = std::min(from + layers, end[2]);
        const Box box{centre(first[0], first[1], from), centre(end[0] - 1, end[1] - 1, to - 1)};
        std::size_t count = 0;
        for (int k = from; k < to; ++k)
            for (int j = first[1]; j < end[1]; ++j)
                for (int i = first[0]; i < end[0]; ++i) points[count++] = centre(i, j, k);
        Coverage sums;
        for (const Placed& body : bodies)
            if (body.reaches(box, spacing_)) body.add(points.data(), count, spacing_, sums);

        count = 0;
        for (int k = from; k < to; ++k)
            for (int j = first[1]; j < end[1]; ++j)
                for (int i = first[0]; i < end[0]; ++i, ++count) {
                    // Bodies that overlap, such as parts pressed together, count in proportion.
                    const float filled = sums.bone[count] + sums.air[count];
                    const float water = static_cast<float>(water_attenuation) * std::max(1.0f - filled, 0.0f);
                    const float mean = (sums.attenuation[count] + water) / std::max(filled, 1.0f);
                    const float steps = mean * static_cast<float>(1.0 / step) + 0.5f;
                    values_[line(j, k) + index(i)] = static_cast<std::uint8_t>(std::min(steps, 255.0f));
                }
        updated_ += count;
    }
}

void AttenuationImage::find_span(int j, int k) noexcept {
    const std::size_t start = line(j, k);
    const auto is_bone = [](std::uint8_t v) { return v != water_value; };
    const auto begin = values_.begin() + static_cast<std::ptrdiff_t>(start), end = begin + voxels_[0];
    const auto first = std::find_if(begin, end, is_bone);
    auto last = end;
    while (last != first && !is_bone(last[-1])) --last;
    spans_[start / index(voxels_[0])] = {static_cast<std::int16_t>(first - begin),
                                         static_cast<std::int16_t>(last - begin)};
}

void AttenuationImage::update(std::span<const AttenuatingBody> bodies) {
    pieces_.clear();
    remake(bodies);
}

void AttenuationImage::remake(std::span<const AttenuatingBody> bodies) {
    updated_ = 0;
    if (values_.empty()) return;
    mark_changes(bodies);
    std::vector<Placed> all;
    for (std::size_t b = 0; b < bodies.size(); ++b)
        if (bodies[b].bone != nullptr && bodies[b].cut != nullptr && !bodies[b].bone->materials.empty())
            all.emplace_back(bodies[b], known_[b].bounds);

    for (int k = 0; k < blocks_[2]; ++k)
        for (int j = 0; j < blocks_[1]; ++j) {
            bool is_touched = false;
            for (int i = 0; i < blocks_[0]; ++i) {
                std::uint8_t& is_stale =
                    is_stale_[(index(k) * index(blocks_[1]) + index(j)) * index(blocks_[0]) + index(i)];
                if (std::exchange(is_stale, std::uint8_t{0}) == 0) continue;
                fill_block({i * edge, j * edge, k * edge}, all);
                is_touched = true;
            }
            if (!is_touched) continue;
            for (int z = k * edge; z < std::min((k + 1) * edge, voxels_[2]); ++z)
                for (int y = j * edge; y < std::min((j + 1) * edge, voxels_[1]); ++y) find_span(y, z);
        }
}

void AttenuationImage::update(const BoneImage& bone, std::span<const BodyInImage> bodies) {
    const std::size_t count = std::min(bone.pieces.size(), bodies.size());
    std::vector<AttenuatingBody> now(count);
    std::vector<std::vector<std::size_t>> changed(count);
    for (std::size_t b = 0; b < count; ++b) {
        const PieceImage& piece = *bone.pieces[b];
        if (!bodies[b].is_bone) continue;
        now[b] = {piece.bone, &piece.cut, bodies[b].world_from_body, std::nullopt, piece.separated_from == b};
        const bool is_known = b < pieces_.size() && pieces_[b] != nullptr && pieces_[b]->bone == piece.bone;
        if (!is_known) continue;
        if (pieces_[b] != bone.pieces[b]) changed[b] = pieces_[b]->cut.differing_bricks(piece.cut);
        now[b].changed = changed[b];
    }
    remake(now);
    pieces_.assign(bone.pieces.begin(), bone.pieces.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t b = 0; b < count; ++b)
        if (!bodies[b].is_bone) pieces_[b] = nullptr;
}

}  // namespace kerf::bone
