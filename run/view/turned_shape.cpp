// SPDX-License-Identifier: Apache-2.0
#include "run/view/turned_shape.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "kerf/exact_math.hpp"
#include "kerf/units.hpp"

namespace kerf::run {

namespace {

using namespace literals;

/// Returns whether bone is removed between points `i` and `i + 1` of the outline.
bool is_cutting(const ToolOutline& outline, std::size_t i) noexcept {
    if (i < outline.cutting_first || i + 1 >= outline.cutting_first + outline.cutting_count) return false;
    return std::none_of(outline.gaps.begin(), outline.gaps.end(),
                        [i](const kerf_gap& gap) { return i >= gap.first && i < gap.last; });
}

/// Returns whether the surface between points `i` and `i + 1` of the outline has grooves.
bool has_grooves(const ToolOutline& outline, const Grooves& grooves, std::size_t i) noexcept {
    return grooves.is_drill() ? outline.profile[i].z > grooves.end : is_cutting(outline, i);
}

/// Returns z of the rows between two points of the outline, from the tip backwards [m]: close enough that columns turn
/// by at most `turn` [rad], and one at each point where a flute's edge crosses a column of a drill's point.
std::vector<double> rows_between(const kerf_profile_point& a, const kerf_profile_point& b, const Grooves& grooves,
                                 double turn) {
    constexpr double min_distance = 1e-6;  // [m]
    const double back = std::max(b.z, grooves.end);
    std::vector<double> at;
    const auto steps = static_cast<std::size_t>(std::ceil(grooves.twist * (a.z - back) / turn));
    for (std::size_t i = 1; i < steps; ++i)
        at.push_back(a.z + static_cast<double>(i) / static_cast<double>(steps) * (back - a.z));
    if (grooves.is_drill()) {
        for (const double z : {grooves.fade_from, grooves.end}) at.push_back(z);
        for (const GrooveColumn& column : grooves.columns) {
            if (b.radius == a.radius) continue;
            const double slope = (b.z - a.z) / (b.radius - a.radius);
            for (const double radius : {column.floor, column.fraction * grooves.widest})
                at.push_back(a.z + slope * (radius - a.radius));
        }
    }
    std::sort(at.begin(), at.end(), std::greater<>());
    std::vector<double> kept;
    for (const double z : at)
        if (z < (kept.empty() ? a.z : kept.back()) - min_distance && z > b.z + min_distance) kept.push_back(z);
    return kept;
}

/// Returns the largest turn of the columns from row to row [rad]: more where grooves turn often.
double turn_of_rows(const ToolOutline& outline, const Grooves& grooves) noexcept {
    constexpr double finest = 9.0_deg, triangles = 0.6 * max_tool_triangles;
    double grooved = 0.0;
    for (std::size_t i = 0; i + 1 < outline.profile.size(); ++i)
        if (has_grooves(outline, grooves, i)) grooved += outline.profile[i].z - outline.profile[i + 1].z;
    if (grooves.is_drill()) grooved = outline.profile.front().z - grooves.end;
    return std::max(finest, grooves.twist * grooved * 2.0 * static_cast<double>(grooves.columns.size()) / triangles);
}

/// Adds the bore, from its bottom to the tip.
void add_bore(Rows& rows, const ToolOutline& outline, const Grooves& grooves) {
    if (!outline.cutting.is_hollow() || outline.cutting_first > 0) {
        add_row(rows, grooves, outline.profile.front().z, 0.0, false);
        return;
    }
    const double bottom = outline.cutting.end_z(), bore = outline.cutting.bore();
    add_row(rows, grooves, bottom, 0.0, false);
    add_row(rows, grooves, bottom, bore, false);
    add_row(rows, grooves, outline.profile.front().z, bore, false);
}

}  // namespace

void add_row(Rows& rows, const Grooves& grooves, double z, double radius, bool is_grooved) {
    rows.columns = grooves.columns.size();
    const double turned = std::clamp(z, grooves.end, grooves.begin) - grooves.begin;  // straight next to the grooves
    for (const GrooveColumn& column : grooves.columns) {
        const SinCos at = sin_cos_exact(column.azimuth + grooves.twist * turned);
        const double r = is_grooved ? grooves.radius_at(column, z, radius) : radius;
        rows.points.push_back({r * at.cos, r * at.sin, z});
    }
}

void add_end(Rows& rows, const Grooves& grooves, double z, double radius, double depth) {
    if (depth > 0.0) {
        // Half of the width over flats; a corner is at the azimuth 0.
        const double flat = 0.45 * radius;
        for (const double level : {z, z + depth})
            for (const GrooveColumn& column : grooves.columns) {
                const double sixth = pi / 3.0, turns = column.azimuth / sixth;
                const SinCos off = sin_cos_exact((turns - std::floor(turns) - 0.5) * sixth);
                const SinCos at = sin_cos_exact(column.azimuth);
                rows.points.push_back({flat / off.cos * at.cos, flat / off.cos * at.sin, level});
            }
    }
    add_row(rows, grooves, z + depth, 0.0, false);
}

Rows turned_rows(const ToolOutline& outline, const Grooves& grooves) {
    const std::vector<kerf_profile_point>& profile = outline.profile;
    const double turn = turn_of_rows(outline, grooves);
    Rows rows;
    add_bore(rows, outline, grooves);
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const bool before = i > 0 && has_grooves(outline, grooves, i - 1);
        const bool behind = i + 1 < profile.size() && has_grooves(outline, grooves, i);
        add_row(rows, grooves, profile[i].z, profile[i].radius, before || behind);
        if (!behind) continue;
        const double slope = (profile[i + 1].radius - profile[i].radius) / (profile[i + 1].z - profile[i].z);
        for (const double z : rows_between(profile[i], profile[i + 1], grooves, turn))
            add_row(rows, grooves, z, profile[i].radius + slope * (z - profile[i].z), true);
    }
    add_end(rows, grooves, profile.back().z, profile.back().radius, 0.0);
    return rows;
}

}  // namespace kerf::run
