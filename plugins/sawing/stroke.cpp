// SPDX-License-Identifier: Apache-2.0
#include "stroke.h"

#include <algorithm>

#include "kerf/exact_math.hpp"

namespace kerf::sawing {

namespace {

constexpr std::size_t step_count = 64;                  // in a quarter of the oscillation
constexpr std::size_t fast_steps = step_count * 3 / 4;  // without the quarter of them next to the turning point

constexpr std::array<double, step_count> cosines = [] {
    std::array<double, step_count> c{};
    for (std::size_t i = 0; i < step_count; ++i)
        c[i] = sin_cos_exact((static_cast<double>(i) + 0.5) / static_cast<double>(step_count) * 0.5 * pi).cos;
    return c;
}();

}  // namespace

double chip_per_feed(const Stroke& s, double cos_phase) noexcept {
    const double speed = pi * s.rate * s.length * (cos_phase < 0.0 ? -cos_phase : cos_phase);
    const double largest = 0.5 / s.rate;
    return s.pitch < largest * speed ? s.pitch / speed : largest;
}

std::array<StrokePart, part_count> parts_of(const Stroke& stroke) noexcept {
    double fast = 0.0, slow = 0.0;
    for (std::size_t i = 0; i < step_count; ++i) (i < fast_steps ? fast : slow) += chip_per_feed(stroke, cosines[i]);
    return {
        {{0.75, fast / static_cast<double>(fast_steps)}, {0.25, slow / static_cast<double>(step_count - fast_steps)}}};
}

double mean_chip_per_feed(const Stroke& stroke) noexcept {
    double mean = 0.0;
    for (const StrokePart& part : parts_of(stroke)) mean += part.time_fraction * part.chip_per_feed;
    return mean;
}

}  // namespace kerf::sawing
