// SPDX-License-Identifier: Apache-2.0
#include "core/field/cut/tool_solid.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/field/cut/azimuths.h"
#include "core/field/fnv1a.h"
#include "kerf/assert.hpp"

namespace kerf {

namespace {

double square(double v) noexcept { return v * v; }

double radius_at(const std::vector<kerf_profile_point>& outline, const std::vector<OutlineSegment>& segments,
                 double z) noexcept {
    for (std::size_t i = 1; i < outline.size(); ++i)
        if (!(z < outline[i].z)) return outline[i - 1].radius + segments[i - 1].slope * (outline[i - 1].z - z);
    return outline.back().radius;
}

}  // namespace

ToolSolid::ToolSolid(std::vector<kerf_profile_point> outline, double half_thickness, double bore)
    : outline_(std::move(outline)), half_thickness_(half_thickness), bore_(bore) {
    KERF_ASSERT(outline_.size() >= 2, "give the outline at least a tip and an end");
    for (std::size_t i = 0; i < outline_.size(); ++i) {
        KERF_ASSERT(outline_[i].radius >= 0.0, "radii are not negative");
        KERF_ASSERT(i == 0 || outline_[i].z < outline_[i - 1].z, "list the outline from the tip backwards");
        largest_radius_ = std::max(largest_radius_, outline_[i].radius);
        if (i == 0) continue;
        const double r = outline_[i].radius - outline_[i - 1].radius, z = outline_[i].z - outline_[i - 1].z;
        const double l = std::sqrt(r * r + z * z), nr = -z / l, nz = r / l;
        segments_.push_back(
            {r, z, 1.0 / (r * r + z * z), -r / z, nr, nz, nr * outline_[i].radius + nz * outline_[i].z});
        const OutlineSegment& s = segments_.back();
        const auto single = [](double v) { return static_cast<float>(v); };
        faces_.push_back({single(outline_[i - 1].radius), single(outline_[i - 1].z), single(s.along_r),
                          single(s.along_z), single(s.inverse_length2), single(s.slope), single(s.normal_r),
                          single(s.normal_z), single(s.offset)});
        if (i == 1) continue;
        // From the tip backwards, a convex outline bends only towards the axis.
        const OutlineSegment &a = segments_[i - 2], &b = segments_[i - 1];
        is_blunt_ = is_blunt_ && a.normal_r * b.normal_r + a.normal_z * b.normal_z > -0.5;
        is_convex_ = is_convex_ && b.along_r * a.along_z >= a.along_r * b.along_z;
    }
    const auto is_wider = [](const kerf_profile_point& a, const kerf_profile_point& b) { return a.radius < b.radius; };
    if (std::is_sorted(outline_.begin(), outline_.end(), is_wider))
        land_ = std::lower_bound(outline_.begin(), outline_.end(), outline_.back(), is_wider)->z - end_z();
    if (is_hollow()) is_blunt_ = is_convex_ = false;
    KERF_ASSERT(bore_ == 0.0 || (bore_ > 0.0 && bore_ < largest_radius_), "a bore is narrower than its solid");
    is_blunt_ = is_blunt_ && segments_.front().normal_z > -0.5 && segments_.back().normal_z < 0.5;
    Fnv1a hash;
    const auto add = [&](double v) { hash.add_bytes(std::bit_cast<std::uint64_t>(v), 8); };
    for (const auto& [z, radius] : outline_) {
        add(z);
        add(radius);
    }
    add(half_thickness_);
    if (is_hollow()) add(bore_);
    shape_hash_ = hash.value();
    KERF_ASSERT(is_convex_ || !is_prism(), "give a prism an outline that bends towards the axis only");
}

ToolSolid ToolSolid::parts(std::vector<kerf_profile_point> outline, double bore, const std::vector<Gap>& gaps) {
    ToolSolid solid(std::move(outline), 0.0, bore);
    if (gaps.empty()) return solid;
    double last = solid.tip_z();
    Fnv1a hash;
    hash.add_bytes(solid.shape_hash_, 8);
    for (const Gap& gap : gaps) {
        KERF_ASSERT(gap.front < last && gap.back < gap.front && gap.back > solid.end_z(),
                    "list gaps from the tip backwards, within the outline and apart");
        last = gap.back;
        const OutlineGap slab{0.5 * (gap.front - gap.back), 0.5 * (gap.front + gap.back)};
        solid.slabs_.push_back(slab);
        solid.single_slabs_.push_back({static_cast<float>(slab.half), static_cast<float>(slab.middle)});
        for (const double v : {gap.front, gap.back}) hash.add_bytes(std::bit_cast<std::uint64_t>(v), 8);
    }
    solid.gaps_ = gaps;
    solid.shape_hash_ = hash.value();
    solid.is_blunt_ = solid.is_convex_ = false;
    solid.land_ = 0.0;
    return solid;
}

std::vector<ToolSolid> ToolSolid::each_part() const {
    if (!has_gaps()) return {*this};
    std::vector<ToolSolid> all;
    double front = tip_z();
    for (std::size_t n = 0; n <= gaps_.size(); ++n) {
        const double back = n < gaps_.size() ? gaps_[n].front : end_z();
        std::vector<kerf_profile_point> part;
        if (front < tip_z()) part.push_back({front, radius_at(outline_, segments_, front)});
        for (const kerf_profile_point& point : outline_)
            if (point.z < front + (front < tip_z() ? 0.0 : 1.0) && point.z > back) part.push_back(point);
        part.push_back({back, radius_at(outline_, segments_, back)});
        all.push_back(is_hollow() ? hollow(part, bore_) : ToolSolid(part));
        if (n < gaps_.size()) front = gaps_[n].back;
    }
    return all;
}

std::array<Vec3, 8> ToolSolid::around(double radius, double z) const noexcept {
    std::array<Vec3, 8> points;
    const double y = half_thickness_, x = 0.75 * radius;
    if (is_prism())
        return {
            {{radius, 0, z}, {x, y, z}, {0, y, z}, {-x, y, z}, {-radius, 0, z}, {-x, -y, z}, {0, -y, z}, {x, -y, z}}};
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = {radius * azimuths[i][0], radius * azimuths[i][1], z};
    return points;
}

ToolSolid::Box ToolSolid::box(const Pose& other_from_tool) const noexcept {
    const Vec3 tip = other_from_tool * Vec3{0, 0, tip_z()}, end = other_from_tool * Vec3{0, 0, end_z()};
    Vec3 more{largest_radius_, largest_radius_, largest_radius_};
    if (is_prism()) {
        const Vec3 x = rotate(other_from_tool.rotation, {largest_radius_, 0, 0}),
                   y = rotate(other_from_tool.rotation, {0, half_thickness_, 0});
        more = {std::abs(x.x) + std::abs(y.x), std::abs(x.y) + std::abs(y.y), std::abs(x.z) + std::abs(y.z)};
    }
    return {Vec3{std::min(tip.x, end.x), std::min(tip.y, end.y), std::min(tip.z, end.z)} - more,
            Vec3{std::max(tip.x, end.x), std::max(tip.y, end.y), std::max(tip.z, end.z)} + more};
}

double ToolSolid::distance(Vec3 p) const noexcept {
    const double flat = distance(radius_of(p), p.z);
    if (!is_prism()) return flat;
    const double side = std::abs(p.y) - half_thickness_;
    if (flat <= 0.0 && side <= 0.0) return std::max(flat, side);
    const double off = std::max(flat, 0.0), beside = std::max(side, 0.0);
    return std::sqrt(off * off + beside * beside);
}

double ToolSolid::distance(double r, double z) const noexcept {
    const auto &front = outline_.front(), &back = outline_.back();
    if (!is_convex_) {
        const bool is_inside = z < front.z && z > back.z && r < radius_at(outline_, segments_, z);
        const double distance = std::sqrt(squared_distance(r, z)), outer = is_inside ? -distance : distance;
        double off = is_hollow() ? std::max(outer, bore_ - r) : outer;
        for (const OutlineGap& gap : slabs_) off = std::max(off, gap.half - std::abs(z - gap.middle));
        return off;
    }
    const auto to_face = [&](const OutlineSegment& s) { return s.offset - (s.normal_r * r + s.normal_z * z); };
    double depth = std::min(front.z - z, z - back.z);
    for (const OutlineSegment& s : segments_) depth = std::min(depth, to_face(s));
    if (!(depth < 0.0)) return -depth;

    // Outside, the nearest point of the nearest plane may lie beyond its face's edges.
    bool is_next_to_face = (front.z - z == depth && r <= front.radius) || (z - back.z == depth && r <= back.radius);
    for (std::size_t i = 0; i < segments_.size(); ++i) {
        const OutlineSegment& s = segments_[i];
        const double along =
            ((r - outline_[i].radius) * s.along_r + (z - outline_[i].z) * s.along_z) * s.inverse_length2;
        is_next_to_face = is_next_to_face || (to_face(s) == depth && along >= 0.0 && along <= 1.0);
    }
    return is_next_to_face ? -depth : std::sqrt(squared_distance(r, z));
}

double ToolSolid::max_depth_gain(Vec3 middle, Vec3 half, Vec3 moved, double spread, double deepest) const noexcept {
    // Inside, the depth is the smallest one below the planes of all faces, and so it is concave. It grows by at most
    // the motion along the inward normal of a face that was nearest to the former point. Outside, next to an edge, the
    // direction to the edge lies between the normals of its faces.
    const double size = length(moved) + spread, r = radius_of(middle);
    const double aside = std::sqrt(square(half.x) + square(half.y)) + size, along = half.z + size;
    const double lateral = std::sqrt(square(moved.x) + square(moved.y));
    double outwards = -lateral;  // lower bound
    if (aside < 0.7 * r) {       // azimuths in the box differ by at most asin(aside / r)
        const double in_the_middle = (middle.x * moved.x + middle.y * moved.y) / r;
        outwards = std::max(outwards, in_the_middle - 1.11 * aside / r * lateral);
    }
    outwards -= spread;

    struct Plane {
        double depth, out, on, gain;  // out, on: components of its outward normal away from the axis and along it
    };
    Plane nearest{HUGE_VAL, 0, 0, 0};
    const auto for_each_plane = [&](const auto& what) {
        what(Plane{outline_.front().z - middle.z, 0.0, 1.0, spread - moved.z});
        what(Plane{middle.z - outline_.back().z, 0.0, -1.0, spread + moved.z});
        for (const OutlineSegment& s : segments_)
            what(Plane{s.offset - (s.normal_r * r + s.normal_z * middle.z), s.normal_r, s.normal_z,
                       -s.normal_r * outwards - s.normal_z * moved.z + std::abs(s.normal_z) * spread});
    };
    for_each_plane([&](const Plane& p) {
        if (p.depth < nearest.depth) nearest = p;
    });
    double gain = -HUGE_VAL;
    for_each_plane([&](const Plane& p) {
        const bool may_be_nearest =
            p.depth - nearest.depth <= std::abs(p.out - nearest.out) * aside + std::abs(p.on - nearest.on) * along;
        const double minimum = p.depth - p.out * aside - std::abs(p.on) * along;
        if ((may_be_nearest && minimum <= deepest) || minimum <= 0.0) gain = std::max(gain, p.gain);
    });
    if (gain <= 0.0) return gain;
    return is_blunt_ ? std::min(2.0 * gain, size) : size;  // two faces that meet at 60° or more
}

double ToolSolid::max_depth_gain_outside(const Pose& moved) const noexcept {
    // Depth is concave. So it grows by at most the motion against the direction from the solid's nearest point to the
    // former position. Ahead of the back end this direction points forwards or sideways, unless a face points
    // backwards. A rotation moves a point that ends inside by at most its chord about the origin.
    const Vec3 shift = moved.position;
    const bool has_backward_face =
        std::any_of(segments_.begin(), segments_.end(), [](const OutlineSegment& s) { return s.normal_z < 0.0; });
    const double into =
        has_backward_face ? length(shift) : std::sqrt(square(shift.x) + square(shift.y)) + std::max(0.0, -shift.z);
    const double farthest =
        std::max(std::abs(tip_z()), std::abs(end_z())) + largest_radius_ + half_thickness_ + length(shift);
    return into + 2.0 * length({moved.rotation.x, moved.rotation.y, moved.rotation.z}) * farthest;
}

bool ToolSolid::has_edge_within(Vec3 middle, Vec3 half, double distance) const noexcept {
    if (!is_blunt_) return true;
    const double x = std::abs(middle.x), y = std::abs(middle.y), min_x = std::max(0.0, x - half.x),
                 min_y = std::max(0.0, y - half.y);
    if (is_prism() &&
        std::abs(y - half_thickness_) - half.y < distance)  // then any point of the outline counts as an edge
        return std::abs(this->distance(x, middle.z)) < distance + std::sqrt(square(half.x) + square(half.z));
    const double nearest = is_prism() ? min_x : std::sqrt(square(min_x) + square(min_y));
    const double farthest = is_prism() ? x + half.x : std::sqrt(square(x + half.x) + square(y + half.y));
    return std::any_of(outline_.begin(), outline_.end(), [&](const kerf_profile_point& edge) {
        const double aside = std::max({0.0, nearest - edge.radius, edge.radius - farthest});
        return square(aside) + square(std::max(0.0, std::abs(middle.z - edge.z) - half.z)) < square(distance);
    });
}

double ToolSolid::squared_distance(double r, double z) const noexcept {
    double nearest2 = 1e300;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
        // Project onto the segment; its direction and length are precomputed.
        const auto& a = outline_[i];
        const OutlineSegment& s = segments_[i];
        const double dr = r - a.radius, dz = z - a.z;
        const double t = std::clamp((dr * s.along_r + dz * s.along_z) * s.inverse_length2, 0.0, 1.0);
        nearest2 = std::min(nearest2, square(dr - t * s.along_r) + square(dz - t * s.along_z));
    }
    const auto &front = outline_.front(), &back = outline_.back();
    if (front.radius > 0.0)
        nearest2 = std::min(nearest2, square(std::max(0.0, r - front.radius)) + square(z - front.z));
    return std::min(nearest2, square(std::max(0.0, r - back.radius)) + square(z - back.z));
}

