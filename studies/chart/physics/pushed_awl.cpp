// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/physics/pushed_awl.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "kerf/units.hpp"

namespace kerf::chart {

using namespace literals;

namespace {

constexpr double step = 0.1_mm;        // of a ray
constexpr double reach = 8.0 / 3.0;    // [radii] bone whose far side is farther has none near by
constexpr double free_way = 0.3_mm;    // so much air is a far side
constexpr double of_strongest = 0.5;   // what is weaker is not of the shell [judgement]
constexpr double max_askew = 0.2;      // cosine: what lies along the ray is not its far side [judgement]
constexpr double min_normal_z = -0.3;  // along the shaft: it is the side that the tip comes from [judgement]
constexpr double of_one_wall = 0.7;    // cosine between far sides of one wall [judgement]
constexpr double all_broken = 1.25, none_broken = 1.5;  // times what broke [judgement]

/// Between two places on a ray, one in what is asked for and one out of it.
template <typename Is>
double edge_of(double in, double out, Is is) {
    for (int halving = 0; halving < 8; ++halving) (is(0.5 * (in + out)) ? in : out) = 0.5 * (in + out);
    return 0.5 * (in + out);
}

bool is_one_wall(Vec3 normal, Vec3 other) noexcept { return dot(normal, other) >= of_one_wall; }

}  // namespace

Vec3 PushedAwl::place(int ring, int side) const noexcept {
    const double r = (ring + 0.5) * 0.5 * awl_.diameter / rings, angle = 2.0 * pi * (side + 0.5) / sides;
    return {r * std::cos(angle), r * std::sin(angle), -r / std::tan(0.5 * awl_.point_angle)};
}

double PushedAwl::strength_at(Vec3 body) const {
    const int tissue = scene_->bone.tissue_at(body);
    if (tissue < 0) return 0.0;
    const double grams_per_cm3 = 1e-3 * scene_->bone.tissues[static_cast<std::size_t>(tissue)].density;
    return 68e6 * grams_per_cm3 * grams_per_cm3;
}

std::optional<PushedAwl::Shell> PushedAwl::shell_on(Vec3 from, Vec3 along, const Pose& body_from_awl) const {
    const auto strength = [&](double way) { return strength_at(body_from_awl * (from + way * along)); };
    std::vector<double> on_way;
    double strongest = 0.0;
    std::size_t end = 0;  // of bone
    while (end == 0 || static_cast<double>(on_way.size() - end) * step < free_way) {
        if (static_cast<double>(on_way.size()) * step > reach * 0.5 * awl_.diameter) return std::nullopt;
        on_way.push_back(strength(static_cast<double>(on_way.size()) * step));
        strongest = std::max(strongest, on_way.back());
        if (on_way.back() > 0.0) end = on_way.size();
    }
    const auto is_strong = [&](double here) { return here >= of_strongest * strongest; };
    while (!is_strong(on_way[end - 1])) --end;
    std::size_t begin = end;
    double sum = 0.0;
    while (begin > 0 && is_strong(on_way[begin - 1])) sum += on_way[--begin];
    const auto at_step = [](std::size_t n) { return static_cast<double>(n) * step; };
    const auto is_in = [&](double way) { return is_strong(strength(way)); };
    const double far = edge_of(at_step(end - 1), at_step(end), is_in),
                 near = begin > 0 ? edge_of(at_step(begin), at_step(begin - 1), is_in) : 0.0;

    constexpr double beside = 20.0_um;
    const auto distance = [&](Vec3 at) { return scene_->bone.surface(body_from_awl * at); };
    const Vec3 at = from + far * along;
    Vec3 normal;
    for (std::size_t i = 0; i < 3; ++i) {
        Vec3 d{};
        (i == 0 ? d.x : i == 1 ? d.y : d.z) = beside;
        (i == 0 ? normal.x : i == 1 ? normal.y : normal.z) = distance(at + d) - distance(at - d);
    }
    normal = normalized(normal);
    const double upright = dot(normal, along);
    if (upright < max_askew || normal.z < min_normal_z)
        return std::nullopt;  // it lies along the ray; the tip comes from there
    const double c = std::clamp(normal.z, std::sin(0.5 * awl_.point_angle), 1.0), thick = (far - near) * upright;
    const double sigma = 133.0 / 193.0 * sum / static_cast<double>(end - begin), m = sigma * thick * thick / 6.0;
    return Shell{4.0 * pi * m * (c + awl_.friction * std::sqrt(1.0 - c * c)), near, normal};
}

std::optional<PushedAwl::Shell> PushedAwl::shell_before(int ring, int side, const Pose& body_from_awl) const {
    const Vec3 at = place(ring, side), out = normalized(Vec3{at.x, at.y, 0});
    const double p = 0.5 * awl_.point_angle;
    const auto ahead = shell_on(at, {0, 0, 1}, body_from_awl),
               along_normal = shell_on(at, std::cos(p) * out + Vec3{0, 0, std::sin(p)}, body_from_awl);
    if (!ahead || !along_normal) return ahead ? ahead : along_normal;
    return along_normal->load < ahead->load ? along_normal : ahead;
}

double PushedAwl::what_shells_bear(const std::array<Side, sides>& all) {
    std::array<double, sides> crushes{};  // [N] of what is not broken
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool is_broken = has_broken() && dot(all[i].shell.normal, broken_.normal) >= 0.0;
        const double share =
            is_broken
                ? std::clamp((all[i].shell.load / broken_.load - all_broken) / (none_broken - all_broken), 0.0, 1.0)
                : 1.0;
        crushes[i] = all[i].crushes > 0.0 ? share * all[i].crushes : 0.0;
    }
    double force = 0.0;
    Shell breaks;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (crushes[i] <= 0.0) continue;
        double of_wall = 0.0, breaking_load = 0.0, count = 0.0;
        for (std::size_t n = 0; n < all.size(); ++n) {
            if (crushes[n] <= 0.0 || !is_one_wall(all[n].shell.normal, all[i].shell.normal)) continue;
            of_wall += crushes[n];
            breaking_load += all[n].shell.load;
            count += 1.0;
        }
        breaking_load /= count;
        if (of_wall > breaking_load && all[i].shell.load > breaks.load) breaks = all[i].shell;
        force += crushes[i] * std::min(1.0, breaking_load / of_wall);
    }
    if (breaks.load > broken_.load) broken_ = breaks;
    return force;
}

