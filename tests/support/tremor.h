// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "kerf/units.hpp"

namespace kerf::test {

/// How a hand shakes along one axis, at up to 1 mm/s [m]: physiological tremor, 8 … 12 Hz, three tones of a third of
/// the speed each.
/// @param phase  another one for every axis
inline double tremor(double time, double phase) {
    using namespace literals;
    double at = 0.0;
    for (const double hz : {8.0, 9.7, 11.9})
        at += 1.0_mm_per_s / 3.0 / (2.0 * pi * hz) * std::sin(2.0 * pi * hz * time + phase * hz);
    return at;
}

}  // namespace kerf::test
