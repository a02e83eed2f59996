// SPDX-License-Identifier: Apache-2.0
#include "drill_edges.h"

#include <algorithm>
#include <cmath>

namespace kerf::drilling {

namespace {
constexpr double fitted_helix = 28.0 * pi / 180.0;  // [rad] of the drill that the coefficients were fitted to [assumed]

/// Returns the unit vector from the axis to `p`, or zero on the axis.
Vec3 outwards(Vec3 p) noexcept {
    const double r = std::sqrt(p.x * p.x + p.y * p.y), per_metre = r > 0.0 ? 1.0 / r : 0.0;
    return {per_metre * p.x, per_metre * p.y, 0.0};
}
}  // namespace

EdgeLayout::EdgeLayout(const TwistDrill& drill, const DrillParameters& law, const BoneQuery& bone) noexcept
    : lip(make_lip(drill, law.element_pitch)) {
    double wall = 0.0, farthest = 0.0;  // [m] wall of the piece's cone, and the largest radius sampled on it
    for (std::size_t i = 0; i < lip.count; ++i) {
        const LipElement& el = lip.element[i];
        if (el.wall != wall) {
            wall = el.wall;
            farthest = wall - bone.wall_error(wall);
        }
        const double back = std::max(0.0, el.radius - farthest);
        sample_point[i] = {std::max(0.0, 1.0 - back / el.radius), el.z + back * el.normal_radial / el.normal_axial};
    }
    rake_factor.fill(1.0);
    if (drill.helix_angle != fitted_helix) {
        const SinCos helix = sin_cos_exact(drill.helix_angle), fitted = sin_cos_exact(fitted_helix);
        for (std::size_t i = 0; i < lip.count; ++i) {
            const double more =
                (drill.rake_at(lip.element[i].radius, helix) - drill.rake_at(lip.element[i].radius, fitted)) * 180.0 /
                pi;  // [deg]
            rake_factor[i] = std::max(0.2, 1.0 - law.rake_effect * more);
        }
    }
    const double pieces = std::ceil(drill.chisel_radius() / law.element_pitch);
    chisel_points = static_cast<std::size_t>(std::clamp(pieces, 2.0, static_cast<double>(max_chisel_points)));
    chisel_width = drill.chisel_radius() / static_cast<double>(chisel_points);
}

Edges::Edges(const TwistDrill& of, const EdgeLayout& at, const DrillParameters& law, const BoneQuery& bone,
             double angle) noexcept
    : drill(of), layout(at) {
    // A tip with runout circles in a hole that is wider by the runout, and the tool removes this shape. Both lips are
    // sampled on that shape, because each meets it within half a turn. `divide_feed` divides the feed between them.
    const auto put = [&](std::size_t i, std::size_t opposite, Vec3 place) {
        if (drill.runout > 0.0) place = place + drill.runout * outwards(place);
        point[i] = place;
        out[i] = outwards(place);
        point[opposite] = {-place.x, -place.y, place.z};
        out[opposite] = {-out[i].x, -out[i].y, 0.0};
    };
    const SinCos a = sin_cos_exact(angle), p = drill.half_point;
    const std::size_t per_lip = layout.lip.count;
    for (std::size_t i = 0; i < per_lip; ++i) {
        const Vec3 turned = position_of(layout.lip.element[i], drill.half_web(), a.cos, a.sin);
        const auto [kept, z] = layout.sample_point[i];
        put(i, per_lip + i, {kept * turned.x, kept * turned.y, z});
    }
    count = lip_points = lip_count * per_lip;
    for (std::size_t i = 0; i < layout.chisel_points; ++i, count += 2) {
        const double r = (static_cast<double>(i) + 0.5) * layout.chisel_width;
        put(count, count + 1, {-r * a.sin, r * a.cos, -r * p.cos / p.sin});
    }
    bone.sample({point.data(), count}, {0, 0, 1}, {sample.data(), count});
    for (std::size_t i = 0; i < count; ++i)
        resistance[i] = kerf::resistance(sample[i], bone.tissue_count(), law.reference_density);
}

void Edges::divide_feed(const Travel& travel, double n, double smallest, double edge_depth) noexcept {
    constexpr double slowest =
        10e-6;  // [m/s] smallest feed that sideways motion is compared with; without feed, chips are even [judgement]
    constexpr double largest = 2.0;  // limit for a drill that moves mostly sideways [judgement]
    const Vec6& going = travel.mean;
    const double along = going[2], feed = travel.feed_rate / n;
    const double per_feed = std::clamp(along / slowest, 0.0, 1.0) / std::max(along, slowest);
    const EvenChip even(feed / lip_count, edge_depth);
    const auto of_lip = lip_fractions(drill.lag_of_second_lip(), feed);
    for (std::size_t i = 0; i < count; ++i) {
        if (resistance[i] <= 0.0) continue;
        double fraction = 1.0;
        if (i < lip_points) {
            const LipElement& el = element(i);
            const Vec3 rate = linear(going) + cross(angular(going), point[i]);
            const double aside = el.normal_radial * dot(rate, out[i]) + el.normal_axial * (rate.z - along);
            fraction =
                std::clamp(of_lip[i < layout.lip.count ? 0 : 1] + aside * per_feed / el.normal_axial, 0.0, largest);
        }
        takes[i] = even.taken(fraction, sample[i].gap - smallest);
    }
}

EdgeForces edge_forces(const Edges& e, const DrillParameters& law, double n, double feed_rate) noexcept {
    const EdgeSet k = law.edges();
    const double per_lip = std::max(feed_rate, 1e-6) / (lip_count * n);  // feed per lip [m]
    std::array<double, largest_element_count> built_up;  // of an even chip for each element; the same on both lips
    for (std::size_t i = 0; i < e.layout.lip.count; ++i)
        built_up[i] = built_up_at(per_lip * e.layout.lip.element[i].normal_axial, k.thrust.edge_depth);
    const double on_chisel = built_up_at(per_lip, k.chisel.edge_depth);
    EdgeForces sum;
    for (std::size_t i = 0; i < e.count; ++i) {
        const double m = e.resistance[i];
        if (m <= 0.0) continue;
        const auto [chip, edge] = e.takes[i];
        if (chip <= 0.0) continue;
        const Vec3 at = e.point[i];
        if (i >= e.lip_points) {
            const double thrust =
                m * e.layout.chisel_width * force_per_width(chip * per_lip, k.chisel, edge * on_chisel);
            sum.normal[2] += thrust;
            sum.normal[3] += at.y * thrust;
            sum.normal[4] -= at.x * thrust;
            continue;
        }
        const std::size_t nth = e.index_on_lip(i);
        const LipElement& el = e.layout.lip.element[nth];
        const double thickness = chip * per_lip * el.normal_axial;
        const double width = e.layout.rake_factor[nth] * m * el.width;
        const double normal = width * force_per_width(thickness, k.thrust, edge * built_up[nth]);
        const double cutting = width * force_per_width(thickness, k.cutting, edge * built_up[nth]);
        // normal (n_r r̂ + n_z ẑ) on the bone and −cutting t̂ on the tool; t̂ = ẑ × r̂ is the cutting direction
        const Vec3 out = e.out[i];
        const double radial = normal * el.normal_radial, axial = normal * el.normal_axial;
        const double nx = radial * out.x, ny = radial * out.y, fx = cutting * out.y, fy = -cutting * out.x;
        sum.normal[0] += nx;
        sum.normal[1] += ny;
        sum.normal[2] += axial;
        sum.normal[3] += at.y * axial - at.z * ny;
        sum.normal[4] += at.z * nx - at.x * axial;
        sum.cutting[0] += fx;
        sum.cutting[1] += fy;
        sum.cutting[3] -= at.z * fy;
        sum.cutting[4] += at.z * fx;
        sum.cutting[5] -= cutting * el.radius;
    }
    return sum;
}

}  // namespace kerf::drilling
