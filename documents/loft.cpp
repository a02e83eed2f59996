// SPDX-License-Identifier: Apache-2.0
#include "documents/loft.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "core/field/grid/box_distance.h"
#include "documents/superquadric.h"

namespace kerf::documents {
namespace {

constexpr std::size_t frames_per_section = 24;
constexpr double max_lean = 1.5;    // [–] a distance in a section over the one to the leaning wall, for limits
constexpr double no_closer = 5e-3;  // [m] farther from the bounds, the distance to them is enough

/// Returns the slopes of a cubic through values at these parameters: weighted means of the secants.
template <class T>
std::vector<T> slopes_of(const std::vector<double>& at, const std::vector<T>& values) {
    const std::size_t count = values.size();
    std::vector<T> secants(count - 1), slopes(count);
    for (std::size_t i = 0; i + 1 < count; ++i) secants[i] = (1.0 / (at[i + 1] - at[i])) * (values[i + 1] - values[i]);
    // At both ends, of the parabola through three values.
    const auto at_end = [](const T& secant, const T& next, double first, double second) -> T {
        return secant + (first / (first + second)) * (secant - next);
    };
    const bool is_straight = count == 2;
    slopes.front() = is_straight ? secants.front() : at_end(secants[0], secants[1], at[1] - at[0], at[2] - at[1]);
    slopes.back() = is_straight ? secants.back()
                                : at_end(secants[count - 2], secants[count - 3], at[count - 1] - at[count - 2],
                                         at[count - 2] - at[count - 3]);
    for (std::size_t i = 1; i + 1 < count; ++i) {
        const double before = at[i] - at[i - 1], after = at[i + 1] - at[i];
        slopes[i] = (1.0 / (before + after)) * (after * secants[i - 1] + before * secants[i]);
    }
    return slopes;
}

/// Limits slopes so that the cubic has no extremum between its values [fritsch-carlson-1980].
void make_monotone(const std::vector<double>& at, const std::vector<double>& values, std::vector<double>& slopes) {
    for (std::size_t i = 0; i < slopes.size(); ++i)
        for (const std::size_t first : {i - 1, i}) {
            if (first + 1 >= values.size()) continue;  // also behind the start
            const double secant = (values[first + 1] - values[first]) / (at[first + 1] - at[first]);
            if (secant * slopes[i] <= 0.0)
                slopes[i] = 0.0;
            else if (std::abs(slopes[i]) > 3.0 * std::abs(secant))
                slopes[i] = 3.0 * secant;
        }
}

/// A cubic through values, and its slope.
template <class T>
struct Cubic {
    std::vector<double> at{};
    std::vector<T> values{}, slopes{};

