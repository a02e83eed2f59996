// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/drill/lip_integral.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "studies/chart/along_edge.h"

namespace kerf::chart {

namespace {

constexpr double sin_55 = 0.81915204428899180;

}  // namespace

double Drill::chisel_radius() const noexcept { return half_web() / sin_55; }
double Drill::point_depth() const noexcept { return radius() / std::tan(0.5 * point_angle); }

double CuttingLaw::resistance(double density) const noexcept {
    const double share = density / reference_density;
    return share * share;
}

double CuttingLaw::per_width(double t, const EdgeLaw& law) const noexcept {
    return t <= 0.0 ? 0.0 : law.edge * -std::expm1(-t / edge_depth) + law.chip * t;
}

std::optional<CuttingLaw> cutting_law_of(const std::vector<ParameterInfo>& force) {
    CuttingLaw law;
    bool is_whole = true;
    const auto take = [&](const char* id, double& value) {
        const auto at = std::find_if(force.begin(), force.end(), [&](const ParameterInfo& p) { return p.id == id; });
        if (at == force.end())
            is_whole = false;
        else
            value = at->def;
    };
    take("thrust_edge", law.thrust.edge);
    take("thrust_chip", law.thrust.chip);
    take("cutting_edge", law.cutting.edge);
    take("cutting_chip", law.cutting.chip);
    take("chisel_edge", law.chisel.edge);
    take("chisel_chip", law.chisel.chip);
    take("edge_depth", law.edge_depth);
    take("reference_density", law.reference_density);
    take("relief_angle", law.relief);
    if (!is_whole) return std::nullopt;
    return law;
}

Span span_of(const Drill& drill, int edge) noexcept {
    const double b = drill.half_web(), r_c = drill.chisel_radius(), r = drill.radius();
    if (is_lip(edge)) return {std::sqrt(r_c * r_c - b * b), std::sqrt(r * r - b * b)};
    return {0.0, r_c};
}

Vec3 place_on_edge(const Drill& drill, int edge, double s, double angle) noexcept {
    const double cot_p = 1.0 / std::tan(0.5 * drill.point_angle), side = edge % 2 == 0 ? 1.0 : -1.0;
    const double c = side * std::cos(angle), sn = side * std::sin(angle);
    if (!is_lip(edge)) return {-s * sn, s * c, -s * cot_p};
    const double b = drill.half_web();
    return {s * c - b * sn, s * sn + b * c, -std::sqrt(s * s + b * b) * cot_p};
}

Vec6 edge_wrench(const Drill& drill, const CuttingLaw& law, const Engaged& engaged, double angle,
                 double per_lip) noexcept {
    Vec3 force{0, 0, 0}, torque{0, 0, 0};
    const double sin_p = std::sin(0.5 * drill.point_angle), cos_p = std::cos(0.5 * drill.point_angle);
    const double b = drill.half_web();
    const auto add = [&](int edge, double s, double ds, double m) {
        const Vec3 at = place_on_edge(drill, edge, s, angle);
        Vec3 f{0, 0, 0};
        if (is_lip(edge)) {
            const double r = std::sqrt(s * s + b * b), cos_beta = s / r;
            const double cos_i = std::sqrt(cos_p * cos_p + sin_p * sin_p * cos_beta * cos_beta);
            const double n_z = sin_p * cos_beta / cos_i, n_r = cos_p / cos_i, width = m * ds * cos_i / sin_p;
            const double t = per_lip * n_z;
            const double normal = width * law.per_width(t, law.thrust), cutting = width * law.per_width(t, law.cutting);
            const Vec3 outwards{at.x / r, at.y / r, 0.0}, running{-at.y / r, at.x / r, 0.0};
            f = -cutting * running - normal * (n_r * outwards + n_z * Vec3{0, 0, 1});
        } else {
            f = {0, 0, -m * ds * law.per_width(per_lip, law.chisel)};
        }
        force = force + f;
        torque = torque + cross(at, f);
    };
    for (int edge = 0; edge < edge_count; ++edge)
        for (const Stretch& stretch : engaged[static_cast<std::size_t>(edge)])
            for_gauss_points(stretch.from, stretch.to,
                             [&](double at, double ds) { add(edge, at, ds, stretch.resistance); });
    return make_vec6(force, torque);
}

Engaged wholly_engaged(const Drill& drill) {
    Engaged engaged;
    for (int edge = 0; edge < edge_count; ++edge) {
        const Span span = span_of(drill, edge);
        engaged[static_cast<std::size_t>(edge)].push_back({span.from, span.to, 1.0});
    }
    return engaged;
}

}  // namespace kerf::chart
