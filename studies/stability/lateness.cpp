// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/lateness.h"

#include <algorithm>
#include <array>

namespace kerf::stability {

namespace {

struct Bin {
    double up_to;  ///< [s]
    int ticks;
};
constexpr std::array<Bin, 14> measured{{{1e-6, 127285},
                                        {2e-6, 281},
                                        {5e-6, 456},
                                        {10e-6, 478},
                                        {20e-6, 822},
                                        {50e-6, 961},
                                        {100e-6, 80},
                                        {200e-6, 82},
                                        {500e-6, 44},
                                        {1e-3, 15},
                                        {2e-3, 70},
                                        {5e-3, 12},
                                        {10e-3, 7},
                                        {20e-3, 2}}};
constexpr int ticks_measured = [] {
    int sum = 0;
    for (const Bin& bin : measured) sum += bin.ticks;
    return sum;
}();
static_assert(ticks_measured == 130595);

/// Returns the lateness [s] that a part of the measured ticks does not exceed.
double quantile(double part) noexcept {
    double ticks = part * ticks_measured, from = 0.0;
    for (const Bin& bin : measured) {
        if (ticks < bin.ticks) return from + ticks / bin.ticks * (bin.up_to - from);
        ticks -= bin.ticks;
        from = bin.up_to;
    }
    return from;
}

}  // namespace

double Lateness::draw() noexcept {
    state_ = state_ * 1664525u + 1013904223u;
    return state_ * 0x1p-32;
}

double Lateness::next(double limit) noexcept {
    constexpr int draws = 10;
    double largest = 0.0;
    for (int i = 0; i < draws; ++i) largest = std::max(largest, draw());
    const double late = quantile(largest);
    return late < limit ? late : next(limit);
}

}  // namespace kerf::stability