double ToolSolid::deepest_in(Vec3 middle, Vec3 half) const noexcept {
    const double low = middle.z - half.z, high = middle.z + half.z;
    const double beside =
        is_prism() ? std::abs(middle.x) - half.x
                   : std::sqrt(square(middle.x) + square(middle.y)) - std::sqrt(square(half.x) + square(half.y));
    const double r = std::max(0.0, beside);
    double depth = std::min(tip_z() - low, high - end_z());
    if (is_prism()) depth = std::min(depth, half_thickness_ - std::max(0.0, std::abs(middle.y) - half.y));
    for (const OutlineSegment& s : segments_)
        depth = std::min(depth, s.offset - s.normal_r * r - std::min(s.normal_z * low, s.normal_z * high));
    return depth;
}

Vec3 ToolSolid::inward_direction_of_prism(Vec3 p) const noexcept {
    const double r = radius_of(p), side = std::abs(p.y) - half_thickness_, flat = distance(r, p.z);
    const Vec3 across{0.0, p.y < 0.0 ? 1.0 : -1.0, 0.0};
    const bool is_inside = flat <= 0.0 && side <= 0.0;
    if (is_inside ? side > flat : flat <= 0.0) return across;

    // In the plane of the outline: away from the nearest face inside, towards the nearest point outside.
    double in_r = 0.0, in_z = tip_z() - p.z < p.z - end_z() ? -1.0 : 1.0;
    if (flat <= 0.0) {
        double depth = std::min(tip_z() - p.z, p.z - end_z());
        for (const OutlineSegment& s : segments_) {
            const double to_face = s.offset - (s.normal_r * r + s.normal_z * p.z);
            if (!(to_face < depth)) continue;
            depth = to_face;
            in_r = -s.normal_r;
            in_z = -s.normal_z;
        }
    } else {
        double nearest2 = 1e300;
        const auto consider = [&](double off_r, double off_z) {
            const double d2 = square(off_r) + square(off_z);
            if (d2 >= nearest2) return;
            nearest2 = d2;
            in_r = -off_r;
            in_z = -off_z;
        };
        for (std::size_t i = 0; i < segments_.size(); ++i) {
            const OutlineSegment& s = segments_[i];
            const double dr = r - outline_[i].radius, dz = p.z - outline_[i].z;
            const double t = std::clamp((dr * s.along_r + dz * s.along_z) * s.inverse_length2, 0.0, 1.0);
            consider(dr - t * s.along_r, dz - t * s.along_z);
        }
        const auto &front = outline_.front(), &back = outline_.back();
        if (front.radius > 0.0) consider(std::max(0.0, r - front.radius), p.z - front.z);
        consider(std::max(0.0, r - back.radius), p.z - back.z);
    }
    const double beside = flat > 0.0 ? std::max(side, 0.0) : 0.0;
    return normalized(Vec3{p.x < 0.0 ? -in_r : in_r, beside * across.y, in_z});
}

