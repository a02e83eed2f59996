// SPDX-License-Identifier: Apache-2.0
#include "session/report/drawn_run.h"

#include <algorithm>

namespace kerf::session {

double lateral_force(const TickRow& row) noexcept {
    const Vec3 force = linear(row.modelled);
    const Vec3 shaft = normalized(rotate(row.world_from_tool.rotation, {0, 0, 1}));
    return length(force - dot(force, shaft) * shaft);
}

double sent_torque(const TickRow& row) noexcept {
    return dot(angular(row.commanded), rotate(row.device_from_handle.rotation, {0, 0, 1}));
}

// ---- ticks -------------------------------------------------------------------------------------------------------

Thinning::Thinning(std::uint64_t total, std::size_t most)
    : total_(total),
      stretches_(std::max<std::uint64_t>(1, (most - std::min<std::size_t>(most, 2)) / (2 * quantities))),
      is_whole_(total <= most) {
    stretch_end_ = total_ / stretches_;
}

void Thinning::add(const TickRow& row) {
    if (next_ == total_) return;
    const std::uint64_t index = next_++;
    if (is_whole_) return void(picked_.emplace_back(index, row));
    const std::array<double, quantities> values{row.thrust, row.torque, row.depth, lateral_force(row)};
    for (std::size_t q = 0; q < quantities; ++q) {
        if (minima_.size() < quantities) {
            minima_.push_back({index, values[q], row});
            maxima_.push_back({index, values[q], row});
            continue;
        }
        if (values[q] < minima_[q].value) minima_[q] = {index, values[q], row};
        if (values[q] > maxima_[q].value) maxima_[q] = {index, values[q], row};
    }
    if (index == 0) picked_.emplace_back(index, row);
    last_ = row;
    if (next_ != stretch_end_) return;
    end_stretch(picked_, next_ == total_);
    minima_.clear();
    maxima_.clear();
    ++stretch_;
    stretch_end_ = total_ * (stretch_ + 1) / stretches_;
}

void Thinning::end_stretch(Picked& picked, bool with_last) const {
    Picked added;
    for (const auto* extremes : {&minima_, &maxima_})
        for (const Extreme& extreme : *extremes) added.emplace_back(extreme.index, extreme.row);
    if (with_last) added.emplace_back(next_ - 1, last_);
    std::sort(added.begin(), added.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& one : added)
        if (picked.empty() || picked.back().first < one.first) picked.push_back(std::move(one));
}

std::vector<TickRow> Thinning::rows() const {
    Picked all = picked_;
    if (!minima_.empty()) end_stretch(all, true);  // fewer rows were added than expected
    std::vector<TickRow> rows;
    rows.reserve(all.size());
    for (const auto& [index, row] : all) rows.push_back(row);
    return rows;
}

// ---- a run -------------------------------------------------------------------------------------------------------

void DrawnRun::expect(std::uint64_t total) { plotted_ = Thinning(total, max_plotted); }

void DrawnRun::add(const TickRow& row) {
    plotted_.add(row);
    if (constexpr std::int32_t max_steps = 10'000; row.step >= 0 && row.step < max_steps) {
        const auto step = static_cast<std::size_t>(row.step);
        if (met_.size() <= step) met_.resize(step + 1, false);
        met_[step] = met_[step] || length(linear(row.modelled)) > 0.0;
    }
    ++ticks_;
    last_ = row;
    if (!deepest_ || deepest_->depth < row.depth) deepest_ = row;
}

void DrawnRun::add(EventRow event) {
    ++event_count_;
    if (events_.size() < max_events) events_.push_back(std::move(event));
}

}  // namespace kerf::session
