// SPDX-License-Identifier: Apache-2.0
#include "run/cues/cue_audit.h"

#include <algorithm>
#include <cmath>

namespace kerf::run {

namespace {

constexpr double min_bone_force = 0.05;     // [N] bone newtons: less is air
constexpr double cut_of_limits = 1e-3;      // [–] of the force, from which on it counts as saturated
constexpr double min_feed = 0.05e-3;        // [m/s] from which on a tool is fed
constexpr std::size_t min_ticks = 100;      // of a tissue, for a median
constexpr std::size_t ticks_before = 300;   // of a wall, whose largest force is what breaks through
constexpr double stretch_after = 1e-3;      // [m] beyond a wall in which the force falls
constexpr std::size_t median_of_peak = 20;  // ticks

double median(std::vector<float> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return static_cast<double>(*middle);
}

/// Returns the largest (or smallest) median of consecutive ticks.
template <class Better>
double best_median(const std::vector<float>& values, const Better& is_better) {
    double best = median(values);
    for (std::size_t i = 0; i + median_of_peak <= values.size(); i += median_of_peak) {
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(i);
        const double m = median({begin, begin + median_of_peak});
        if (is_better(m, best)) best = m;
    }
    return best;
}

}  // namespace

double noticeable_steps(double a, double b, double friction) noexcept {
    return std::abs(std::log(std::max(a, friction) / std::max(b, friction))) / std::log1p(just_noticeable);
}

CueAudit::CueAudit(const Scene& scene) : scene_(scene), densest_(0), steps_(scene.procedure.steps.size()) {
    const auto& materials = scene.body.materials;
    for (std::size_t m = 0; m < materials.size(); ++m)
        if (materials[m].density > materials[densest_].density) densest_ = m;
    for (OfStep& step : steps_) step.by_tissue.resize(materials.size());
}

void CueAudit::on_tick(const session::TickRow& row) {
    if (row.step < 0 || static_cast<std::size_t>(row.step) >= steps_.size()) return;
    OfStep& step = steps_[static_cast<std::size_t>(row.step)];
    const double force = length(linear(row.commanded));
    follow_wall(row, force, step);
    if (length(linear(row.modelled)) < min_bone_force) return;
    ++step.in_bone;
    step.below_friction += force < scene_.device->friction ? 1 : 0;
    step.saturated += length(linear(row.limited)) < (1.0 - cut_of_limits) * length(linear(row.coupled)) ? 1 : 0;
    if (row.tissue >= 0 && static_cast<std::size_t>(row.tissue) < step.by_tissue.size() && row.feed_rate > min_feed)
        step.by_tissue[static_cast<std::size_t>(row.tissue)].push_back(static_cast<float>(force));
}

/// Collects the force before the tip leaves the bone through its densest tissue, and after it.
void CueAudit::follow_wall(const session::TickRow& row, double force, OfStep& step) const {
    if (row.tissue == static_cast<std::int32_t>(densest_)) {
        if (!step.after_exit.empty()) step.before_exit.clear();  // another wall
        step.after_exit.clear();
        if (step.before_exit.size() == ticks_before) step.before_exit.erase(step.before_exit.begin());
        step.before_exit.push_back(static_cast<float>(force));
        step.wall_end = row.depth;
        return;
    }
    if (row.tissue >= 0) {
        step.before_exit.clear();
        step.after_exit.clear();
        return;
    }
    if (step.before_exit.size() < min_ticks || row.depth < step.wall_end) return;
    if (row.depth - step.wall_end <= stretch_after) {
        step.after_exit.push_back(static_cast<float>(force));
        return;
    }
    if (!step.after_exit.empty()) step.exit = exit_of(step);
    step.before_exit.clear();
    step.after_exit.clear();
}

std::optional<double> CueAudit::exit_of(const OfStep& step) const {
    const double before = best_median(step.before_exit, [](double a, double b) { return a > b; });
    const double after = best_median(step.after_exit, [](double a, double b) { return a < b; });
    return after < before ? noticeable_steps(before, after, scene_.device->friction) : 0.0;
}

std::optional<double> CueAudit::contrast_of(const OfStep& step) const {
    if (step.by_tissue[densest_].size() < min_ticks) return std::nullopt;
    const auto& materials = scene_.body.materials;
    std::size_t next = materials.size();
    for (std::size_t m = 0; m < materials.size(); ++m)
        if (m != densest_ && step.by_tissue[m].size() >= min_ticks &&
            (next == materials.size() || materials[m].density > materials[next].density))
            next = m;
    if (next == materials.size()) return std::nullopt;
    return noticeable_steps(median(step.by_tissue[densest_]), median(step.by_tissue[next]), scene_.device->friction);
}

std::vector<StepCues> CueAudit::cues() const {
    std::vector<StepCues> all;
    for (std::size_t s = 0; s < steps_.size(); ++s) {
        const OfStep& step = steps_[s];
        if (step.in_bone == 0) continue;
        const auto ticks = static_cast<double>(step.in_bone);
        all.push_back({.step = scene_.procedure.steps[s].id,
                       .time_in_bone = ticks * Simulation::dt,
                       .below_friction = static_cast<double>(step.below_friction) / ticks,
                       .saturated = static_cast<double>(step.saturated) / ticks,
                       .contrast = contrast_of(step),
                       .exit = step.exit});
    }
    return all;
}

}  // namespace kerf::run