Vec3 ToolSolid::inward_direction(Vec3 p) const noexcept {
    if (is_prism()) return inward_direction_of_prism(p);
    const double r = std::sqrt(p.x * p.x + p.y * p.y);
    if (is_convex_) {  // inside: away from the plane of the nearest face
        const double to_front = tip_z() - p.z, to_back = p.z - end_z();
        double depth = std::min(to_front, to_back), in_r = 0.0, in_z = to_front < to_back ? -1.0 : 1.0;
        for (const OutlineSegment& s : segments_) {
            const double to_face = s.offset - (s.normal_r * r + s.normal_z * p.z);
            if (!(to_face < depth)) continue;
            depth = to_face;
            in_r = s.normal_r;
            in_z = -s.normal_z;
        }
        const double inwards = -in_r / r;
        if (depth >= 0.0) return r > 0.0 ? Vec3{inwards * p.x, inwards * p.y, in_z} : Vec3{in_r, 0.0, in_z};
    }

    // Along the line from the nearest point of the outline; inwards if the point lies on the outline.
    double nearest2 = 1e300, off_r = 0.0, off_z = 0.0, in_r = 0.0, in_z = 0.0;
    const auto consider = [&](double dr, double dz, double inwards_r, double inwards_z) {
        const double d2 = square(dr) + square(dz);
        if (d2 >= nearest2) return;
        nearest2 = d2;
        off_r = dr;
        off_z = dz;
        in_r = inwards_r;
        in_z = inwards_z;
    };
    for (std::size_t i = 0; i < segments_.size(); ++i) {
        const OutlineSegment& s = segments_[i];
        const double dr = r - outline_[i].radius, dz = p.z - outline_[i].z;
        const double t = std::clamp((dr * s.along_r + dz * s.along_z) * s.inverse_length2, 0.0, 1.0);
        consider(dr - t * s.along_r, dz - t * s.along_z, s.along_z, -s.along_r);
    }
    const auto &front = outline_.front(), &back = outline_.back();
    if (front.radius > 0.0) consider(std::max(0.0, r - front.radius), p.z - front.z, 0.0, -1.0);
    consider(std::max(0.0, r - back.radius), p.z - back.z, 0.0, 1.0);

    if (is_hollow()) {  // the distance to the bore is radial
        const double off = r - bore_;
        if (square(off) < nearest2 && (r < bore_ || distance(p) < 0.0))
            return r > 0.0 ? Vec3{p.x / r, p.y / r, 0.0} : Vec3{1.0, 0.0, 0.0};
    }
    for (const OutlineGap& gap : slabs_) {
        const double off = p.z - gap.middle, beside = std::abs(off) - gap.half;
        if (square(beside) < nearest2 && (beside < 0.0 || distance(p) < 0.0)) return {0.0, 0.0, off < 0.0 ? -1.0 : 1.0};
    }
    const double sign = distance(p) < 0.0 ? 1.0 : -1.0;
    if (nearest2 > 0.0) {
        in_r = sign * off_r;
        in_z = sign * off_z;
    }
    return normalized(r > 0.0 ? Vec3{in_r * p.x / r, in_r * p.y / r, in_z} : Vec3{0.0, 0.0, in_z});
}

