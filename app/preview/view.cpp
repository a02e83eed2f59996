// SPDX-License-Identifier: Apache-2.0
#include "app/preview/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/field/grid/body.h"
#include "documents/solids.h"
#include "text/palette.h"

namespace kerf::app {
namespace {

/// Red, green, blue, 0 … 1.
using Colour = Vec3;

constexpr Colour background{0.97, 0.975, 0.98}, zone_colour{0.86, 0.20, 0.16}, tool_colour{0.22, 0.42, 0.72},
    fragment_colour{0.80, 0.55, 0.25}, metal_colour{0.45, 0.47, 0.50}, air{0.10, 0.11, 0.13},
    border_line{1.0, 0.72, 0.15};

Colour mixed(Colour a, Colour b, double weight) { return a + weight * (b - a); }

void set(Picture& picture, int x, int y, Colour colour) {
    const std::size_t at =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
    const auto byte = [](double c) { return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(c, 0.0, 1.0))); };
    picture.rgb[at] = byte(colour.x);
    picture.rgb[at + 1] = byte(colour.y);
    picture.rgb[at + 2] = byte(colour.z);
}

Colour tissue_at(const Body& body, Vec3 p) {
    double weight[KERF_MAX_TISSUES];
    material_weights(body, locate(body, p), weight);
    Colour colour{};
    for (std::size_t m = 0; m < body.materials.size(); ++m) {
        const text::Colour own = text::tissue_colour(body.materials[m].id, m);
        colour = colour + weight[m] / 255.0 * Vec3{double(own.red), double(own.green), double(own.blue)};
    }
    return colour;
}

/// The part of a straight line that lies in a box [m along the line]; `end` < `begin`: none.
struct Stretch {
    double begin = 0.0, end = -1.0;
};
Stretch within(const Box& box, Vec3 from, Vec3 along) {
    Stretch stretch{-1e9, 1e9};
    const std::array<std::array<double, 4>, 3> axes{{{box.low.x, box.high.x, from.x, along.x},
                                                     {box.low.y, box.high.y, from.y, along.y},
                                                     {box.low.z, box.high.z, from.z, along.z}}};
    for (const auto& [low, high, at, step] : axes) {
        if (std::abs(step) < 1e-12) {
            if (at < low || at > high) return {};
            continue;
        }
        const double a = (low - at) / step, b = (high - at) / step;
        stretch.begin = std::max(stretch.begin, std::min(a, b));
        stretch.end = std::min(stretch.end, std::max(a, b));
    }
    return stretch;
}

/// Returns the box with samples of a body: its region, or else its grid.
Box known_box(const Body& body) {
    const Grid& grid = body.grid();
    const Vec3 low = grid.sample_position(0, 0, 0);
    const Vec3 size = brick_edge * grid.spacing *
                      Vec3{static_cast<double>(grid.bricks[0]), static_cast<double>(grid.bricks[1]),
                           static_cast<double>(grid.bricks[2])};
    if (body.region.is_bounded()) return {body.region.low, body.region.high};
    return {low, low + size};
}

double depth_at(const Body& body, Vec3 p) { return body.surface.at(locate(body, p)); }

/// Returns the first position [m along the line] at which `distance` is negative; `stretch.end` if there is none.
template <class DistanceAt>
double first_inside(const Stretch& stretch, double min_step, const DistanceAt& distance) {
    for (double at = stretch.begin; at < stretch.end;) {
        const double d = distance(at);
        if (d < 0.0) return at;
        at += std::max(0.9 * d, min_step);
    }
    return stretch.end;
}

Vec3 slope(const Body& body, Vec3 p, double h) {
    const auto along = [&](Vec3 axis) { return depth_at(body, p + h * axis) - depth_at(body, p - h * axis); };
    return normalized(Vec3{along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1})});
}

Colour shaded(Colour colour, Vec3 normal, Vec3 away) {
    const double facing = std::abs(dot(normal, away));
    return (0.35 + 0.65 * facing) * colour;
}

double zones_distance(const run::Scene& scene, Vec3 p) {
    double nearest = 1e9;
    for (const documents::Zone& zone : scene.anatomy.zones)
        nearest = std::min(nearest, documents::distance_to_any(zone.solids, p));
    return nearest;
}

/// A body of the scene other than the bone of the plan.
struct OtherBody {
    const Body* body;
    Pose body_from_world;
    Colour colour;
};