    T value(std::size_t i, double t) const {
        const double h = at[i + 1] - at[i], t2 = t * t, t3 = t2 * t;
        return (2.0 * t3 - 3.0 * t2 + 1.0) * values[i] + ((t3 - 2.0 * t2 + t) * h) * slopes[i] +
               (3.0 * t2 - 2.0 * t3) * values[i + 1] + ((t3 - t2) * h) * slopes[i + 1];
    }
    T slope(std::size_t i, double t) const {
        const double h = at[i + 1] - at[i], t2 = t * t;
        return ((6.0 * t2 - 6.0 * t) / h) * values[i] + (3.0 * t2 - 4.0 * t + 1.0) * slopes[i] +
               ((6.0 * t - 6.0 * t2) / h) * values[i + 1] + (3.0 * t2 - 2.0 * t) * slopes[i + 1];
    }
};

template <class Get>
auto cubic_of(const LoftSolid& loft, const std::vector<double>& at, const Get& get) {
    using T = decltype(get(loft.sections.front()));
    Cubic<T> cubic{.at = at};
    for (const LoftSection& section : loft.sections) cubic.values.push_back(get(section));
    cubic.slopes = slopes_of(at, cubic.values);
    if constexpr (std::is_same_v<T, double>) make_monotone(at, cubic.values, cubic.slopes);
    return cubic;
}

/// Returns the distance to the wall in its section [m]. The wall leans by the change of the sizes along the path.
double wall_distance(const LoftFrame& frame, double x, double y, double limit) noexcept {
    const Superellipse curve{frame.half_width, frame.half_height, frame.exponent, frame.taper};
    const NearestOn nearest = nearest_on(curve, {x, y, 0.0}, limit);
    const Vec3 normal = nearest.normal;
    const double lean = normal.x * nearest.at.x / frame.half_width * frame.widening +
                        normal.y * nearest.at.y / frame.half_height * frame.heightening;
    return nearest.distance / std::sqrt(1.0 + lean * lean);
}

/// The same for the outline at `t` from one point of the path to the next.
double outline_distance(const LoftSolid& loft, std::size_t first, double t, double x, double y) noexcept {
    const LoftFrame &a = loft.path[first], &b = loft.path[first + 1];
    const NearestOnOutline nearest =
        nearest_between(loft.outlines[first], loft.outlines[first + 1], t, b.from_start - a.from_start, {x, y, 0.0});
    return nearest.distance / std::sqrt(1.0 + nearest.leaning * nearest.leaning);
}

double mix(double a, double b, double t) noexcept { return a + t * (b - a); }
Vec3 mix(Vec3 a, Vec3 b, double t) noexcept { return a + t * (b - a); }

LoftFrame between(const LoftFrame& a, const LoftFrame& b, double t) noexcept {
    return {.at = mix(a.at, b.at, t),
            .along = mix(a.along, b.along, t),
            .side = mix(a.side, b.side, t),
            .up = mix(a.up, b.up, t),
            .half_width = mix(a.half_width, b.half_width, t),
            .half_height = mix(a.half_height, b.half_height, t),
            .exponent = mix(a.exponent, b.exponent, t),
            .taper = mix(a.taper, b.taper, t),
            .widening = mix(a.widening, b.widening, t),
            .heightening = mix(a.heightening, b.heightening, t),
            .from_start = mix(a.from_start, b.from_start, t)};
}

Box bounds_of(const std::vector<LoftFrame>& path) noexcept {
    Box bounds = empty_box;
    for (const LoftFrame& frame : path) {
        const auto reach = [&](double side, double up) {
            return std::abs(side) * frame.half_width * (1.0 + std::abs(frame.taper)) + std::abs(up) * frame.half_height;
        };
        const Vec3 r{reach(frame.side.x, frame.up.x), reach(frame.side.y, frame.up.y), reach(frame.side.z, frame.up.z)};
        bounds = joined(bounds, Box{frame.at - r, frame.at + r});
    }
    return bounds;
}

/// Returns the index of the frame that is nearest to a point: first among every few of them, then around the best.
std::size_t nearest_frame(const std::vector<LoftFrame>& path, Vec3 p) noexcept {
    constexpr std::size_t stride = 6;
    std::size_t nearest = 0;
    double smallest = HUGE_VAL;
    const auto check = [&](std::size_t i) {
        const Vec3 to = p - path[i].at;
        if (const double square = dot(to, to); square < smallest) {
            smallest = square;
            nearest = i;
        }
    };
    for (std::size_t i = 0; i < path.size(); i += stride) check(i);
    const std::size_t around = nearest, last = std::min(around + stride, path.size() - 1);
    for (std::size_t i = around - std::min(around, stride); i <= last; ++i) check(i);
    return nearest;
}

}  // namespace

void lay_path(LoftSolid& loft) {
    std::vector<double> at{0.0};
    for (std::size_t i = 1; i < loft.sections.size(); ++i)
        at.push_back(at.back() + length(loft.sections[i].at - loft.sections[i - 1].at));
    const auto middle = cubic_of(loft, at, [](const LoftSection& s) { return s.at; });
    const auto width = cubic_of(loft, at, [](const LoftSection& s) { return 0.5 * s.width; });
    const auto height = cubic_of(loft, at, [](const LoftSection& s) { return 0.5 * s.height; });
    const auto exponent = cubic_of(loft, at, [](const LoftSection& s) { return s.exponent; });
    const auto taper = cubic_of(loft, at, [](const LoftSection& s) { return s.taper; });
    const auto turn = cubic_of(loft, at, [](const LoftSection& s) { return s.turn; });
    std::vector<Cubic<Vec3>> corners;
    for (std::size_t n = 0; n < loft.sections.front().outline.size(); ++n)
        corners.push_back(cubic_of(loft, at, [n](const LoftSection& s) { return s.outline[n]; }));
    loft.path.clear();
    loft.outlines.clear();
    const auto add_outline = [&](std::size_t i, double t, LoftFrame& frame) {
        Outline points;
        for (const Cubic<Vec3>& corner : corners) points.push_back(corner.value(i, t));
        const Outline& curve = loft.outlines.emplace_back(smoothed(points));
        for (const Vec3& p : curve) {
            frame.half_width = std::max(frame.half_width, std::abs(p.x));
            frame.half_height = std::max(frame.half_height, std::abs(p.y));
        }
    };
    const auto add = [&](std::size_t i, double t) {
        const Vec3 slope = middle.slope(i, t);
        const double speed = length(slope);
        LoftFrame frame{.at = middle.value(i, t), .along = normalized(slope)};
        const Vec3 up = normalized(loft.up - dot(loft.up, frame.along) * frame.along);
        frame.up = rotate(quat_from_rotation_vector(turn.value(i, t) * frame.along), up);
        frame.side = cross(frame.up, frame.along);
        frame.half_width = width.value(i, t);
        frame.half_height = height.value(i, t);
        frame.exponent = exponent.value(i, t);
        frame.taper = taper.value(i, t);
        frame.widening = width.slope(i, t) / speed;
        frame.heightening = height.slope(i, t) / speed;
        if (!corners.empty()) add_outline(i, t, frame);
        frame.from_start =
            loft.path.empty() ? 0.0 : loft.path.back().from_start + length(frame.at - loft.path.back().at);
        loft.path.push_back(frame);
    };
    for (std::size_t i = 0; i + 1 < loft.sections.size(); ++i)
        for (std::size_t k = 0; k < frames_per_section; ++k)
            add(i, static_cast<double>(k) / static_cast<double>(frames_per_section));
    add(loft.sections.size() - 2, 1.0);
    loft.bounds = bounds_of(loft.path);
    loft.sharpest = loft.outlines.empty()
                        ? HUGE_VAL
                        : std::min(sharpest_radius(loft.outlines.front()), sharpest_radius(loft.outlines.back()));
}

bool has_crossed_outline(const LoftSolid& loft) noexcept {
    return std::any_of(loft.outlines.begin(), loft.outlines.end(), &crosses_itself);
}

double crossing(const LoftSolid& loft) noexcept {
    double largest = 0.0;
    for (std::size_t i = 0; i + 1 < loft.path.size(); ++i) {
        const LoftFrame &a = loft.path[i], &b = loft.path[i + 1];
        const double distance = length(b.at - a.at);
        if (distance <= 0.0) continue;
        const Vec3 bend = (1.0 / distance) * (b.along - a.along);  // curvature, towards the centre of the bend
        largest = std::max({largest, std::abs(dot(bend, a.side)) * a.half_width * (1.0 + std::abs(a.taper)),
                            std::abs(dot(bend, a.up)) * a.half_height});
    }
    return largest;
}

double distance_to(const LoftSolid& loft, Vec3 p, double limit) noexcept {
    const double outside = kerf::distance_to(loft.bounds, p);
    if (outside > no_closer) return outside;
    const std::size_t nearest = nearest_frame(loft.path, p);
    const auto ahead = [&](std::size_t i) { return dot(p - loft.path[i].at, loft.path[i].along); };
    std::size_t first = nearest;
    if (nearest > 0 && (ahead(nearest) < 0.0 || nearest + 1 == loft.path.size())) first = nearest - 1;
    const double before = ahead(first), after = ahead(first + 1);
    const double t = before > after ? std::clamp(before / (before - after), 0.0, 1.0) : 0.0;
    const LoftFrame frame = between(loft.path[first], loft.path[first + 1], t);

    const double start = -dot(p - loft.path.front().at, loft.path.front().along),
                 end = dot(p - loft.path.back().at, loft.path.back().along);
    const bool is_before = first == 0 && t <= 0.0, is_behind = first + 2 == loft.path.size() && t >= 1.0;
    const double over = is_before   ? start
                        : is_behind ? end
                                    : -std::min(frame.from_start, loft.path.back().from_start - frame.from_start);
    const Vec3 to = p - frame.at;
    const double x = dot(to, frame.side), y = dot(to, frame.up);
    const double wall =
        loft.outlines.empty() ? wall_distance(frame, x, y, max_lean * limit) : outline_distance(loft, first, t, x, y);

    // A rim as round as the section's sharpest end would leave a crest there.
    constexpr double roundest = 0.7;  // [–] of that end's radius
    const double smaller = std::min(frame.half_width, frame.half_height),
                 larger = std::max(frame.half_width, frame.half_height);
    const double sharpest = loft.outlines.empty() ? smaller * smaller / larger : loft.sharpest;
    const double rim = std::min(loft.rim, roundest * sharpest);
    const double w = wall + rim, e = over + rim;
    const double distance = std::min(std::max(w, e), 0.0) + std::hypot(std::max(w, 0.0), std::max(e, 0.0)) - rim;
    return distance;
}

}  // namespace kerf::documents
