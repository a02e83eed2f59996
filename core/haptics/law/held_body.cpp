// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/law/held_body.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/field/surface/bone_surface.h"
#include "core/haptics/law/channel.h"
#include "kerf/force.hpp"

namespace kerf {

namespace {

constexpr double stiffness = 2e5;        // [N/m] bone on bone, per octant [assumed]
constexpr double near_contact = 0.3e-3;  // [m] no channel beyond this distance
constexpr double nearly = 20e-6;         // [m] a point enters a channel if less deep than the deepest point by at most
                                         // this, or by half of the greatest depth if that is more

std::array<Vec3, 8> corners_of(Vec3 low, Vec3 high) noexcept {
    std::array<Vec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i)
        corners[i] = {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z};
    return corners;
}

/// Returns whether the box with these corners comes within `margin` [m] of the body's bounding box. Errs towards true.
bool box_comes_near(const LiveBody& other, const std::array<Vec3, 8>& corners, const Pose& other_from_corners,
                    double margin) noexcept {
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high = -low;
    for (const Vec3 corner : corners) {
        const Vec3 p = other_from_corners * corner;
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return other.is_near_box(low, high, margin);
}

/// Returns one vertex, the first, of each cube with vertices in a lattice of cubes `apart` [m] wide. Widens the cubes
/// until at most `maximum` have vertices.
std::vector<Vec3> thinned(const std::vector<Vec3>& vertices, std::size_t maximum, double apart) {
    for (;; apart *= 1.25) {
        std::map<std::tuple<int, int, int>, Vec3> cubes;
        const auto cube = [&](double x) { return static_cast<int>(std::floor(x / apart)); };
        for (const Vec3& p : vertices) cubes.try_emplace({cube(p.x), cube(p.y), cube(p.z)}, p);
        if (cubes.size() > maximum) continue;
        std::vector<Vec3> points;
        points.reserve(cubes.size());
        for (const auto& [at, p] : cubes) points.push_back(p);
        return points;
    }
}

}  // namespace

HeldBody::HeldBody()
    : points_(max_points),
      octant_(max_points),
      query_points_(max_points),
      query_octants_(max_points),
      query_results_(max_points) {}

void HeldBody::take(Bodies bodies, std::size_t body, const Pose& world_from_tool) noexcept {
    body_ = body;
    members_ = 0;
    count_ = 0;
    ++grip_;
    for (const auto& other : bodies) {
        if (other->group != bodies[body]->group) continue;
        members_ |= 1u << other->id;
        tool_from_[other->id] = inverse(world_from_tool) * other->world_from_body;
    }
}

HeldPoints HeldBody::points_of(Bodies bodies) const {
    std::vector<Vec3> surface;
    double apart = 1.5e-3;
    for (const auto& body : bodies) {
        if (!contains(body->id) || !body->is_present) continue;
        apart = std::max(apart, body->bone->grid().spacing);
        for (const Vec3 p : bone_surface(*body->bone, body->committed).vertices)
            surface.push_back(tool_from_[body->id] * p);
    }
    return {thinned(surface, max_points, apart), grip_};
}

void HeldBody::set_points(const HeldPoints& found) noexcept {
    if (found.grip != grip_) return;
    const std::vector<Vec3>& points = found.points;
    count_ = points.size();
    if (count_ == 0) return;
    low_ = high_ = points.front();
    for (const Vec3 p : points) {
        low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
        high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
    }
    const Vec3 middle = 0.5 * (low_ + high_);
    for (std::size_t i = 0; i < count_; ++i) {
        const Vec3 p = points_[i] = points[i];
        octant_[i] =
            static_cast<std::uint8_t>((p.x > middle.x ? 1 : 0) + (p.y > middle.y ? 2 : 0) + (p.z > middle.z ? 4 : 0));
    }
}

void HeldBody::move(Bodies bodies, const Pose& world_from_tool) const noexcept {
    for (const auto& body : bodies)
        if (contains(body->id)) body->world_from_body = world_from_tool * tool_from_[body->id];
}

double HeldBody::largest_motion(const Pose& from, const Pose& to) const noexcept {
    double maximum = 0.0;
    for (const Vec3 corner : corners_of(low_, high_)) maximum = std::max(maximum, length(to * corner - from * corner));
    return maximum;
}

bool HeldBody::is_near_another(Bodies bodies, const Pose& world_from_tool, double margin) const noexcept {
    return count_ > 0 && std::any_of(bodies.begin(), bodies.end(), [&](const auto& other) {
               return !contains(other->id) && other->is_present &&
                      box_comes_near(*other, corners_of(low_, high_), other->body_from(world_from_tool), margin);
           });
}

std::size_t HeldBody::add_contact(Bodies bodies, const Pose& world_from_tool, kerf_channel* channels) noexcept {
    struct Touch {
        double deepest = -near_contact, weight = 0.0, depth = 0.0;
        Vec6 d{};
    };
    if (count_ == 0) return 0;
    std::array<Touch, max_held_channels> touch{};
    for (const auto& other : bodies) {
        if (contains(other->id) || !other->is_present) continue;
        const Pose other_from_tool = other->body_from(world_from_tool);
        if (!box_comes_near(*other, corners_of(low_, high_), other_from_tool, near_contact)) continue;
        std::size_t queried = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const Vec3 p = other_from_tool * points_[i];
            if (!other->is_near_box(p, p, near_contact)) continue;
            query_points_[queried] = points_[i];
            query_octants_[queried++] = octant_[i];
        }
        if (queried == 0) continue;
        other->view.place(other_from_tool);
        other->view.nearest(query_points_.data(), static_cast<std::uint32_t>(queried), query_results_.data());
        for (std::size_t i = 0; i < queried; ++i) {
            Touch& t = touch[query_octants_[i]];
            if (query_results_[i].body >= 0 && query_results_[i].normal != Vec3{})
                t.deepest = std::max(t.deepest, -query_results_[i].distance);
        }
        // The channel averages all points nearly as deep as the deepest. With the deepest alone, the force would jump
        // between two equally deep points.
        for (std::size_t i = 0; i < queried; ++i) {
            const kerf_surface_point& answer = query_results_[i];
            Touch& t = touch[query_octants_[i]];
            const double depth = -answer.distance, ahead = depth - t.deepest + std::max(nearly, 0.5 * t.deepest);
            if (answer.body < 0 || answer.normal == Vec3{} || ahead <= 0.0 || depth <= -near_contact) continue;
            const double weight = ahead * ahead;
            const Vec6 d = rate_at(query_points_[i], -answer.normal);
            t.weight += weight;
            t.depth += weight * depth;
            for (std::size_t k = 0; k < 6; ++k) t.d[k] += weight * d[k];
        }
    }
    std::size_t count = 0;
    for (std::size_t octant = 0; octant < touch.size(); ++octant) {
        const Touch& t = touch[octant];
        if (t.weight <= 0.0) continue;
        Vec6 d;
        for (std::size_t k = 0; k < 6; ++k) d[k] = t.d[k] / t.weight;
        kerf_channel& c = channels[count++] = contact_channel(OwnContact::held, d, stiffness, t.depth / t.weight);
        c.id += static_cast<std::uint32_t>(octant);
    }
    return count;
}

}  // namespace kerf
