// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf {

/// Returns the ranks 1 … n of values; equal ones have the mean of their ranks.   [any] pure
[[nodiscard]] inline std::vector<double> ranks_of(std::span<const double> values) {
    std::vector<double> ranks;
    ranks.reserve(values.size());
    for (const double one : values) {
        const auto less = std::count_if(values.begin(), values.end(), [&](double v) { return v < one; });
        const auto equal = std::count(values.begin(), values.end(), one);
        ranks.push_back(static_cast<double>(less) + 0.5 * static_cast<double>(equal + 1));
    }
    return ranks;
}

/// Returns Spearman's correlation: that of the ranks; not a number if one side has no order.   [any] pure
/// Pre: as many values on both sides.
[[nodiscard]] inline double rank_correlation(std::span<const double> a, std::span<const double> b) {
    const std::vector<double> x = ranks_of(a), y = ranks_of(b);
    const double mean = 0.5 * static_cast<double>(x.size() + 1);
    double xy = 0.0, xx = 0.0, yy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xy += (x[i] - mean) * (y[i] - mean);
        xx += (x[i] - mean) * (x[i] - mean);
        yy += (y[i] - mean) * (y[i] - mean);
    }
    return xy / std::sqrt(xx * yy);
}

}  // namespace kerf
