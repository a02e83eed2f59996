// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/drilled_hole.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

namespace kerf::bone {

namespace {

constexpr double section_distance = 0.5e-3;  // [m]
constexpr double whole_circle = 0.95;        // [–] drilled fraction of the drill's section, in bone
constexpr double own_fraction = 0.02;        // [–] of a circle that must not have been drilled before
constexpr int ray_count = 16;
constexpr double longest_ray = 15e-3;  // [m]

double uncut_at(const Body& body, Vec3 p) noexcept { return uncut_distance(body, locate(body, p)); }

double bone_fraction(const Body& body, Vec3 p) noexcept {
    return std::clamp(0.5 - uncut_at(body, p) / body.grid().spacing, 0.0, 1.0);
}

/// Returns two unit vectors that span the plane across `along`.
std::array<Vec3, 2> across(Vec3 along) noexcept {
    const Quat turned = quat_between({0, 0, 1}, along);
    return {rotate(turned, {1, 0, 0}), rotate(turned, {0, 1, 0})};
}

/// One section across the planned axis.
struct Section {
    double depth = 0.0;       ///< [m]
    double x = 0.0, y = 0.0;  ///< [m] middle of the hole, from the axis
    double area = 0.0;        ///< [m²] drilled area in bone, without what was drilled before
    double narrowness = 0.0;  ///< [m] from the axis to the nearest border of bone
    bool is_whole = false;
};

/// Returns the distance from a point along a unit vector to the border of bone [m]; 0 outside bone, `longest_ray`
/// without a border.
double to_border(const Body& body, Vec3 from, Vec3 unit) noexcept {
    const double step = 0.5 * body.grid().spacing;
    double before = uncut_at(body, from);
    if (before >= 0.0) return 0.0;
    for (double far = step; far < longest_ray; far += step) {
        const double now = uncut_at(body, from + far * unit);
        if (now >= 0.0) return far - step * now / (now - before);
        before = now;
    }
    return longest_ray;
}

Vec3 ray(const std::array<Vec3, 2>& plane, int k) noexcept {
    const double angle = 2.0 * 3.14159265358979323846 * k / ray_count;
    return std::cos(angle) * plane[0] + std::sin(angle) * plane[1];
}

double narrowness(const Body& body, Vec3 on_axis, const std::array<Vec3, 2>& plane) noexcept {
    double smallest = longest_ray;
    for (int k = 0; k < ray_count; ++k) smallest = std::min(smallest, to_border(body, on_axis, ray(plane, k)));
    return smallest;
}

Section section_at(const Body& body, const HolePlan& plan, const DrilledFraction& drilled, double depth,
                   const std::array<Vec3, 2>& plane) {
    struct Sample {
        double x, y, fraction;
    };
    Section section{.depth = depth};
    const Vec3 middle = plan.entry + depth * plan.along;
    const double radius = plan.cutting.largest_radius(), reach = radius + plan.beside,
                 pitch = std::max(body.grid().spacing, 0.2e-3);
    const int half = static_cast<int>(std::ceil(reach / pitch));
    double x_sum = 0.0, y_sum = 0.0;
    std::vector<Sample> before;
    for (int i = -half; i <= half; ++i)
        for (int j = -half; j <= half; ++j) {
            const double x = i * pitch, y = j * pitch;
            if (x * x + y * y > reach * reach) continue;
            const Drilled here = drilled(middle + x * plane[0] + y * plane[1]);
            section.area += here.now;
            x_sum += here.now * x;
            y_sum += here.now * y;
            if (here.before > 0.0) before.push_back({x, y, here.before});
        }
    double all = section.area;
    if (section.area > 0.0) {
        section.x = x_sum / section.area;
        section.y = y_sum / section.area;
        // The bone of an earlier hole within the circle belongs to it; the circle's centre depends on that bone.
        constexpr int rounds = 8;
        for (int round = 0; round < rounds && !before.empty(); ++round) {
            double x = x_sum, y = y_sum;
            all = section.area;
            for (const Sample& s : before) {
                if (std::hypot(s.x - section.x, s.y - section.y) > radius) continue;
                all += s.fraction;
                x += s.fraction * s.x;
                y += s.fraction * s.y;
            }
            section.x = x / all;
            section.y = y / all;
        }
    }
    const double circle = 3.14159265358979323846 * radius * radius / (pitch * pitch);
    section.is_whole = all >= whole_circle * circle && section.area >= own_fraction * circle;
    section.area *= pitch * pitch;
    section.narrowness = narrowness(body, middle, plane);
    return section;
}

/// Returns the hole's radius at `behind` [m] from the tip of a drill that only moved in: its widest radius up to there.
double radius_of_hole(const ToolSolid& cutting, double behind) noexcept {
    const auto& outline = cutting.outline();
    double radius = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const double at = outline.front().z - outline[i].z;
        if (at <= behind) {
            radius = std::max(radius, outline[i].radius);
        } else if (i > 0) {
            const double before = outline.front().z - outline[i - 1].z, t = (behind - before) / (at - before);
            return std::max(radius, outline[i - 1].radius + t * (outline[i].radius - outline[i - 1].radius));
        }
    }
    return radius;
}

struct PlannedVolume {
    double whole = 0.0, left = 0.0;  ///< [m³] of bone before any hole, and before this one
};
/// Returns the volumes of the planned hole, sampled on rings of equal area.
PlannedVolume planned_volume(const Body& body, const HolePlan& plan, const DrilledFraction& drilled,
                             const std::array<Vec3, 2>& plane) {
    constexpr int slices = 400, rings = 8;
    const double first = -2.0 * plan.cutting.largest_radius(), thickness = (plan.depth - first) / slices;
    PlannedVolume volume;
    for (int s = 0; s < slices; ++s) {
        const double depth = first + (s + 0.5) * thickness;
        const double radius = radius_of_hole(plan.cutting, plan.depth - depth);
        double whole = 0.0, left = 0.0;
        for (int r = 0; r < rings; ++r)
            for (int k = 0; k < ray_count; ++k) {
                const Vec3 p = plan.entry + depth * plan.along + radius * std::sqrt((r + 0.5) / rings) * ray(plane, k);
                const double bone = bone_fraction(body, p);
                whole += bone;
                left += std::max(0.0, bone - drilled(p).before);
            }
        const double per_sample = thickness * 3.14159265358979323846 * radius * radius / (rings * ray_count);
        volume.whole += per_sample * whole;
        volume.left += per_sample * left;
    }
    return volume;
}

/// Returns the depth of the bone's waist around the axis: the narrowest section with wider ones on both sides. Nothing
/// if bone only widens, or ends. Sections in which the planned hole is not in bone do not count.
std::optional<double> waist_of(const std::vector<Section>& sections, double radius) noexcept {
    constexpr double wider = 0.3e-3;  // [m] beyond the effect of the grid on a straight wall
    const auto first =
        std::find_if(sections.begin(), sections.end(), [&](const Section& s) { return s.narrowness >= radius; });
    const auto has_wider = [&](auto begin, auto end, double than) {
        return std::any_of(begin, end, [&](const Section& s) { return s.narrowness >= than + wider; });
    };
    const Section* found = nullptr;
    for (auto s = first; s != sections.end(); ++s)
        if (s->narrowness >= radius && has_wider(first, s, s->narrowness) &&
            has_wider(s, sections.end(), s->narrowness) && (found == nullptr || s->narrowness < found->narrowness))
            found = &*s;
    return found != nullptr ? std::optional(found->depth) : std::nullopt;
}

/// Returns the depth behind the waist at `depth` at which bone is 1.5 times as wide, if any.
std::optional<double> end_of_waist(const std::vector<Section>& sections, double depth) noexcept {
    constexpr double wider = 1.5;  // [–] [judgement]
    const auto behind = [&](const Section& s) { return s.depth >= depth; };
    const auto waist = std::find_if(sections.begin(), sections.end(), behind);
    if (waist == sections.end() || waist->narrowness <= 0.0) return std::nullopt;
    const auto end = std::find_if(waist, sections.end(),
                                  [&](const Section& s) { return s.narrowness >= wider * waist->narrowness; });
    return end != sections.end() ? std::optional(end->depth) : std::nullopt;
}

const Section& nearest_to(const std::vector<Section>& whole, double depth) noexcept {
    return *std::min_element(whole.begin(), whole.end(), [&](const Section& a, const Section& b) {
        return std::abs(a.depth - depth) < std::abs(b.depth - depth);
    });
}

double offset_of(const Section& section) noexcept { return std::hypot(section.x, section.y); }

/// x = mean + slope (depth − mean depth), the same for y, by least squares.
struct Line {
    double depth = 0.0, x = 0.0, y = 0.0, slope_x = 0.0, slope_y = 0.0;
};
Line line_through(const std::vector<Section>& sections) noexcept {
    Line line;
    const double count = static_cast<double>(sections.size());
    for (const Section& s : sections) {
        line.depth += s.depth / count;
        line.x += s.x / count;
        line.y += s.y / count;
    }
    double dd = 0.0, xd = 0.0, yd = 0.0;
    for (const Section& s : sections) {
        const double d = s.depth - line.depth;
        dd += d * d;
        xd += d * (s.x - line.x);
        yd += d * (s.y - line.y);
    }
    if (dd > 0.0) {
        line.slope_x = xd / dd;
        line.slope_y = yd / dd;
    }
    return line;
}

}  // namespace

