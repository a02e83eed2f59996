// SPDX-License-Identifier: Apache-2.0
#include "run/view/thread_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kerf/exact_math.hpp"
#include "kerf/units.hpp"
#include "run/view/grooves.h"
#include "run/view/tool_traits.h"
#include "run/view/turned_shape.h"

namespace kerf::run {

namespace {

using namespace literals;

constexpr std::size_t min_columns = 8, columns_of_flute = 6, min_columns_of_land = 3;

/// Returns the columns of a threaded tool: few on a long and fine thread. Their `fraction` is the depth in a
/// flute [–].
Grooves columns_of(const ThreadRidge& ridge) {
    const std::size_t count = ridge.columns;
    if (ridge.flutes == 0) return no_grooves(count);
    struct Place {
        double along, depth;  // [–] of the angle between two flutes, of a flute's depth
    };
    constexpr std::array<Place, columns_of_flute> flute{
        {{0.0, 0.0}, {0.01, 0.6}, {0.1, 1.0}, {0.2, 0.85}, {0.3, 0.4}, {0.38, 0.0}}};
    const std::size_t on_land = count / ridge.flutes - flute.size();
    Grooves grooves;
    const auto add = [&](std::uint32_t n, double along, double depth) {
        grooves.columns.push_back({2.0 * pi * (n + along) / ridge.flutes, depth});
    };
    for (std::uint32_t n = 0; n < ridge.flutes; ++n) {
        for (const Place& place : flute) add(n, place.along, place.depth);
        const double last = flute.back().along;
        for (std::size_t i = 1; i <= on_land; ++i)
            add(n, last + (1.0 - last) * static_cast<double>(i) / static_cast<double>(on_land + 1), 0.0);
    }
    return grooves;
}

/// Returns the radius of the surface in a column at z [m]. `height` [–] is 0 between the ridges, 1 on their crest.
double radius_at(const ThreadRidge& ridge, const GrooveColumn& column, double z, double height) noexcept {
    const double core = ridge.core_at(z), full = core + height * (ridge.crest_at(z) - core);
    if (ridge.flutes == 0 || column.fraction == 0.0) return full;
    constexpr double deepest = 0.75;  // [–] of the core's radius
    const double end = ridge.tip - ridge.flute_length, fade = 0.5 * ridge.pitch();
    const double faded = std::clamp((end + fade - z) / fade, 0.0, 1.0);  // 1 behind the flutes
    const double crest = ridge.crest_at(z), depth = column.fraction * (crest - deepest * core) * (1.0 - faded);
    return std::min(full, crest - depth);
}

/// Adds the ridge and the core between its turns. Each row is a helix: one of its ends is the beginning of the row a
/// turn ahead. Points before the front or behind the back of the thread lie on its end.
void add_ridge(Facets& facets, const ThreadRidge& ridge, const Grooves& grooves) {
    const double pitch = ridge.pitch(), crest = pitch - ridge.root - 2.0 * ridge.flank;
    const std::array<double, 4> along{0.0, ridge.root, ridge.root + ridge.flank, ridge.root + ridge.flank + crest};
    constexpr std::array<double, 4> height{0.0, 0.0, 1.0, 1.0};
    const auto columns = static_cast<std::uint32_t>(grooves.columns.size());
    const std::uint32_t per_turn = 4 * ridge.starts;
    const auto turns = static_cast<std::uint32_t>(std::ceil((ridge.front() - ridge.back()) / ridge.lead)) + 3;
    const auto first = static_cast<std::uint32_t>(facets.points.size());
    for (std::uint32_t row = 0; row <= turns * per_turn; ++row) {
        const std::uint32_t ridges = row / 4;
        for (const GrooveColumn& column : grooves.columns) {
            const double raw = ridge.back() - 1.5 * ridge.lead + pitch * ridges + along[row % 4] +
                               ridge.lead * column.azimuth / (2.0 * pi);
            const double z = std::clamp(raw, ridge.back(), ridge.front());
            const double r = radius_at(ridge, column, z, height[row % 4]);
            const SinCos at = sin_cos_exact(column.azimuth);
            facets.add({r * at.cos, r * at.sin, z});
        }
    }
    const bool is_coarse = columns < 24 && ridge.flutes == 0;  // neighbours meet at 15° and more
    for (std::uint32_t row = 0; row < (turns - 1) * per_turn; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            const bool is_last = column + 1 == columns;
            const std::uint32_t here = first + row * columns + column,
                                next = is_last ? first + (row + per_turn) * columns : here + 1;
            facets.add(here + columns, here, next, next + columns,
                       is_coarse ? static_cast<std::uint8_t>(1 + row % 4) : std::uint8_t{0});
        }
}

/// Adds the rows of a cylinder's end with a rounded edge. `length` [m] is that of the cylinder.
void add_rounded_end(Rows& rows, const Grooves& grooves, const kerf_profile_point& end, double length) {
    constexpr int steps = 4;
    const double rounding = std::min(0.35 * end.radius, 0.5 * length);  // [assumed]
    for (int i = 0; i <= steps; ++i) {
        const SinCos at = sin_cos_exact(0.5 * pi * i / steps);
        add_row(rows, grooves, end.z + rounding * (1.0 - at.sin), end.radius - rounding * (1.0 - at.cos), false);
    }
}

}  // namespace

double ThreadRidge::core_at(double z) const noexcept {
    for (std::size_t i = 1; i < core.size(); ++i)
        if (z >= core[i].z) {
            const double t = (core[i - 1].z - z) / (core[i - 1].z - core[i].z);
            return core[i - 1].radius + t * (core[i].radius - core[i - 1].radius);
        }
    return core.back().radius;
}

double ThreadRidge::crest_at(double z) const noexcept {
    const double t = (tip - z) / (tip - back()), inner = core_at(z);
    const double outer = std::max(inner, crest_at_tip + t * (crest - crest_at_tip));
    const double rise = std::clamp((front() - z) / lead, 0.0, 1.0),
                 fall = std::clamp(2.0 * (z - back()) / lead, 0.0, 1.0);
    return inner + std::min(rise, fall) * (outer - inner);
}

ThreadRidge ridge_of(const Tool& tool) {
    const ToolOutline& outline = tool.outline;
    ThreadRidge ridge;
    const std::ptrdiff_t first = outline.thread_count > 2 ? 1 : 0;  // without the cone of the tip
    ridge.core.assign(outline.profile.begin() + first,
                      outline.profile.begin() + static_cast<std::ptrdiff_t>(outline.thread_count));
    ridge.tip = outline.profile.front().z;
    ridge.crest = outline.thread_radius;
    const double taper = parameter(tool.setup, "outer_taper", dimension::length).value_or(0.0);
    ridge.crest_at_tip = ridge.crest - 0.5 * std::clamp(taper, 0.0, ridge.crest);
    const double starts = parameter(tool.setup, "starts", dimension::none).value_or(1.0);
    ridge.starts = static_cast<std::uint32_t>(std::clamp(starts, 1.0, 4.0));
    const double length = ridge.front() - ridge.back();
    const double triangles = 0.9 * max_tool_triangles - 2.0 * max_columns * static_cast<double>(outline.profile.size());
    const double max_ridges = triangles / (8.0 * min_columns) - 5.0;
    ridge.lead = std::max(outline.thread_lead, length * ridge.starts / max_ridges);  // no finer than can be drawn

    constexpr double usual_flank = 30.0_deg, max_flank = 60.0_deg;  // [assumed]: a V of 60°
    constexpr double crest = 0.12, min_root = 0.15;                 // [–] of the pitch [assumed]
    const SinCos flank = sin_cos_exact(
        std::clamp(parameter(tool.setup, "flank_angle", dimension::angle).value_or(usual_flank), 0.0, max_flank));
    const double height = ridge.crest - ridge.core_at(0.5 * (ridge.front() + ridge.back()));
    const double max_length = 0.5 * (1.0 - crest - min_root) * ridge.pitch();
    ridge.flank = std::min(height * flank.sin / flank.cos, max_length);
    ridge.root = (1.0 - crest) * ridge.pitch() - 2.0 * ridge.flank;

    const double flutes = parameter(tool.setup, "flutes", dimension::none).value_or(0.0);
    ridge.flutes = static_cast<std::uint32_t>(std::clamp(flutes, 0.0, 6.0));
    ridge.flute_length = parameter(tool.setup, "flute_length", dimension::length).value_or(0.0);
    ridge.flute_length = std::min(ridge.flute_length, ridge.tip - ridge.back());
    const double ridges = (length / ridge.lead + 1.0) * ridge.starts, columns = triangles / (8.0 * ridges);
    ridge.columns = static_cast<std::size_t>(
        std::clamp(columns, static_cast<double>(min_columns), static_cast<double>(max_columns)));
    if (!(ridge.flute_length > 0.0) || ridge.columns < ridge.flutes * (columns_of_flute + min_columns_of_land))
        ridge.flutes = 0;
    return ridge;
}

Facets threaded_facets(const Tool& tool, std::size_t count, double socket) {
    const std::vector<kerf_profile_point>& profile = tool.outline.profile;
    const ThreadRidge ridge = ridge_of(tool);
    const Grooves grooves = columns_of(ridge);
    Facets facets;

    // The cone of the tip ends on the front row of the thread.
    Rows tip;
    add_row(tip, grooves, profile.front().z, 0.0, false);
    if (ridge.front() < profile.front().z) add_row(tip, grooves, profile.front().z, profile.front().radius, false);
    for (const GrooveColumn& column : grooves.columns) {
        const double r = radius_at(ridge, column, ridge.front(), 0.0);
        const SinCos at = sin_cos_exact(column.azimuth);
        tip.points.push_back({r * at.cos, r * at.sin, ridge.front()});
    }
    add_rows(facets, tip);
    add_ridge(facets, ridge, grooves);

    Rows behind;
    for (std::size_t i = tool.outline.thread_count - 1; i < count; ++i) {
        const bool is_head_end = i + 1 == tool.outline.stay_count && i + 1 > tool.outline.thread_count;
        if (is_head_end && profile[i].radius == profile[i - 1].radius)
            add_rounded_end(behind, grooves, profile[i], profile[i - 1].z - profile[i].z);
        else
            add_row(behind, grooves, profile[i].z, profile[i].radius, false);
    }
    add_end(behind, grooves, profile[count - 1].z, profile[count - 1].radius, socket);
    add_rows(facets, behind);
    return facets;
}

}  // namespace kerf::run
