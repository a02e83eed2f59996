// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <utility>
#include <vector>

/// How long something took, over many rounds.
namespace kerf {

struct Times {
    double mean, median, p999, longest;  ///< [µs]
};
/// Pre: not empty.
/// Returns the value below which this share of them lies. Pre: not empty.
inline double quantile_of(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}
inline Times times_of(std::vector<double> microseconds) {
    std::sort(microseconds.begin(), microseconds.end());
    const auto at = [&](double share) {
        return microseconds[static_cast<std::size_t>(share * static_cast<double>(microseconds.size() - 1))];
    };
    double sum = 0.0;
    for (const double t : microseconds) sum += t;
    return {sum / static_cast<double>(microseconds.size()), at(0.5), at(0.999), microseconds.back()};
}

/// [µs]
template <class Work>
double time_of(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

/// [µs] on the processor: what other programs take meanwhile is not counted. Asking costs about half a microsecond.
template <class Work>
double processor_time_of(const Work& work) {
    const auto now = [] {
        timespec t{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
        return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
    };
    const double start = now();
    work();
    return now() - start;
}

/// One of these clocks, less what it takes by itself: what it tells of nothing.
template <class TimeOf>
class NetTime {
public:
    explicit NetTime(TimeOf time) : time_(time) {
        std::vector<double> nothing;
        for (int n = 0; n < 10000; ++n) nothing.push_back(time_([] {}));
        asking_ = times_of(std::move(nothing)).median;
    }
    /// [µs]
    template <class Work>
    double operator()(const Work& work) const {
        return std::max(0.0, time_(work) - asking_);
    }
    [[nodiscard]] double asking() const noexcept { return asking_; }  ///< [µs]

private:
    TimeOf time_;
    double asking_ = 0.0;
};

}  // namespace kerf
