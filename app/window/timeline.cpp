// SPDX-License-Identifier: Apache-2.0
#include "app/window/timeline.h"

#include <algorithm>
#include <cmath>

namespace kerf::window {

void Timeline::take(run::ViewedRun& run, double passed) {
    run.take(newest_);
    run.take(moments_);
    drop_inspections();
    run.take(events_);
    run.take(radiographs_);
    take_rows(run);
    newest_surface_ = run.surface();
    if (is_following_ || moments_.empty()) return;
    const double end = moments_.back().state.time;
    if (is_playing_ && shown_time_ < end) shown_time_ = std::min(end, shown_time_ + speed_ * passed);
    if (newest_.is_over && shown_time_ >= end) is_playing_ = false;
    find_shown();
}

void Timeline::take_rows(run::ViewedRun& run) {
    constexpr float turn_step = 0.05f;  // [rad] between points of the torque plot
    const std::size_t before = rows_.size();
    run.take(rows_);
    for (std::size_t i = before; i < rows_.size(); ++i) {
        const run::ViewedRow& row = rows_[i];
        if (turns_.empty() || turns_.back().step != row.step ||
            std::abs(row.turned - turns_.back().turned) >= turn_step)
            turns_.push_back({row.time, row.turned, row.torque, row.step});
    }
}

/// Limits the memory of a long run.
void Timeline::drop_inspections() {
    for (; dropped_ + max_inspections < moments_.size(); ++dropped_) moments_[dropped_].inspection = nullptr;
}

// ---- the shown time -----------------------------------------------------------------------------------------------

void Timeline::show_at(double time) {
    is_following_ = false;
    shown_time_ = std::max(0.0, time);
    find_shown();
}

/// Finds the last moment up to the shown time.
void Timeline::find_shown() {
    const auto after = std::upper_bound(moments_.begin(), moments_.end(), shown_time_,
                                        [](double t, const run::ViewedMoment& m) { return t < m.state.time; });
    shown_ = after == moments_.begin() ? 0 : static_cast<std::size_t>(after - moments_.begin()) - 1;
}

void Timeline::step(int moments) {
    if (moments_.empty()) return;
    if (is_following_) shown_ = moments_.size() - 1;
    is_following_ = is_playing_ = false;
    const auto last = static_cast<std::ptrdiff_t>(moments_.size()) - 1;
    shown_ =
        static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(shown_) + moments, 0, last));
    shown_time_ = moments_[shown_].state.time;
}

void Timeline::play(bool plays) noexcept {
    is_playing_ = plays;
    if (!plays && is_following_) show_at(newest_.time);
}

void Timeline::change_speed(double factor) noexcept { speed_ = std::clamp(speed_ * factor, 0.125, 8.0); }

const run::ViewedState& Timeline::state() const noexcept {
    return is_following_ || moments_.empty() ? newest_ : moments_[shown_].state;
}

const std::shared_ptr<const run::ViewedSurface>& Timeline::surface() const noexcept {
    return is_following_ || moments_.empty() ? newest_surface_ : moments_[shown_].surface;
}

std::shared_ptr<const run::ViewedInspection> Timeline::inspection() const noexcept {
    if (moments_.empty()) return nullptr;
    return is_following_ ? moments_.back().inspection : moments_[shown_].inspection;
}

std::shared_ptr<const run::ViewedRadiograph> Timeline::radiograph() const noexcept {
    const std::size_t number = std::min<std::size_t>(state().shots, radiographs_.size());
    return number == 0 ? nullptr : radiographs_[number - 1];
}

// ---- plots --------------------------------------------------------------------------------------------------------

std::span<const run::ViewedRow> Timeline::recent() const {
    const double to = state().time;
    const auto is_before = [](const run::ViewedRow& row, double time) { return row.time < time; };
    const auto first = std::lower_bound(rows_.begin(), rows_.end(), to - plot_span, is_before);
    const auto last = std::lower_bound(first, rows_.end(), to + 1e-9, is_before);
    return {first, last};
}

std::span<const Timeline::Turn> Timeline::turns() const {
    const run::ViewedState& now = state();
    const auto is_before = [](const Turn& turn, double time) { return turn.time < time; };
    auto last = std::lower_bound(turns_.begin(), turns_.end(), now.time + 1e-9, is_before), first = last;
    while (first != turns_.begin() && std::prev(first)->step == now.step) --first;
    return {first, last};
}

void RealTimeFactor::show(double simulated, double wall) {
    constexpr double interval = 1.0;
    if (from_wall_ < 0.0 || simulated < from_simulated_) {
        from_wall_ = wall;
        from_simulated_ = simulated;
    } else if (wall - from_wall_ >= interval) {
        value_ = (simulated - from_simulated_) / (wall - from_wall_);
        from_wall_ = wall;
        from_simulated_ = simulated;
    }
}

}  // namespace kerf::window
