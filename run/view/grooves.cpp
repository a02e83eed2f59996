// SPDX-License-Identifier: Apache-2.0
#include "run/view/grooves.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kerf/exact_math.hpp"
#include "kerf/units.hpp"
#include "run/view/tool_traits.h"

namespace kerf::run {

namespace {

using namespace literals;

constexpr double max_helix = 60.0_deg;   // [rad] helix of a drill
constexpr double max_turn = 2500.0_deg;  // [rad] that grooves turn; more would cost too many triangles

/// Returns the twist of a right-hand helix at `radius` [rad/m], less if it turned too often over `length` [m].
double twist_of(double helix, double radius, double length) noexcept {
    const SinCos h = sin_cos_exact(helix);
    return std::min(h.sin / h.cos / radius, max_turn / length);
}

/// Returns z where the part behind the cutting part ends that is as wide as the cutting part, to within a tenth less
/// [m].
double end_of_body(const ToolOutline& outline, double widest) noexcept {
    const std::size_t cutting_end = outline.cutting_first + outline.cutting_count;
    for (std::size_t i = cutting_end; i < outline.profile.size(); ++i)
        if (outline.profile[i].radius < 0.9 * widest || outline.profile[i].radius > widest + 1.0_um)
            return outline.profile[i - 1].z;
    return outline.profile.back().z;
}

/// Returns the radius of a drill's flute [–] of the drill's, at an angle from the middle of the flute. Its
/// cross-section is an arc around a point outside the web.
double arc_floor(double angle) noexcept {
    constexpr double web = 0.22, arc = 0.85, middle = web + arc;  // [–] of the drill's radius [assumed]
    const SinCos at = sin_cos_exact(angle);
    const double across = middle * at.sin;
    return middle * at.cos - std::sqrt(arc * arc - across * across);
}

/// Two flutes with an arc as cross-section. The margin at the leading edge of a land has the full radius; the rest
/// of the land is a little lower. The tool cuts while it turns about +z, so the flute lies ahead of its land.
Grooves of_drill(const ToolOutline& outline, double widest, double helix) {
    constexpr double half_flute = 40.0_deg, wall = 0.5_deg;
    constexpr double margin = 10.0_deg, step = 11.5_deg, lowered = 0.965;
    constexpr double flutes_behind = 20.0, fade = 5.0;  // [–] of the radius [assumed]: long surgical drills

    Grooves grooves;
    grooves.widest = widest;

    // Radial walls bound a flute, so the lips are straight.
    constexpr int in_flute = 12, in_wall = 3, on_land = 6;
    const double edge = arc_floor(half_flute);
    for (int flute = 0; flute < 2; ++flute) {
        const double at = pi * flute;
        for (int i = 0; i <= in_flute; ++i) {
            const double off = half_flute * (2.0 * i / in_flute - 1.0);
            grooves.columns.push_back({at + off, 1.0, widest * arc_floor(off)});
        }
        for (int i = 1; i < in_wall; ++i) {
            const double t = static_cast<double>(i) / in_wall;
            grooves.columns.push_back({at + half_flute + wall * t, 1.0, widest * (edge + t * (lowered - edge))});
        }
        const double first = at + half_flute + wall, last = at + pi - half_flute - wall;
        for (int i = 0; i < on_land; ++i)
            grooves.columns.push_back({first + (last - step - first) * i / (on_land - 1), lowered});
        grooves.columns.push_back({last - margin, 1.0});
        grooves.columns.push_back({last, 1.0});
        for (int i = 1; i < in_wall; ++i) {
            const double t = static_cast<double>(i) / in_wall;
            grooves.columns.push_back({last + wall * t, 1.0, widest * (1.0 + t * (edge - 1.0))});
        }
    }

    const double tip = outline.profile.front().z,
                 cut = outline.profile[outline.cutting_first + outline.cutting_count - 1].z;
    const double behind = std::min(flutes_behind * widest, 0.6 * (tip - outline.profile.back().z) - (tip - cut));
    grooves.begin = tip;
    grooves.end = std::max(cut - std::max(behind, 0.0), end_of_body(outline, widest));
    grooves.fade_from = grooves.end + std::min(fade * widest, 0.5 * (tip - grooves.end));
    grooves.twist = twist_of(helix, widest, tip - grooves.end);
    return grooves;
}

/// Shallow spiral flutes. A blade has its edge ahead of its back.
Grooves of_burr(const ToolOutline& outline, double widest, std::size_t blades) {
    constexpr double depth = 0.2;       // [–] of the radius [assumed]
    constexpr double helix = 25.0_deg;  // [assumed]
    struct Place {
        double along, deep;  // [–] of a blade's pitch, of the depth
    };
    constexpr std::array<Place, 7> blade{
        {{0.0, 0.0}, {0.08, 0.85}, {0.2, 1.0}, {0.36, 0.86}, {0.52, 0.56}, {0.68, 0.28}, {0.84, 0.09}}};
    const std::size_t step = blades > 12 ? 2 : 1;  // many blades need fewer columns each

    Grooves grooves;
    for (std::size_t n = 0; n < blades; ++n)
        for (std::size_t i = 0; i < blade.size(); i += i < 1 ? 1 : step) {
            const double turn = (static_cast<double>(n) + blade[i].along) / static_cast<double>(blades);
            grooves.columns.push_back({2.0 * pi * turn, 1.0 - depth * blade[i].deep});
        }
    const double front = outline.profile[outline.cutting_first].z,
                 back = outline.profile[outline.cutting_first + outline.cutting_count - 1].z;
    grooves.begin = front;
    grooves.end = back;
    grooves.twist = twist_of(helix, widest, front - back);
    return grooves;
}

}  // namespace

double Grooves::radius_at(const GrooveColumn& column, double z, double radius) const noexcept {
    if (!is_drill()) return column.fraction * radius;
    const double faded = std::clamp((fade_from - z) / (fade_from - end), 0.0, 1.0);
    const double eased = faded * faded * (3.0 - 2.0 * faded);
    const double fraction = column.fraction + (1.0 - column.fraction) * eased;
    const double land = fraction < 1.0 ? fraction * widest : HUGE_VAL;
    const double floor = std::min(column.floor, widest);
    return std::min({radius, land, floor + eased * (widest - floor)});
}

Grooves no_grooves(std::size_t count) {
    Grooves grooves;
    for (std::size_t i = 0; i < count; ++i)
        grooves.columns.push_back({2.0 * pi * static_cast<double>(i) / static_cast<double>(count)});
    return grooves;
}

Grooves grooves_of(const Tool& tool) {
    const ToolOutline& outline = tool.outline;
    if (outline.cutting_count < 2 || outline.cutting.is_hollow() || !is_running(tool.setup))
        return no_grooves(max_columns);
    const double widest = outline.cutting.largest_radius();
    if (!(widest > 0.0)) return no_grooves(max_columns);
    if (const auto helix = parameter(tool.setup, "helix_angle", dimension::angle))
        return of_drill(outline, widest, std::clamp(*helix, 0.0, max_helix));
    constexpr double usual = 8.0, min = 2.0, max = 24.0;  // [–] blades
    const double blades = parameter(tool.setup, "blades", dimension::none).value_or(usual);
    return of_burr(outline, widest, static_cast<std::size_t>(std::clamp(blades, min, max)));
}

}  // namespace kerf::run
