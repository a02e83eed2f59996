// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/criterion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "studies/stability/finding.h"

namespace kerf::stability {

namespace {

constexpr double settling = 0.5, window = 0.1;  // [s]
constexpr double small_turn = 0.05;             // [N]

double peak_to_peak(std::span<const double> x) {
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    return *high - *low;
}

/// About the straight line of least squares.
double peak_to_peak_about_line(std::span<const double> x) {
    const double n = static_cast<double>(x.size()), middle = 0.5 * (n - 1.0);
    double mean = 0.0, slope = 0.0, square = 0.0;
    for (const double v : x) mean += v / n;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double at = static_cast<double>(i) - middle;
        slope += at * (x[i] - mean);
        square += at * at;
    }
    slope /= square;
    std::vector<double> rest(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) rest[i] = x[i] - slope * (static_cast<double>(i) - middle);
    return peak_to_peak(rest);
}

}  // namespace

void PortEnergy::add(double work, double ceiling) noexcept {
    energy_ = std::min(energy_ + work, ceiling);
    least_ = std::min(least_, energy_);
}

int max_turns(const std::vector<double>& force, double period) {
    // A turn counts once the force has come back by more than `small_turn` from its last extreme.
    std::vector<std::size_t> turns;
    double low = force.empty() ? 0.0 : force.front(), high = low;
    int way = 0;
    for (std::size_t i = 0; i < force.size(); ++i) {
        low = std::min(low, force[i]);
        high = std::max(high, force[i]);
        const bool falls = way >= 0 && high - force[i] > small_turn, rises = way <= 0 && force[i] - low > small_turn;
        if (!falls && !rises) continue;
        if (way != 0) turns.push_back(i);
        way = falls ? -1 : 1;
        low = high = force[i];
    }
    const auto length = static_cast<std::size_t>(std::lround(window / period));
    std::size_t most = 0, first = 0;
    for (std::size_t last = 0; last < turns.size(); ++last) {
        while (turns[last] - turns[first] >= length) ++first;
        most = std::max(most, last - first + 1);
    }
    return static_cast<int>(most);
}

Judged judge(const Trace& trace, double resolution, bool moves) {
    const auto from = static_cast<std::size_t>(std::lround(settling / trace.period));
    const auto length = static_cast<std::size_t>(std::lround(window / trace.period));
    const std::span<const double> held = std::span(trace.depth).subspan(std::min(from, trace.depth.size()));
    double size = 0.0;
    if (moves)
        for (std::size_t i = 0; i + length <= held.size(); i += length)
            size = std::max(size, peak_to_peak_about_line(held.subspan(i, length)));
    else if (!held.empty())
        size = peak_to_peak(held);
    const std::vector<double> late(trace.force.begin() + static_cast<std::ptrdiff_t>(trace.force.size() - held.size()),
                                   trace.force.end());
    return {size / resolution, max_turns(late, trace.period), trace.energy.least()};
}

std::string in_figures(const Judged& judged) {
    return figure(judged.counts, "counts") + ", " + std::to_string(judged.turns) + " turns, " +
           figure(1e3 * judged.min_energy, "mJ");
}

}  // namespace kerf::stability
