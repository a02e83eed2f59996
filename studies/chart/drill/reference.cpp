// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/drill/reference.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kerf/units.hpp"
#include "studies/chart/along_edge.h"

namespace kerf::chart {

namespace {

constexpr int looks = 64;  // along an edge

}  // namespace

Engaged exactly_engaged(const ExactBone& bone, const Drill& drill, const CuttingLaw& law, const Pose& body_from_tool,
                        double angle) {
    Engaged engaged;
    for (int edge = 0; edge < edge_count; ++edge) {
        const Span span = span_of(drill, edge);
        const auto tissue = [&](double s) {
            return bone.tissue_at(body_from_tool * place_on_edge(drill, edge, s, angle));
        };
        auto& stretches = engaged[static_cast<std::size_t>(edge)];
        for_stretches(span.from, span.to, looks, tissue, [&](double from, double to, int in) {
            stretches.push_back({from, to, law.resistance(bone.tissues[static_cast<std::size_t>(in)].density)});
        });
    }
    return engaged;
}

Vec6 ExactForce::wrench(const Pose& body_from_tool, double rate, double angle) {
    const double from = dot(body_from_tool.position - scene_->entry, scene_->along), to = from + rate * dt;
    advance_ = to - std::max(from, deepest_);
    deepest_ = std::max(deepest_, to);
    const double per_lip = advance_ / (dt * 2.0 * scene_->spindle);
    if (!(per_lip > 0.0)) return {};
    return edge_wrench(scene_->drill, *law_, exactly_engaged(scene_->bone, scene_->drill, *law_, body_from_tool, angle),
                       angle, per_lip);
}

bool ExactForce::is_within_relief() const noexcept {
    const double most = 2.0 * pi * scene_->drill.radius() * std::tan(law_->relief);
    return advance_ / (dt * scene_->spindle) <= most;
}

namespace {

/// Bone within the drill that stands at `deepest`, by `around` rays' worth of pieces.
double volume_in_drill(const Scene& scene, double deepest, int fineness) {
    const double radius = scene.drill.radius(), cot_p = scene.drill.point_depth() / radius;
    const Pose from_tool = scene.pose_at(deepest);
    const double length = deepest - scene.depth.front() + 2e-3;
    const int rings = fineness, around = 4 * fineness, along = 8 * fineness;
    // Along the shaft the bone's ends are found by bisection: then only the cross-section is sampled.
    double volume = 0.0;
    for (int i = 0; i < rings; ++i) {
        const double r = (i + 0.5) * radius / rings, area = 2.0 * pi * r * (radius / rings) / around;
        for (int k = 0; k < around; ++k) {
            const double a = 2.0 * pi * (k + 0.5) / around;
            const auto is_bone = [&](double z) {
                return scene.bone.surface(from_tool * Vec3{r * std::cos(a), r * std::sin(a), z}) < 0.0;
            };
            const double end = -r * cot_p, begin = -length;
            double last = begin, in_since = begin;
            bool is_in = is_bone(begin);
            for (int j = 1; j <= along; ++j) {
                const double z = begin + (end - begin) * j / along;
                const bool now = is_bone(z);
                if (now != is_in) {
                    double inner = last, outer = z;
                    for (int b = 0; b < 30; ++b) {
                        const double middle = 0.5 * (inner + outer);
                        (is_bone(middle) == is_in ? inner : outer) = middle;
                    }
                    if (is_in) volume += area * (inner - in_since);
                    in_since = inner;
                    is_in = now;
                }
                last = z;
            }
            if (is_in) volume += area * (end - in_since);
        }
    }
    return volume;
}

}  // namespace

double exact_volume(const Scene& scene, double deepest, double* error) {
    constexpr int coarse = 12;
    const double a = volume_in_drill(scene, deepest, coarse), b = volume_in_drill(scene, deepest, 2 * coarse);
    if (error != nullptr) *error = std::abs(b - a) / 3.0;
    return b + (b - a) / 3.0;  // the midpoint rule errs with the square of the step
}

}  // namespace kerf::chart