std::optional<DrilledHole> measure_hole(const Body& body, const HolePlan& plan, const DrilledFraction& drilled) {
    const std::array<Vec3, 2> plane = across(plan.along);
    const double radius = plan.cutting.largest_radius();
    std::vector<Section> sections;
    // The hole may begin above the entry, if the surface is inclined to the drill.
    const int first = -static_cast<int>(std::ceil(2.0 * radius / section_distance));
    for (int s = first; s * section_distance < plan.depth; ++s)
        sections.push_back(section_at(body, plan, drilled, s * section_distance, plane));
    if (sections.empty()) return {};

    DrilledHole hole;
    for (const Section& s : sections) hole.drilled += s.area * section_distance;
    const PlannedVolume planned = planned_volume(body, plan, drilled, plane);
    hole.ideal = planned.left;
    hole.whole = planned.whole;
    std::vector<Section> whole;
    std::copy_if(sections.begin(), sections.end(), std::back_inserter(whole),
                 [](const Section& s) { return s.is_whole; });
    if (whole.empty()) return {};

    hole.end_depth = whole.back().depth;
    hole.end_offset = offset_of(whole.back());
    hole.entry_depth = whole.front().depth + 2.0 * radius;
    const bool has_bitten = hole.end_depth >= hole.entry_depth;
    if (has_bitten)
        whole.erase(whole.begin(), std::find_if(whole.begin(), whole.end(),
                                                [&](const Section& s) { return s.depth >= hole.entry_depth; }));
    if (has_bitten) hole.entry_offset = offset_of(whole.front());
    hole.narrowest_depth = std::max(waist_of(sections, radius).value_or(hole.entry_depth), hole.entry_depth);
    if (hole.end_depth >= hole.narrowest_depth)
        hole.narrowest_offset = offset_of(nearest_to(whole, hole.narrowest_depth));
    hole.waist_end = end_of_waist(sections, hole.narrowest_depth).value_or(hole.end_depth);

    const Line line = line_through(whole);
    hole.at = plan.entry + line.depth * plan.along + line.x * plane[0] + line.y * plane[1];
    hole.direction = normalized(plan.along + line.slope_x * plane[0] + line.slope_y * plane[1]);
    if (hole.end_depth - whole.front().depth >= 4.0 * radius)
        hole.angle = std::atan(std::hypot(line.slope_x, line.slope_y));
    return hole;
}