double PushedAwl::push_at(double depth) {
    const double radius = 0.5 * awl_.diameter, wide = radius / rings,
                 rubs = 1.0 + awl_.friction / std::tan(0.5 * awl_.point_angle);
    const Pose body_from_awl = scene_->pose_at(depth);
    double force = 0.0;
    std::array<Side, sides> in_shell{};
    for (int side = 0; side < sides; ++side) {
        int asked = -1;
        std::optional<Shell> told;
        const auto shell_of = [&](int ring) {
            if (ring != asked) told = shell_before(ring, side, body_from_awl);
            asked = ring;
            return told;
        };
        for (int ring = 0; ring < rings; ++ring) {
            const double crushes =
                rubs * strength_at(body_from_awl * place(ring, side)) * 2.0 * pi * (ring + 0.5) * wide * wide / sides;
            if (crushes <= 0.0) continue;
            const auto shell = shell_of(ring);
            if (!shell || shell->before > step) {
                force += crushes;
                continue;
            }
            Side& one = in_shell[static_cast<std::size_t>(side)];
            one.crushes += crushes;
            one.shell = *shell;
            if (ring + 1 == rings) continue;
            // Before those that press it is no more as thick as it was: behind them it is.
            if (const auto whole = shell_of(ring + 1); whole && is_one_wall(whole->normal, shell->normal))
                one.shell = *whole;
        }
    }
    return force + what_shells_bear(in_shell);
}

}  // namespace kerf::chart
