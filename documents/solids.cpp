// SPDX-License-Identifier: Apache-2.0
#include "documents/solids.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "core/field/grid/box_distance.h"
#include "documents/superquadric.h"

namespace kerf::documents {

namespace {

template <class... F>
struct Overloaded : F... {
    using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;  // clang needs to be told before its version 17

/// Distance of a cylinder cut flat: `side` to its wall, `end` to the nearer cap, both signed.
double capped(double side, double end) noexcept {
    const double out_side = std::max(side, 0.0), out_end = std::max(end, 0.0);
    return std::min(std::max(side, end), 0.0) + std::sqrt(out_side * out_side + out_end * out_end);
}

struct Along {
    Vec3 axis;      ///< unit
    double length;  ///< [m]
    double at;      ///< of the point along the axis, from `from` [m]
    Vec3 across;    ///< from the axis to the point [m]
};
Along along(Vec3 from, Vec3 to, Vec3 p) noexcept {
    const Vec3 axis = normalized(to - from);
    const double at = dot(p - from, axis);
    return {axis, length(to - from), at, p - from - at * axis};
}

}  // namespace

SuperellipsoidAxes axes_of(const SuperellipsoidSolid& solid) noexcept {
    const Vec3 z = normalized(solid.along), y = normalized(solid.up - dot(solid.up, z) * z);
    return {cross(y, z), y, z, {0.5 * solid.width, 0.5 * solid.height, 0.5 * solid.length}};
}

double distance_to(const Solid& solid, Vec3 p, double limit) noexcept {
    return std::visit(
        Overloaded{[&](const BoxSolid& box) {
                       const Vec3 d = p - box.centre;
                       const Vec3 q{std::abs(d.x) - 0.5 * box.size.x, std::abs(d.y) - 0.5 * box.size.y,
                                    std::abs(d.z) - 0.5 * box.size.z};
                       return length(Vec3{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)}) +
                              std::min(std::max({q.x, q.y, q.z}), 0.0);
                   },
                   [&](const TubeSolid& tube) {
                       const Along a = along(tube.from, tube.to, p);
                       return capped(length(a.across) - tube.radius, std::abs(a.at - 0.5 * a.length) - 0.5 * a.length);
                   },
                   [&](const EllipticTubeSolid& tube) {
                       const Along a = along(tube.from, tube.to, p);
                       const Vec3 up = normalized(tube.up - dot(tube.up, a.axis) * a.axis);
                       const Vec3 side = cross(up, a.axis);
                       const double x = dot(a.across, side), y = dot(a.across, up);
                       const double rx = 0.5 * tube.width, ry = 0.5 * tube.height;
                       // k0 (k0 − 1) / k1: first order exact at the wall, never steeper than 1.
                       const double k0 = std::sqrt(x * x / (rx * rx) + y * y / (ry * ry));
                       const double k1 = std::sqrt(x * x / (rx * rx * rx * rx) + y * y / (ry * ry * ry * ry));
                       const double wall = k1 > 0.0 ? k0 * (k0 - 1.0) / k1 : -std::min(rx, ry);
                       return capped(std::max(wall, -std::min(rx, ry)),
                                     std::abs(a.at - 0.5 * a.length) - 0.5 * a.length);
                   },
                   [&](const SphereSolid& sphere) { return length(p - sphere.centre) - sphere.radius; },
                   [&](const SuperellipsoidSolid& body) {
                       const SuperellipsoidAxes of = axes_of(body);
                       const Vec3 d = p - body.centre, local{dot(d, of.side), dot(d, of.up), dot(d, of.along)};
                       return nearest_on(Superellipsoid{of.half, body.exponent}, local, limit).distance;
                   },
                   [&](const LoftSolid& loft) { return distance_to(loft, p, limit); }},
        solid);
}

double united(double a, double b, double radius) noexcept {
    const double nearer = std::min(a, b);
    if (radius <= 0.0 || std::max(a, b) >= radius) return nearer;
    const double fillet = std::max(radius, nearer) - std::hypot(std::max(radius - a, 0.0), std::max(radius - b, 0.0));
    const double largest_gain = (std::sqrt(2.0) - 1.0) * radius;  // where both surfaces meet at a right angle
    return std::max(fillet, nearer - largest_gain);
}

double joined_with(double so_far, const PhantomPart& part, Vec3 p, double limit) noexcept {
    const double one = distance_to(part.solid, p, limit);
    return part.subtract ? -united(-so_far, one, part.blend) : united(so_far, one, part.blend);
}

double distance_to_any(const std::vector<Solid>& solids, Vec3 p) noexcept {
    double d = HUGE_VAL;
    for (const auto& solid : solids) d = std::min(d, distance_to(solid, p));
    return d;
}

namespace {

/// Returns a value of a tissue at a point: those of its regions over the one that it has elsewhere.
double value_at(const Tissue& tissue, double elsewhere, double TissueRegion::*own, Vec3 p) noexcept {
    double value = 0.0, left = 1.0;  // weight of everything behind
    for (const TissueRegion& region : tissue.regions) {
        if (region.*own <= 0.0) continue;
        double far = HUGE_VAL;
        for (const Solid& solid : region.solids)
            if (kerf::distance_to(bounds_of(solid), p) < region.over)
                far = std::min(far, distance_to(solid, p, region.over));
        const double near = std::clamp(1.0 - far / region.over, 0.0, 1.0), weight = near * near * (3.0 - 2.0 * near);
        value += left * weight * region.*own;
        left *= 1.0 - weight;
        if (left <= 0.0) break;
    }
    return value + left * elsewhere;
}

}  // namespace

double thickness_at(const Tissue& tissue, Vec3 p) noexcept {
    return value_at(tissue, tissue.thickness, &TissueRegion::thickness, p);
}

double thinnest(const Tissue& tissue) noexcept {
    double min = tissue.thickness;
    for (const TissueRegion& region : tissue.regions)
        if (region.thickness > 0.0) min = std::min(min, region.thickness);
    return min;
}

double thickest(const Tissue& tissue) noexcept {
    double max = tissue.thickness;
    for (const TissueRegion& region : tissue.regions) max = std::max(max, region.thickness);
    return max;
}

double density_at(const Tissue& tissue, Vec3 p) noexcept {
    return value_at(tissue, tissue.density, &TissueRegion::density, p);
}

double distance_to(const Tissue& tissue, double depth, Vec3 p) noexcept {
    const double in_shell = tissue.thickness > 0.0 ? depth - thickness_at(tissue, p) : -HUGE_VAL;
    return tissue.solids.empty() ? in_shell : std::max(in_shell, distance_to_any(tissue.solids, p));
}

double distance_to(const PhantomSource& phantom, Vec3 p) noexcept {
    double d = HUGE_VAL;
    for (const auto& part : phantom.parts) d = joined_with(d, part, p);
    return d;
}

Box bounds_of(const Solid& solid) noexcept {
    const auto tube = [](Vec3 from, Vec3 to, double r) {
        return Box{{std::min(from.x, to.x) - r, std::min(from.y, to.y) - r, std::min(from.z, to.z) - r},
                   {std::max(from.x, to.x) + r, std::max(from.y, to.y) + r, std::max(from.z, to.z) + r}};
    };
    return std::visit(
        Overloaded{[](const BoxSolid& box) {
                       return Box{box.centre - 0.5 * box.size, box.centre + 0.5 * box.size};
                   },
                   [&](const TubeSolid& t) { return tube(t.from, t.to, t.radius); },
                   [&](const EllipticTubeSolid& t) { return tube(t.from, t.to, 0.5 * std::max(t.width, t.height)); },
                   [&](const SphereSolid& s) { return tube(s.centre, s.centre, s.radius); },
                   [](const SuperellipsoidSolid& body) {
                       const SuperellipsoidAxes of = axes_of(body);
                       const auto reach = [&](double x, double y, double z) {
                           return std::abs(x) * of.half.x + std::abs(y) * of.half.y + std::abs(z) * of.half.z;
                       };
                       const Vec3 r{reach(of.side.x, of.up.x, of.along.x), reach(of.side.y, of.up.y, of.along.y),
                                    reach(of.side.z, of.up.z, of.along.z)};
                       return Box{body.centre - r, body.centre + r};
                   },
                   [](const LoftSolid& loft) { return loft.bounds; }},
        solid);
}

Box bounds_of(const std::vector<Solid>& solids) noexcept {
    Box all{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    for (const Solid& solid : solids) {
        const Box one = bounds_of(solid);
        all.low = {std::min(all.low.x, one.low.x), std::min(all.low.y, one.low.y), std::min(all.low.z, one.low.z)};
        all.high = {std::max(all.high.x, one.high.x), std::max(all.high.y, one.high.y),
                    std::max(all.high.z, one.high.z)};
    }
    return all;
}

}  // namespace kerf::documents