std::optional<DrilledHole> hole_along(const Body& body, const HolePlan& plan, Vec3 tip, Vec3 direction) {
    const double steepness = dot(direction, plan.along);
    if (!(steepness >= 0.5)) return {};
    DrilledHole hole;
    hole.at = tip;
    hole.direction = direction;
    hole.end_depth = dot(tip - plan.entry, plan.along);
    const auto offset_at = [&](double depth) {
        const Vec3 middle = tip + (depth - hole.end_depth) / steepness * direction;
        return length(middle - plan.entry - depth * plan.along);
    };
    std::vector<Section> sections;
    const std::array<Vec3, 2> plane = across(plan.along);
    for (double depth = 0.0; depth < hole.end_depth; depth += section_distance)
        sections.push_back({.depth = depth, .narrowness = narrowness(body, plan.entry + depth * plan.along, plane)});
    hole.narrowest_depth = waist_of(sections, plan.cutting.largest_radius()).value_or(0.0);
    hole.waist_end = end_of_waist(sections, hole.narrowest_depth).value_or(hole.end_depth);
    hole.entry_offset = offset_at(0.0);
    hole.narrowest_offset = offset_at(hole.narrowest_depth);
    hole.end_offset = offset_at(hole.end_depth);
    hole.angle = std::atan2(length(cross(direction, plan.along)), steepness);
    return hole;
}