SingleOutline ToolSolid::faces_near(SingleOutline whole, double x, double spread, double reach) const noexcept {
    // Along x, a point's nearest surface point is at most as far away as the surface. So the nearest face lies within
    // `far` of `x`.
    const double far = spread + reach, low = std::abs(x) - far, high = std::abs(x) + far;
    std::size_t first = 0, last = segments_.size();
    while (first + 1 < last && outline_[first + 1].radius < low) ++first;
    while (last > first + 1 && outline_[last - 1].radius > high) --last;
    whole.face += first;
    whole.count = last - first;
    return whole;
}

void ToolSolid::depths(const Pose& tool_from_other, const PointBlock& points, BlockValues& depths) const noexcept {
    PointBlock in_tool;
    transform(tool_from_other, points, in_tool);
    this->depths(in_tool, depths);
}

void ToolSolid::depths(const PointBlock& points_in_tool, BlockValues& depths) const noexcept {
    block_kernel().depths(shape(), points_in_tool.count, points_in_tool.coordinates(), depths.data());
}

double ToolSolid::travel_to_leave(Vec3 p, Vec3 direction, double tolerance) const noexcept {
    if (distance(p) >= -tolerance) return 0.0;

    // From inside, the first crossing of any face is the exit: end caps first, then each cone.
    double exit = 1e300;
    const auto consider = [&](double t) {
        if (t > 0.0 && t < exit) exit = t;
    };
    const auto& front = outline_.front();
    const auto& back = outline_.back();
    if (direction.z > 0.0 && front.radius > 0.0) consider((front.z - p.z) / direction.z);
    if (direction.z < 0.0) consider((back.z - p.z) / direction.z);
    if (is_prism()) {  // convex: the first of all planes ahead
        const auto consider_plane = [&](double depth, double speed) {
            if (speed > 0.0) consider(depth / speed);
        };
        consider_plane(half_thickness_ - p.y, direction.y);
        consider_plane(half_thickness_ + p.y, -direction.y);
        for (const OutlineSegment& s : segments_)
            for (const double side : {1.0, -1.0})
                consider_plane(s.offset - (side * s.normal_r * p.x + s.normal_z * p.z),
                               side * s.normal_r * direction.x + s.normal_z * direction.z);
        return exit < 1e299 ? exit : 0.0;
    }

    for (const Gap& gap : gaps_) {
        if (direction.z > 0.0 && p.z < gap.back) consider((gap.back - p.z) / direction.z);
        if (direction.z < 0.0 && p.z > gap.front) consider((gap.front - p.z) / direction.z);
    }
    if (is_hollow()) {  // (x + t dx)² + (y + t dy)² = bore², towards the axis
        const double A = square(direction.x) + square(direction.y);
        const double B = p.x * direction.x + p.y * direction.y, C = p.x * p.x + p.y * p.y - bore_ * bore_;
        if (const double discriminant = B * B - A * C; B < 0.0 && discriminant >= 0.0)
            consider(C / (-B + std::sqrt(discriminant)));
    }
    for (std::size_t i = 1; i < outline_.size(); ++i) {
        // On the cone r = q + m z:  (x + t dx)² + (y + t dy)² = (q + m z + m t dz)²
        const auto &a = outline_[i - 1], &b = outline_[i];
        const double m = (a.radius - b.radius) / (a.z - b.z);
        const double q = a.radius - m * a.z;
        const double c0 = q + m * p.z, c1 = m * direction.z;
        const double A = square(direction.x) + square(direction.y) - c1 * c1;
        const double B = p.x * direction.x + p.y * direction.y - c0 * c1;
        const double C = p.x * p.x + p.y * p.y - c0 * c0;
        double roots[2];
        int count = 0;
        if (std::abs(A) < 1e-14) {
            if (B != 0.0) roots[count++] = -C / (2.0 * B);
        } else if (const double discriminant = B * B - A * C; discriminant >= 0.0) {
            const double s = std::sqrt(discriminant);
            const double u = B >= 0.0 ? -B - s : -B + s;  // no cancellation
            roots[count++] = u / A;
            if (u != 0.0) roots[count++] = C / u;
        }
        for (int k = 0; k < count; ++k) {
            const double z = p.z + roots[k] * direction.z;
            const bool is_on_segment = z <= a.z + 1e-12 && z >= b.z - 1e-12;
            const bool is_on_this_nappe = q + m * z >= -1e-12;
            if (is_on_segment && is_on_this_nappe) consider(roots[k]);
        }
    }
    return exit < 1e299 ? exit : 0.0;
}

}  // namespace kerf