/// Returns the fragment at its present pose, and implants at their planned poses.
std::vector<OtherBody> other_bodies(const run::Scene& scene) {
    std::vector<OtherBody> things;
    if (scene.fragment) things.push_back({&*scene.fragment, inverse(scene.world_from_fragment), fragment_colour});
    for (std::size_t i = 0; i < scene.planned.size(); ++i)
        if (scene.planned[i]) things.push_back({&scene.implants[i], inverse(*scene.planned[i]), metal_colour});
    return things;
}

}  // namespace

const Body& planned_bone(const run::Scene& scene) noexcept { return scene.whole ? *scene.whole : scene.body; }

Picture from_outside(const View& view, const run::Scene& scene, const std::vector<Pose>& tools) {
    Picture picture(view.columns, view.rows);
    const Body& body = planned_bone(scene);
    const double h = body.grid().spacing;
    const Vec3 away = view.away();
    const Box box = known_box(body);
    const std::vector<OtherBody> others = other_bodies(scene);
    for (int y = 0; y < view.rows; ++y)
        for (int x = 0; x < view.columns; ++x) {
            const Vec3 from = view.point(x + 0.5, y + 0.5);
            const Stretch in_box = within(box, from, away);
            const double bone =
                first_inside(in_box, 0.25 * h, [&](double s) { return depth_at(body, from + s * away); });
            const bool is_bone = in_box.end > in_box.begin && bone < in_box.end;
            Colour colour = background;
            if (is_bone) {
                const Vec3 at = from + bone * away;
                // A face of the region shows the inside of the bone.
                const bool is_face = bone - in_box.begin < 0.5 * h && depth_at(body, at) < -0.25 * h;
                const Colour tissue = tissue_at(body, at + (is_face ? 0.5 : 0.1) * h * away);
                colour = is_face ? 0.92 * tissue : shaded(tissue, slope(body, at, h), away);
            }
            const auto lay_over = [&](double at, double end, Colour over) {
                if (at < end) colour = mixed(colour, over, !is_bone || at < bone ? 0.75 : 0.30);
            };
            for (const OtherBody& other : others) {
                const Vec3 start = other.body_from_world * from,
                           direction = rotate(other.body_from_world.rotation, away);
                const Stretch near = within(known_box(*other.body), start, direction);
                const auto distance = [&](double s) { return depth_at(*other.body, start + s * direction); };
                lay_over(first_inside(near, 0.25 * other.body->grid().spacing, distance), near.end, other.colour);
            }
            const Stretch around{-0.25, 0.25};
            const auto zone = [&](double s) { return zones_distance(scene, from + s * away); };
            if (!scene.anatomy.zones.empty()) lay_over(first_inside(around, 0.5 * h, zone), around.end, zone_colour);
            for (std::size_t step = 0; step < tools.size(); ++step) {
                const Pose tool_from_world = inverse(tools[step]);
                const auto distance = [&](double s) {
                    return scene.tool(step).outline.whole.distance(tool_from_world * (from + s * away));
                };
                const double at = first_inside(around, 0.25 * h, distance);
                lay_over(at, around.end, tool_colour);
            }
            set(picture, x, y, colour);
        }
    return picture;
}

Picture cut_through(const View& view, const run::Scene& scene) {
    Picture picture(view.columns, view.rows);
    const Body& body = planned_bone(scene);
    const auto& scan = scene.import.scan_value;
    for (int y = 0; y < view.rows; ++y)
        for (int x = 0; x < view.columns; ++x) {
            const Vec3 p = view.point(x + 0.5, y + 0.5);
            Colour colour = air;
            const double value = scan ? scan(p) : 0.0;
            if (scan && std::isfinite(value)) {
                const double grey = std::clamp((value + 300.0) / 1600.0, 0.0, 1.0);
                colour = {grey, grey, grey};
            }
            if (outside_region(body, p) == 0.0) {
                const double d = depth_at(body, p);
                if (d < 0.0) colour = mixed(colour, tissue_at(body, p), scan ? 0.35 : 1.0);
                if (std::abs(d) < 0.8 * view.pixel()) colour = border_line;
            } else if (!scan) {
                colour = 0.5 * air;
            }
            if (zones_distance(scene, p) < 0.0) colour = mixed(colour, zone_colour, 0.45);
            set(picture, x, y, colour);
        }
    return picture;
}

}  // namespace kerf::app