namespace {

/// The face through which a hole enters the bone, as a plane. A cylinder around the hole leaves the bone there at one
/// side, the more the flatter it enters; that is no breach.
class EntryFace {
public:
    /// Searches from outside for the point at which the hole's line meets bone. Without one there is no face.
    EntryFace(const Body& body, const HolePlan& plan, const DrilledHole& hole, double radius)
        : slack_(0.5 * body.grid().spacing), extent_(4.0 * radius), into_(hole.direction) {
        const double steepness = dot(into_, plan.along), first = -4.0 * radius;  // depths along the plan
        const Vec3 outside = hole.at + (first - dot(hole.at - plan.entry, plan.along)) / steepness * into_;
        const auto far = entry_on(body, outside, into_, (hole.end_depth - first) / steepness);
        if (!far) return;
        point_ = outside + *far * into_;
        normal_ = outward_at(body, point_, into_, radius);
        // A hole that grazes the bone at less than 12° [assumed] leaves it at that side.
        if (-dot(normal_, into_) >= 0.21) depth_ = first + *far * steepness;
    }
    /// Returns whether a section at this depth [m] along the planned axis lies behind the face.
    [[nodiscard]] bool is_behind(double depth) const noexcept { return !depth_ || depth >= *depth_; }
    /// Returns whether a point of the border belongs to the face. It may curve away from the plane by 0.15 of the
    /// distance from the hole [assumed].
    [[nodiscard]] bool contains(Vec3 border) const noexcept {
        const Vec3 from_point = border - point_;
        return depth_ && dot(from_point, into_) <= extent_ &&
               std::abs(dot(from_point, normal_)) <= slack_ + 0.15 * length(from_point);
    }

private:
    /// Returns the mean unit normal of the bone's surface around a point of it, within half the radius.
    static Vec3 outward_at(const Body& body, Vec3 point, Vec3 into, double radius) {
        const Vec3 there = gradient(body, point);
        if (there == Vec3{}) return -into;
        const std::array<Vec3, 2> plane = across(there);
        Vec3 sum = there;
        for (int k = 0; k < ray_count; ++k) {
            const Vec3 beside = point + 0.5 * radius * ray(plane, k);
            const double reach = 0.5 * radius;
            const auto far = entry_on(body, beside + reach * there, -there, 2.0 * reach);
            sum = sum + gradient(body, far ? beside + (reach - *far) * there : beside);
        }
        return length(sum) > 1e-9 ? normalized(sum) : -into;
    }
    /// Returns the distance at which a ray from a point first enters bone [m]; nothing within `reach`.
    static std::optional<double> entry_on(const Body& body, Vec3 from, Vec3 along, double reach) {
        const double step = 0.5 * body.grid().spacing;
        double before = uncut_at(body, from);
        for (double far = step; far <= reach; far += step) {
            const double now = uncut_at(body, from + far * along);
            if (before >= 0.0 && now < 0.0) return far - step * now / (now - before);
            before = now;
        }
        return {};
    }
    static Vec3 gradient(const Body& body, Vec3 p) {
        const double h = body.grid().spacing;
        const Vec3 slope{uncut_at(body, p + Vec3{h, 0, 0}) - uncut_at(body, p - Vec3{h, 0, 0}),
                         uncut_at(body, p + Vec3{0, h, 0}) - uncut_at(body, p - Vec3{0, h, 0}),
                         uncut_at(body, p + Vec3{0, 0, h}) - uncut_at(body, p - Vec3{0, 0, h})};
        return length(slope) > 1e-12 ? normalized(slope) : Vec3{};
    }

