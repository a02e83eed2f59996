// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "kerf/math.hpp"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf {

/// Root of the mean square; 0 of nothing.   [any] pure.
[[nodiscard]] inline double rms(const std::vector<double>& all) noexcept {
    double sum = 0.0;
    for (const double v : all) sum += v * v;
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, all.size())));
}
/// The same of lengths.   [any] pure.
[[nodiscard]] inline double rms(const std::vector<Vec3>& all) noexcept {
    double sum = 0.0;
    for (const Vec3 v : all) sum += dot(v, v);
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, all.size())));
}

}  // namespace kerf
