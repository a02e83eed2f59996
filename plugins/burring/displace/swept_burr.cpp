// SPDX-License-Identifier: Apache-2.0
#include "swept_burr.h"

#include <algorithm>
#include <cmath>

namespace kerf::burring::displacement {
namespace {

/// Returns the zero of a function that is convex on [low, high], negative at `low` and not negative at `high`.
template <class Function>
double root(const Function& value, double low, double high) noexcept {
    double at_low = value(low), at_high = value(high);
    if (!(at_low < 0.0)) return low;
    if (!(at_high > 0.0)) return high;
    // False position; an end that stays twice counts half (the Illinois rule).
    int stayed = 0;
    for (int n = 0; n < 100 && high - low > 1e-13; ++n) {
        const double middle = low + (high - low) * (at_low / (at_low - at_high));
        const double at_middle = value(middle);
        if (std::abs(at_middle) < 1e-10) return middle;
        if (at_middle < 0.0) {
            low = middle;
            at_low = at_middle;
            if (stayed < 0) at_high *= 0.5;
            stayed = -1;
        } else {
            high = middle;
            at_high = at_middle;
            if (stayed > 0) at_low *= 0.5;
            stayed = 1;
        }
    }
    return low;
}

}  // namespace

Vec3 Source::nearest(Vec3 point) const noexcept {
    const Vec3 travel = to - from;
    const double size = dot(travel, travel);
    if (!(size > 0.0)) return from;
    return from + std::clamp(dot(point - from, travel) / size, 0.0, 1.0) * travel;
}

std::optional<SweptBurr> SweptBurr::make(std::span<const kerf_profile_point> outline, double kerf, const Pose& from,
                                         const Pose& to, std::string& why) {
    const auto no = [&why](const char* reason) {
        why = reason;
        return std::nullopt;
    };
    if (kerf != 0.0) return no("a blade is no burr: its slot has edges");
    if (outline.size() < 2) return no("the tool has no outline");
    if (!is_finite(from) || !is_finite(to)) return no("a pose of the tool is no number");
    SweptBurr burr;
    burr.tip_ = outline.front().z;
    burr.end_ = outline.back().z;
    burr.faces_.push_back({0.0, 1.0, burr.tip_});
    burr.faces_.push_back({0.0, -1.0, -burr.end_});
    for (std::size_t i = 0; i < outline.size(); ++i) {
        if (!std::isfinite(outline[i].z) || !(outline[i].radius >= 0.0) || !std::isfinite(outline[i].radius))
            return no("a point of the tool's outline is no number");
        burr.largest_radius_ = std::max(burr.largest_radius_, outline[i].radius);
        if (i == 0) continue;
        const double dz = outline[i].z - outline[i - 1].z, dr = outline[i].radius - outline[i - 1].radius;
        const double size = std::sqrt(dz * dz + dr * dr);
        if (!(dz < 0.0)) return no("the tool's outline turns back");
        const double across = -dz / size, along = dr / size;
        burr.faces_.push_back({across, along, across * outline[i].radius + along * outline[i].z});
    }
    if (!(burr.largest_radius_ > 0.0)) return no("the tool has no volume");
    constexpr double hollow = 1e-9;  // [m]
    for (const kerf_profile_point& p : outline)
        for (const Face& face : burr.faces_)
            if (face.across * p.radius + face.along * p.z - face.offset > hollow) return no("the tool is not convex");
    burr.from_ = from;
    burr.to_ = to;
    const Quat &a = from.rotation, &b = to.rotation;
    burr.turns_ = !(a.w == b.w && a.x == b.x && a.y == b.y && a.z == b.z);
    const double half_cosine = std::abs(a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z);
    const double angle = 2.0 * std::sqrt(std::max(0.0, 1.0 - half_cosine * half_cosine));  // [rad] or a little less
    constexpr double max_turn_of_piece = 0.01;  // [rad] a sweep convex to 0.1 um, with a tool of 10 mm
    burr.pieces_ = static_cast<int>(std::clamp(std::ceil(angle / max_turn_of_piece), 1.0, 64.0));
    burr.is_nearly_straight_ = angle < 4.0 * max_turn_of_piece;
    burr.travel_in_tool_ = rotate(conjugate(from.rotation), to.position - from.position);
    return burr;
}

Pose SweptBurr::pose_at(double t) const noexcept {
    Pose pose{from_.position + t * (to_.position - from_.position), from_.rotation};
    if (!turns_) return pose;
    const Quat &a = from_.rotation, &b = to_.rotation;
    const double sign = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z < 0.0 ? -t : t, rest = 1.0 - t;
    pose.rotation = normalized(
        Quat{rest * a.w + sign * b.w, rest * a.x + sign * b.x, rest * a.y + sign * b.y, rest * a.z + sign * b.z});
    return pose;
}

Vec3 SweptBurr::in_tool(double t, Vec3 point) const noexcept {
    return turns_ ? inverse(pose_at(t)) * point
                  : rotate(conjugate(from_.rotation), point - from_.position) - t * travel_in_tool_;
}

SweptBurr::Instant SweptBurr::at(double t, Vec3 point) const noexcept {
    const Vec3 p = in_tool(t, point);
    const double r = std::sqrt(p.x * p.x + p.y * p.y);
    double largest = -HUGE_VAL;
    const Face* nearest = &faces_.front();
    for (const Face& face : faces_) {
        const double outside = face.across * r + face.along * p.z - face.offset;
        if (outside > largest) {
            largest = outside;
            nearest = &face;
        }
    }
    Vec3 travel = -travel_in_tool_;
    if (turns_) {
        constexpr double step = 1e-6;
        travel = (in_tool(t + step, point) - p) / step;
    }
    const Vec3 outwards = r > 0.0 ? Vec3{p.x / r, p.y / r, 0.0} : Vec3{};
    const Vec3 normal = nearest->across * outwards + Vec3{0, 0, nearest->along};
    return {t, largest, dot(normal, travel), rotate(turns_ ? pose_at(t).rotation : from_.rotation, normal)};
}

SweptBurr::Minimum SweptBurr::minimum(Vec3 point) const noexcept {
    Instant begin = at(0.0, point);
    Minimum found{HUGE_VAL, begin, begin};
    for (int piece = 1; piece <= pieces_; ++piece) {
        const Instant end = at(piece == pieces_ ? 1.0 : static_cast<double>(piece) / pieces_, point);
        const Minimum one = min_between(begin, end, point);
        if (one.outside < found.outside) found = one;
        begin = end;
    }
    return found;
}

SweptBurr::Minimum SweptBurr::min_between(Instant low, Instant high, Vec3 point) const noexcept {
    // Where the function is convex in t, it lies above its tangents. Their intersection is a lower bound and the next
    // guess.
    constexpr double near = 1e-10;  // [m]
    double minimum = std::min(low.outside, high.outside);
    if (low.slope >= 0.0) return {minimum, low, low};
    if (high.slope <= 0.0) return {minimum, high, high};
    for (int n = 0; n < 60; ++n) {
        const double width = high.t - low.t;
        const double fraction =
            (high.outside - low.outside - high.slope * width) / ((low.slope - high.slope) * width);  // [–] of the width
        if (!(minimum - (low.outside + low.slope * fraction * width) > near)) break;
        const Instant next = at(low.t + std::clamp(fraction, 0.01, 0.99) * width, point);
        minimum = std::min(minimum, next.outside);
        if (next.slope == 0.0) return {minimum, next, next};
        (next.slope < 0.0 ? low : high) = next;
    }
    return {minimum, low, high};
}

double SweptBurr::outside(Vec3 point) const noexcept { return minimum(point).outside; }

SweptBurr::Bound SweptBurr::outside_lower_bound(Vec3 point) const noexcept {
    // Each instant bounds all points at all instants by a plane. The two planes combine to one that does not depend on
    // t.
    const auto [outside, low, high] = minimum(point);
    if (low.t == high.t) return {low.outside, low.normal};
    const double fraction = high.slope / (high.slope - low.slope);
    return {fraction * (low.outside - low.slope * low.t) + (1.0 - fraction) * (high.outside - high.slope * high.t),
            fraction * low.normal + (1.0 - fraction) * high.normal};
}

Vec3 SweptBurr::exit(const Source& source, Vec3 through) const noexcept {
    const Vec3 begin = source.nearest(through), ray = normalized(through - begin);
    const auto value = [&](double s) { return outside(begin + s * ray); };
    double low = 0.0, high = length(through - begin);
    for (double at = value(high); at < 0.0; at = value(high)) {
        low = high;
        high += std::max({-2.0 * at, 0.25 * high, 1e-6});
    }
    return begin + root(value, low, high) * ray;
}

Vec3 SweptBurr::crossing(Vec3 inside, Vec3 other) const noexcept {
    const Vec3 ray = normalized(other - inside);
    return inside + root([&](double s) { return outside(inside + s * ray); }, 0.0, length(other - inside)) * ray;
}

std::vector<Source> SweptBurr::sources() const {
    std::vector<Source> found;
    for (const double height : {0.5, 0.25, 0.1, 0.02, 0.75}) {
        const Vec3 in_tool{0, 0, end_ + height * (tip_ - end_)};
        const auto at = [&](double t) { return pose_at(t) * in_tool; };
        for (const double t : {1.0, 0.75, 0.5, 0.25}) found.push_back({at(0.0), at(t)});
        for (const double t : {0.0, 0.5, 1.0}) found.push_back({at(t), at(t)});
    }
    return found;
}

}  // namespace kerf::burring::displacement
