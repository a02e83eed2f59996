// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/mandible.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "bone/measure/angle.h"
#include "bone/measure/propagate.h"
#include "bone/measure/tangent.h"

namespace kerf::bone {
namespace {

// Inputs: the coordinates of condylion, gonion and menton, and the contacts of the two tangents.
constexpr std::size_t coordinates = 9, inputs = coordinates + 4;

/// A border whose surface points are gathered once, with a margin for shifts of its ends.
class Border {
public:
    Border(const MeasuredSurface& surface, Vec3 from, Vec3 to, double within, double margin)
        : points_(surface.points_in({{from, to}, within + margin})),
          within_(within),
          play_(2.0 * surface.wall_uncertainty()) {}

    [[nodiscard]] std::optional<Tangent> tangent(Vec3 from, Vec3 to, const BorderView& view,
                                                 std::span<const double, 2> contacts) const {
        return tangent_of(points_, {{from, to}, within_}, view, play_, contacts);
    }

private:
    std::vector<Vec3> points_;
    double within_, play_;
};

Vec3 shifted(const KnownPoint& point, std::span<const double> shifts) {
    return point.at + Vec3{shifts[0], shifts[1], shifts[2]};
}

Vec3 direction(std::span<const double, 3> components) {
    return normalized(Vec3{components[0], components[1], components[2]});
}

std::array<double, inputs> uncertainties(const MeasuredSurface& surface, const MandibleSide& side) {
    std::array<double, inputs> all{};
    const std::array<const KnownPoint*, 3> points{&side.condylion, &side.gonion, &side.menton};
    for (std::size_t i = 0; i < coordinates; ++i) all[i] = standard_uncertainty_of(points[i / 3]->tolerance);
    for (std::size_t i = coordinates; i < inputs; ++i) all[i] = surface.contact_uncertainty();
    return all;
}

double margin_for(const MandibleSide& side) {
    return 2.0 * std::max({side.condylion.tolerance, side.gonion.tolerance, side.menton.tolerance});
}

}  // namespace

std::optional<Measured> gonial_angle(const MeasuredSurface& surface, const MandibleSide& side,
                                     const SagittalView& view) {
    const double margin = margin_for(side);
    const Border ramus(surface, side.gonion.at, side.condylion.at, side.within, margin),
        body(surface, side.gonion.at, side.menton.at, side.within, margin);
    const auto traced_at = [&](std::span<const double> shifts) -> std::optional<TracedValue> {
        const Vec3 gonion = shifted(side.gonion, shifts.subspan(3, 3));
        const auto back = ramus.tangent(gonion, shifted(side.condylion, shifts.subspan(0, 3)),
                                        {view.normal, view.posterior}, shifts.subspan<coordinates, 2>());
        const auto lower = body.tangent(gonion, shifted(side.menton, shifts.subspan(6, 3)),
                                        {view.normal, view.inferior}, shifts.subspan<coordinates + 2, 2>());
        if (!back || !lower) return std::nullopt;
        const Vec3 u = back->line.direction, v = lower->line.direction;
        return TracedValue{angle_between(back->line, lower->line), {u.x, u.y, u.z, v.x, v.y, v.z}};
    };
    return propagate(uncertainties(surface, side), traced_at,
                     [](std::span<const double> operands) -> std::optional<double> {
                         return angle_between(Line{{}, direction(operands.subspan<0, 3>())},
                                              Line{{}, direction(operands.subspan<3, 3>())});
                     });
}

std::optional<Measured> mandibular_plane_angle(const MeasuredSurface& surface, const MandibleSide& side,
                                               const Plane& reference, const SagittalView& view) {
    const auto trace = projected_onto(Plane{side.gonion.at, view.normal}, reference);
    if (!trace) return std::nullopt;
    const Border body(surface, side.gonion.at, side.menton.at, side.within, margin_for(side));
    // A trace has no direction, so it counts as the plane perpendicular to the view.
    const Plane across{trace->point, normalized(cross(view.normal, trace->direction))};
    const auto traced_at = [&](std::span<const double> shifts) -> std::optional<TracedValue> {
        const auto lower =
            body.tangent(shifted(side.gonion, shifts.subspan(3, 3)), shifted(side.menton, shifts.subspan(6, 3)),
                         {view.normal, view.inferior}, shifts.subspan<coordinates + 2, 2>());
        if (!lower) return std::nullopt;
        const Vec3 v = lower->line.direction;
        return TracedValue{angle_between(lower->line, across), {v.x, v.y, v.z}};
    };
    return propagate(uncertainties(surface, side), traced_at,
                     [&](std::span<const double> operands) -> std::optional<double> {
                         return angle_between(Line{{}, direction(operands.subspan<0, 3>())}, across);
                     });
}

}  // namespace kerf::bone