    double slack_, extent_;          ///< [m] off the plane, and along the hole: two diameters
    Vec3 into_;                      ///< unit
    std::optional<double> depth_{};  ///< [m] of the hole's line at the face; none: there is no face
    Vec3 point_{}, normal_{};        ///< on the face, and outwards
};

}  // namespace

double Breach::worst() const noexcept { return *std::max_element(towards.begin(), towards.end()); }

Breach breach_of(const Body& body, const HolePlan& plan, const DrilledHole& hole, double radius, Vec3 a, Vec3 b,
                 DepthRange range) {
    const std::array<Vec3, 2> plane = across(plan.along);
    Breach breach;
    bool is_inside = false;
    const EntryFace face(body, plan, hole, radius);
    for (double depth = 0.0; depth <= hole.end_depth; depth += section_distance) {
        // A plan that is nowhere surrounded by bone, as of a screw wider than its pedicle, counts from the depth of its
        // diameter.
        is_inside =
            is_inside || depth >= 2.0 * radius || narrowness(body, plan.entry + depth * plan.along, plane) >= radius;
        if (!is_inside || depth < range.from || depth > range.to || !face.is_behind(depth)) continue;
        const Vec3 from_line = plan.entry + depth * plan.along - hole.at;
        const Vec3 middle = hole.at + dot(from_line, plan.along) / dot(hole.direction, plan.along) * hole.direction;
        const std::array<Vec3, 2> around = across(hole.direction);
        const auto side_of = [&](Vec3 unit) -> std::size_t {
            const double to_a = dot(unit, a), to_b = dot(unit, b);
            return std::abs(to_a) >= std::abs(to_b) ? (to_a >= 0.0 ? 0 : 1) : (to_b >= 0.0 ? 2 : 3);
        };
        if (uncut_at(body, middle) >= 0.0) {  // the whole section is on the side to which the hole strayed
            if (radius > breach.worst()) breach.depth = depth;
            breach.towards[side_of(middle - plan.entry - depth * plan.along)] = radius;
            continue;
        }
        for (int k = 0; k < ray_count; ++k) {
            const Vec3 unit = ray(around, k);
            const double border = to_border(body, middle, unit), beyond = radius - border;
            if (beyond <= 0.0 || face.contains(middle + border * unit)) continue;
            if (beyond > breach.worst()) breach.depth = depth;
            double& towards = breach.towards[side_of(unit)];
            towards = std::max(towards, beyond);
        }
    }
    return breach;
}

}  // namespace kerf::bone
