// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/trial.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kerf/units.hpp"
#include "studies/drawing/svg.h"

namespace kerf::chart {

using namespace literals;
using drawing::figure;

namespace {

/// Mean force over the last millimetre of the way into the block [N].
double steady_force(const Trial& trial, double more_points) {
    const auto run = trial.start(more_points);
    double sum = 0.0, count = 0.0;
    for (std::size_t t = 0; t + 1 < trial.depth.size(); ++t) {
        const Felt one = run->tick(trial.pose_at(trial.depth[t + 1]));
        if (trial.depth[t] < trial.depth.back() - 1.0_mm) continue;
        sum += length(linear(one.wrench));
        count += 1.0;
    }
    return sum / count;
}

}  // namespace

Verdict with_more_points(const Trial& trial) {
    const double change = steady_force(trial, trial.more_points) / steady_force(trial, 1.0) - 1.0;
    return {std::abs(change) < 0.05,
            (trial.more_points > 1.0 ? "twice the points: " : "half the points: ") + figure(100.0 * change) + " %"};
}

Verdict back_in_the_hole(const Trial& trial) {
    constexpr double before = 0.05_mm;
    constexpr int longest = 20000;  // [ticks] of one way
    const auto run = trial.start(1.0);
    double hand = trial.depth.front(), tip = hand, deepest = hand, most = 0.0;
    bool is_back = true;
    const auto lead = [&](double rate, const auto& is_there, bool is_in_the_hole) {
        int ticks = 0;
        for (; ticks < longest && !is_there(); ++ticks) {
            hand += rate * dt;
            const Felt one = run->tick(trial.pose_at(hand));
            const double from = dot(one.from.position - trial.entry, trial.along);
            tip = from + one.rate[2] * dt;
            if (is_in_the_hole && std::max(from, tip) < deepest - before)
                most = std::max(most, length(linear(one.wrench)));
            deepest = std::max(deepest, tip);
        }
        is_back = is_back && ticks < longest;
    };
    lead(
        trial.feed, [&] { return tip >= trial.bottom; }, false);
    lead(
        -trial.back_speed, [&] { return tip <= trial.top; }, false);
    lead(
        trial.back_speed, [&] { return tip >= deepest - before; }, true);
    return {is_back && most < no_force,
            is_back ? "back in the hole: " + figure(most) + " N" : "never back in the hole"};
}

Still still_in_bone(const Trial& trial) {
    const auto run = trial.start(1.0);
    double turning = 0.0, last = 0.0;
    bool is_finite_always = true;
    const auto stand = [&](int ticks) {
        for (int i = 0; i < ticks; ++i) {
            const Felt one = run->tick(trial.pose_at(trial.depth.back()));
            is_finite_always = is_finite_always && is_finite(linear(one.wrench));
            last = length(linear(one.wrench));
        }
    };
    for (std::size_t t = 0; t + 1 < trial.depth.size(); ++t) (void)run->tick(trial.pose_at(trial.depth[t + 1]));
    stand(50);
    turning = last;
    run->command_spindle(0.0);
    stand(50);
    return {{turning < no_force, "standing, turning: " + figure(turning) + " N"},
            {is_finite_always, is_finite_always ? "" : "spindle off: not finite"}};
}

void Standing::add(const char* id, const Verdict& verdict) {
    if (!verdict.passes) fails.emplace_back(id);
    if (!verdict.told.empty()) told += (told.empty() ? "" : "; ") + std::string(id) + " " + verdict.told;
}

void Standing::add_trials(const Trial& trial, bool is_led_by_hand) {
    if (trial.more_points > 0.0) add("S-07", with_more_points(trial));
    add("S-12", back_in_the_hole(trial));
    const Still still = still_in_bone(trial);
    if (!is_led_by_hand) add("P9", still.on);
    add("S-19", still.off);
}

}  // namespace kerf::chart
