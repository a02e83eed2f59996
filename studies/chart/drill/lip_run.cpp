// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/drill/lip_run.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/field/cut/removed_volume.h"
#include "kerf/units.hpp"
#include "studies/times.h"

namespace kerf::chart {

namespace {

constexpr std::size_t first_reserve = 512, free_margin = 128;  // bricks

ToolSolid outline_of(const Drill& drill) {
    const double tip = drill.point_depth(), land = 0.25 * drill.diameter;
    return ToolSolid({{0.0, 0.0}, {-tip, drill.radius()}, {-tip - land, drill.radius()}});
}

}  // namespace

LipRun::LipRun(const Scene& scene, const CuttingLaw& law, const Fineness& fineness)
    : scene_(scene),
      law_(law),
      nodes_(fineness.points),
      body_(body_of(scene.bone, fineness.spacing, fineness.offset)),
      solid_(outline_of(scene.drill)),
      committed_(body_, first_reserve),
      exact_(body_, first_reserve),
      tracker_(body_, solid_, committed_),
      pose_(scene.pose_at(scene.depth.front())),
      spindle_(scene.spindle) {
    for (const Material& material : body_.materials) resistance_.push_back(law.resistance(material.density));
    tracker_.restart(pose_);
}

LipRun::Node LipRun::sample_at(int edge, double s) const {
    const LocatedPoint place = locate(body_, pose_ * place_on_edge(scene_.drill, edge, s, angle_));
    Node node{s, std::max(body_.surface.at(place), committed_.at(place)), {}};
    for (std::size_t m = 0; m + 1 < body_.materials.size(); ++m) node.border[m] = body_.materials[m].border.at(place);
    return node;
}

Engaged LipRun::engaged() const {
    Engaged found;
    const std::size_t borders = body_.materials.size() - 1;
    for (int edge = 0; edge < edge_count; ++edge) {
        const Span span = span_of(scene_.drill, edge);
        const int pieces = std::max(1, (is_lip(edge) ? nodes_ : std::max(2, nodes_ / 4)) - 1);
        auto& stretches = found[static_cast<std::size_t>(edge)];
        Node last = sample_at(edge, span.from);
        for (int i = 1; i <= pieces; ++i) {
            const Node next = sample_at(edge, span.from + (span.to - span.from) * i / pieces);
            // Where surface and borders are crossed between two nodes, as shares of the way.
            double at[KERF_MAX_TISSUES + 2] = {0.0, 1.0};
            std::size_t count = 2;
            const auto cross_at = [&](double a, double b) {
                if ((a < 0.0) == (b < 0.0)) return;
                std::size_t k = count++;  // in order
                for (; k > 1 && at[k - 1] > a / (a - b); --k) at[k] = at[k - 1];
                at[k] = a / (a - b);
            };
            cross_at(last.surface, next.surface);
            for (std::size_t m = 0; m < borders; ++m) cross_at(last.border[m], next.border[m]);
            for (std::size_t k = 1; k < count; ++k) {
                const double middle = 0.5 * (at[k - 1] + at[k]);
                const auto between = [&](double a, double b) { return a + (b - a) * middle; };
                if (!(at[k] > at[k - 1]) || between(last.surface, next.surface) >= 0.0) continue;
                std::size_t m = 0;
                while (m < borders && between(last.border[m], next.border[m]) >= 0.0) ++m;
                const double from = last.s + (next.s - last.s) * at[k - 1], to = last.s + (next.s - last.s) * at[k];
                const bool extends_last =
                    !stretches.empty() && stretches.back().to == from && stretches.back().resistance == resistance_[m];
                if (extends_last)
                    stretches.back().to = to;
                else
                    stretches.push_back({from, to, resistance_[m]});
            }
            last = next;
        }
    }
    return found;
}

double LipRun::min_gap(const Engaged& engaged) const {
    const Vec3 along = rotate(pose_.rotation, {0, 0, 1});
    double least = 1e300;
    for (int edge = 0; edge < edge_count; ++edge)
        for (const Stretch& stretch : engaged[static_cast<std::size_t>(edge)]) {
            const Vec3 middle = place_on_edge(scene_.drill, edge, 0.5 * (stretch.from + stretch.to), angle_);
            least = std::min(least, tracker_.gap(pose_ * middle, along));
        }
    return least < 1e299 ? least : 0.0;
}

Vec6 LipRun::wrench(double rate, const Engaged& engaged, double gap) const {
    const double per_lip = (rate - gap / dt) / (2.0 * std::max(spindle_, 0.5));
    if (!(per_lip > 0.0) || spindle_ <= 0.0) return {};
    return edge_wrench(scene_.drill, law_, engaged, angle_, per_lip);
}

Felt LipRun::tick(const Pose& next) {
    Felt felt;
    felt.from = pose_;
    felt.rate = rate_between(pose_, next);
    int closed = 0;
    felt.cost = processor_time_of([&] {
        const Engaged found = engaged();
        const double gap = min_gap(found);
        felt.wrench = wrench(felt.rate[2], found, gap);
        pose_ = next;
        if (spindle_ > 0.0) {
            closed = tracker_.advance(pose_, tick_);
            tracker_.commit_passed(pose_, felt.wrench[2] < 0.0);
        } else {
            tracker_.restart(pose_);
        }
    });
    for (int i = 0; i < closed; ++i)
        if (tracker_.closed(i).removes) exact_.stamp(tracker_.closed(i), solid_);
    exact_.reserve(free_margin);
    committed_.reserve(free_margin);
    angle_ = std::fmod(angle_ + 2.0 * pi * spindle_ * dt, 2.0 * pi);
    ++tick_;
    return felt;
}

double LipRun::removed_volume() {
    const int closed = tracker_.close(tick_);
    for (int i = 0; i < closed; ++i)
        if (tracker_.closed(i).removes) exact_.stamp(tracker_.closed(i), solid_);
    RemovedVolume volume(body_);
    volume.update(exact_);
    return volume.total();
}

}  // namespace kerf::chart
