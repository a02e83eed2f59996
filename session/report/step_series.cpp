// SPDX-License-Identifier: Apache-2.0
#include "session/report/step_series.h"

namespace kerf::session {

std::vector<Stroke> strokes_of(std::span<const TickRow> rows, double reversal) {
    std::vector<Stroke> strokes;
    if (rows.empty()) return strokes;
    const auto depth = [&](std::size_t row) { return rows[row].depth; };
    double direction = 0.0;  // 1 inwards, −1 outwards, 0 until the first travel that is long enough
    std::size_t begin = 0, low = 0, high = 0, extreme = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        if (direction == 0.0) {
            low = depth(i) < depth(low) ? i : low;
            high = depth(i) > depth(high) ? i : high;
            direction = depth(i) - depth(low) > reversal ? 1.0 : depth(high) - depth(i) > reversal ? -1.0 : 0.0;
            extreme = i;
        } else if (direction * (depth(i) - depth(extreme)) >= 0.0) {
            extreme = i;
        } else if (direction * (depth(extreme) - depth(i)) > reversal) {
            strokes.push_back({begin, extreme, direction > 0.0});
            begin = extreme;
            extreme = i;
            direction = -direction;
        }
    }
    strokes.push_back({begin, rows.size() - 1, direction >= 0.0});
    return strokes;
}

std::vector<StepSeries> series_by_step(std::span<const TickRow> rows) {
    std::vector<StepSeries> all;
    for (std::size_t begin = 0; begin < rows.size();) {
        std::size_t end = begin + 1;
        while (end < rows.size() && rows[end].step == rows[begin].step) ++end;
        if (rows[begin].step >= 0) {
            const std::size_t first = begin > 0 && begin + 1 < end ? begin + 1 : begin;
            const std::span<const TickRow> own = rows.subspan(first, end - first);
            all.push_back({static_cast<std::size_t>(rows[begin].step), first, own, strokes_of(own)});
        }
        begin = end;
    }
    return all;
}

bool was_reached(const RunSummary& summary, const DrawnRun& run, std::size_t index) {
    const StepRow& step = summary.steps[index];
    if (step.done || !step.broken_limits.empty()) return true;
    if (run.ticks() > 0) return run.has_met_bone(index);
    return step.end > step.start && (index == 0 || step.start > 0.0);  // only the first step begins at 0
}

std::string unreached_steps(const RunSummary& summary, const DrawnRun& run) {
    std::string titles;
    for (std::size_t i = 0; i < summary.steps.size(); ++i) {
        if (was_reached(summary, run, i)) continue;
        const StepRow& step = summary.steps[i];
        titles += (titles.empty() ? "" : ", ") + (step.title.empty() ? step.id : step.title);
    }
    return titles;
}

}  // namespace kerf::session
