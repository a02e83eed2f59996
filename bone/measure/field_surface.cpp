// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/field_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>

#include "core/field/surface/brick_mesher.h"

namespace kerf::bone {
namespace {

Box bounds_of(const Grid& grid) noexcept {
    return {grid.origin, grid.sample_position(grid.samples(0), grid.samples(1), grid.samples(2))};
}

/// Clips a range of a line to a box; empty (low above high) if the line misses the box.
void clip(const Line& line, const Box& box, double& low, double& high) noexcept {
    const auto along = [&](double Vec3::*axis) {
        const double from = box.low.*axis - line.point.*axis, to = box.high.*axis - line.point.*axis;
        const double slope = line.direction.*axis;
        if (slope == 0.0) {
            if (from > 0.0 || to < 0.0) high = -HUGE_VAL;
            return;
        }
        low = std::max(low, std::min(from / slope, to / slope));
        high = std::min(high, std::max(from / slope, to / slope));
    };
    along(&Vec3::x);
    along(&Vec3::y);
    along(&Vec3::z);
}

/// Calls visit(vertex) for every vertex of the remaining body whose brick meets the box.
template <class Visit>
void for_each_vertex(const Body& body, const CutField& cut, const Box& box, Visit&& visit) {
    const Grid& grid = body.grid();
    const double edge = brick_edge * grid.spacing;
    const auto mesher = std::make_unique<BrickMesher>(body);
    for (std::size_t brick = 0; brick < grid.brick_count(); ++brick) {
        const auto [i, j, k] = grid.brick_coordinates(brick);
        const Vec3 low = grid.sample_position(i * brick_edge - 1, j * brick_edge - 1, k * brick_edge - 1);
        const double side = edge + grid.spacing;
        if (low.x > box.high.x || low.y > box.high.y || low.z > box.high.z || low.x + side < box.low.x ||
            low.y + side < box.low.y || low.z + side < box.low.z || !mesher->may_cross(cut, brick))
            continue;
        for (const SurfaceVertex& vertex : mesher->mesh(cut, brick).vertices)
            visit(Vec3{double{vertex.position[0]}, double{vertex.position[1]}, double{vertex.position[2]}});
    }
}

}  // namespace

double FieldSurface::value_at(Vec3 p) const noexcept {
    const LocatedPoint place = locate(*body_, p);
    return std::max(uncut_distance(*body_, place), cut_->at(place));
}

bool FieldSurface::is_known(Vec3 p) const noexcept { return outside_region(*body_, p) <= 0.0; }

double FieldSurface::wall_between(const Line& line, double outside, double inside) const noexcept {
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (outside + inside);
        (value_at(line.point + middle * line.direction) < 0.0 ? inside : outside) = middle;
    }
    return 0.5 * (outside + inside);
}

Vec3 FieldSurface::normal_at(Vec3 p) const noexcept {
    const double step = 0.5 * body_->grid().spacing;
    const auto slope = [&](Vec3 along) { return value_at(p + step * along) - value_at(p - step * along); };
    const Vec3 gradient{slope({1, 0, 0}), slope({0, 1, 0}), slope({0, 0, 1})};
    return length(gradient) > 0.0 ? normalized(gradient) : Vec3{};
}

std::optional<double> FieldSurface::entry_on(const Line& line, double low, double high) const {
    clip(line, bounds_of(body_->grid()), low, high);
    const double step = 0.5 * body_->grid().spacing;
    if (!(high > low) || !std::isfinite(low) || !std::isfinite(high)) return std::nullopt;
    const auto at = [&](double s) { return line.point + s * line.direction; };
    bool was_air = is_known(at(low)) && value_at(at(low)) >= 0.0;
    for (double before = low, s = low; before < high; before = s) {
        // Of a trilinear field with unit slopes along the axes, the slope is √3 at most.
        const double air = was_air ? value_at(at(before)) / std::sqrt(3.0) : 0.0;
        s = std::min(high, before + std::max(step, air));
        const bool knows = is_known(at(s)), is_bone = value_at(at(s)) < 0.0;
        if (was_air && knows && is_bone) return wall_between(line, before, s);
        was_air = knows && !is_bone;
    }
    return std::nullopt;
}

// Points on the faces of the body's region are left out: they are not surface of the bone.
std::vector<Vec3> FieldSurface::points_in(const Path& region) const {
    const double on_face = 0.01 * body_->grid().spacing;
    std::vector<Vec3> points;
    for_each_vertex(*body_, *cut_, bounds_of(region), [&](Vec3 p) {
        if (bone::distance_to(region, p) > region.within) return;
        if (std::abs(value_at(p)) > 0.5 * body_->grid().spacing) return;  // the region's face cuts through bone
        if (outside_region(*body_, p) > on_face) return;
        points.push_back(p);
    });
    return points;
}

std::vector<Stretch> FieldSurface::stretches_on(const Line& line, double low, double high) const {
    clip(line, bounds_of(body_->grid()), low, high);
    std::vector<Stretch> stretches;
    const double step = 0.5 * body_->grid().spacing;
    if (!(high > low) || !std::isfinite(low) || !std::isfinite(high)) return stretches;
    const auto at = [&](double s) { return line.point + s * line.direction; };
    const auto cosine_at = [&](double s) { return std::abs(dot(normal_at(at(s)), line.direction)); };
    bool was_inside = false;
    double before = low;
    const auto count = static_cast<std::size_t>(std::ceil((high - low) / step));
    for (std::size_t i = 0; i <= count; ++i) {
        const double s = i < count ? low + static_cast<double>(i) * step : high;
        const bool knows = is_known(at(s)), is_inside = knows && value_at(at(s)) < 0.0;
        if (is_inside && !was_inside) {
            Stretch& found = stretches.emplace_back();
            found.is_complete = i > 0 && is_known(at(before));
            found.begin = found.is_complete ? wall_between(line, before, s) : s;
            found.cosine_at_begin = cosine_at(found.begin);
        }
        if (was_inside && (!is_inside || i == count)) {
            Stretch& found = stretches.back();
            found.is_complete = found.is_complete && knows && !is_inside;
            found.end = found.is_complete ? wall_between(line, s, before) : before;
            found.cosine_at_end = cosine_at(found.end);
        }
        was_inside = is_inside;
        before = s;
    }
    return stretches;
}

std::optional<double> FieldSurface::distance_to(Vec3 p) const {
    if (!is_finite(p) || outside_region(*body_, p) > 0.0) return std::nullopt;
    const Grid& grid = body_->grid();
    const double value = value_at(p);
    if (std::abs(value) < 0.75 * grid.clamp()) return value;
    double nearest = HUGE_VAL;
    const Box whole = bounds_of(grid);
    const double all = length(whole.high - whole.low) + length(p - whole.low);
    for (double reach = 8.0 * grid.spacing; !(nearest <= reach) && reach < 4.0 * all; reach *= 2.0) {
        const Box box{p - Vec3{reach, reach, reach}, p + Vec3{reach, reach, reach}};
        for_each_vertex(*body_, *cut_, box, [&](Vec3 v) {
            if (std::abs(value_at(v)) <= 0.5 * grid.spacing) nearest = std::min(nearest, length(v - p));
        });
    }
    if (!std::isfinite(nearest)) return std::nullopt;
    return value < 0.0 ? -nearest : nearest;
}

double FieldSurface::wall_uncertainty() const noexcept { return 0.05 * body_->grid().spacing; }
double FieldSurface::contact_uncertainty() const noexcept { return body_->grid().spacing / std::sqrt(12.0); }

}  // namespace kerf::bone
