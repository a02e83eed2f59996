// SPDX-License-Identifier: Apache-2.0
#include "run/view/blade_shape.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "kerf/units.hpp"
#include "run/view/tool_traits.h"

namespace kerf::run {

namespace {

using namespace literals;

constexpr double usual_pitch = 1.2_mm;  // [assumed]
constexpr double max_teeth = 400.0;

/// A point of the blade's plane.
struct Flat {
    double x, z;  ///< [m]
};

/// The outline of a blade, seen across it.
struct BladeOutline {
    std::vector<Flat> front;  ///< towards +x
    std::vector<Flat> side;   ///< from the end of the front backwards, on the side of +x
    double depth = 0.0;       ///< [m] from the end of the front to the end of the cutting part
};

BladeOutline outline_of_blade(const ToolOutline& outline) {
    const std::vector<kerf_profile_point>& profile = outline.profile;
    // The front ends where the outline runs backwards more than twice as fast as outwards.
    std::size_t last = 0;
    while (last + 1 < profile.size() &&
           profile[last].z - profile[last + 1].z < 2.0 * (profile[last + 1].radius - profile[last].radius))
        ++last;
    BladeOutline blade;
    for (std::size_t i = last + 1; i-- > 0;) blade.front.push_back({-profile[i].radius, profile[i].z});
    for (std::size_t i = profile.front().radius > 0.0 ? 0 : 1; i <= last; ++i)
        blade.front.push_back({profile[i].radius, profile[i].z});
    for (std::size_t i = last + 1; i < profile.size(); ++i) blade.side.push_back({profile[i].radius, profile[i].z});
    if (outline.cutting_count > 1)
        blade.depth = profile[last].z - profile[outline.cutting_first + outline.cutting_count - 1].z;
    return blade;
}

/// Returns the points that divide a polyline into `count` parts of equal length.
std::vector<Flat> divided(const std::vector<Flat>& line, std::size_t count) {
    std::vector<double> at{0.0};
    for (std::size_t i = 1; i < line.size(); ++i)
        at.push_back(at.back() + length({line[i].x - line[i - 1].x, 0.0, line[i].z - line[i - 1].z}));
    std::vector<Flat> points{line.front()};
    std::size_t piece = 1;
    for (std::size_t n = 1; n < count; ++n) {
        const double s = at.back() * static_cast<double>(n) / static_cast<double>(count);
        while (piece + 1 < at.size() && at[piece] < s) ++piece;
        const double t = (s - at[piece - 1]) / (at[piece] - at[piece - 1]);
        points.push_back({line[piece - 1].x + t * (line[piece].x - line[piece - 1].x),
                          line[piece - 1].z + t * (line[piece].z - line[piece - 1].z)});
    }
    points.push_back(line.back());
    return points;
}

double length_of(const std::vector<Flat>& line) noexcept {
    double sum = 0.0;
    for (std::size_t i = 1; i < line.size(); ++i)
        sum += length({line[i].x - line[i - 1].x, 0.0, line[i].z - line[i - 1].z});
    return sum;
}

/// Points of the two sides of a blade: +y and −y.
struct Pair {
    std::uint32_t left, right;
};

Pair add_pair(Facets& facets, Flat at, double middle, double half) {
    return {facets.add({at.x, middle + half, at.z}), facets.add({at.x, middle - half, at.z})};
}

/// Adds the narrow face between two neighbouring pairs. Seen from +y, the outline runs with +x towards the left, so it
/// is listed against the clock.
void add_edge(Facets& facets, const Pair& a, const Pair& b) { facets.add(a.left, a.right, b.right, b.left, 0); }

/// Returns the pairs along the roots of the teeth, and adds the teeth.
std::vector<Pair> add_teeth(Facets& facets, const BladeOutline& blade, std::size_t teeth, double depth, double half,
                            double set) {
    const std::vector<Flat> marks = divided(blade.front, 2 * teeth);
    std::vector<Pair> roots;
    for (std::size_t n = 0; n < marks.size(); n += 2) {
        // Inwards: across the front in its interior, straight back at its ends.
        const bool is_end = n == 0 || n + 1 == marks.size();
        const Flat before = marks[is_end ? n : n - 1], after = marks[is_end ? n : n + 1];
        const Vec3 along = normalized(Vec3{after.x - before.x, 0.0, after.z - before.z});
        const Vec3 in = is_end ? Vec3{0.0, 0.0, -1.0} : Vec3{along.z, 0.0, -along.x};
        roots.push_back(add_pair(facets, {marks[n].x + depth * in.x, marks[n].z + depth * in.z}, 0.0, half));
    }
    for (std::size_t tooth = 0; tooth < teeth; ++tooth) {
        const Pair &a = roots[tooth], &b = roots[tooth + 1],
                   tip = add_pair(facets, marks[2 * tooth + 1], tooth % 2 == 0 ? set : -set, half);
        const bool is_odd = tooth % 2 != 0;  // each side of a tooth is flat
        facets.add(a.left, tip.left, b.left, is_odd ? 3 : 4);
        facets.add(a.right, b.right, tip.right, is_odd ? 5 : 6);
        add_edge(facets, a, tip);
        add_edge(facets, tip, b);
    }
    return roots;
}

}  // namespace

Facets blade_facets(const Tool& tool) {
    const ToolOutline& outline = tool.outline;
    const BladeOutline blade = outline_of_blade(outline);
    const double half = 0.5 * outline.whole.thickness(), set = 0.5 * (outline.cutting.thickness() - 2.0 * half);
    Facets facets;

    std::vector<Pair> around;  // from the end of the front at −x to that at +x, and on around the blade
    const double front = length_of(blade.front);
    if (outline.cutting_count > 1 && is_powered(tool.setup) && front > 0.0) {
        const double pitch = parameter(tool.setup, "tooth_pitch", dimension::length).value_or(usual_pitch);
        const double teeth = std::clamp(std::round(front / std::max(pitch, 1e-6)), 1.0, max_teeth);
        const double height = outline.profile.front().z - outline.profile.back().z;
        const double depth = std::min({blade.depth > 0.0 ? blade.depth : HUGE_VAL, 0.9 * front / teeth, 0.4 * height});
        around = add_teeth(facets, blade, static_cast<std::size_t>(teeth), depth, half, set);
    } else {
        for (const Flat& at : blade.front) around.push_back(add_pair(facets, at, 0.0, half));
        for (std::size_t i = 1; i < around.size(); ++i) add_edge(facets, around[i - 1], around[i]);
    }
    const std::size_t end_of_front = around.size() - 1;
    for (const Flat& at : blade.side) around.push_back(add_pair(facets, at, 0.0, half));
    const Pair middle = add_pair(facets, {0.0, outline.profile.back().z}, 0.0, half);
    around.push_back(middle);
    for (std::size_t i = blade.side.size(); i-- > 0;)
        around.push_back(add_pair(facets, {-blade.side[i].x, blade.side[i].z}, 0.0, half));
    for (std::size_t i = end_of_front; i < around.size(); ++i)
        add_edge(facets, around[i], around[(i + 1) % around.size()]);

    // Both flat sides are seen whole from the middle of the back edge.
    for (std::size_t i = 0; i < around.size(); ++i) {
        const Pair &a = around[i], &b = around[(i + 1) % around.size()];
        facets.add(middle.left, a.left, b.left, 1);
        facets.add(middle.right, b.right, a.right, 2);
    }
    return facets;
}

}  // namespace kerf::run
