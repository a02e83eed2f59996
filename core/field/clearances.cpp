// SPDX-License-Identifier: Apache-2.0
#include "core/field/clearances.h"

#include <algorithm>
#include <limits>

namespace kerf {

namespace {
constexpr double unknown = -std::numeric_limits<double>::infinity();
}

Clearances::Clearances(std::size_t most) : until_(most, unknown), soonest_((most + group - 1) / group, unknown), within_(most + 1) {}

void Clearances::begin(std::size_t count) noexcept {
    count_ = count;
    moved_ = 0.0;
    std::fill_n(until_.begin(), count, unknown);
    std::fill(soonest_.begin(), soonest_.end(), unknown);
}

std::span<const std::uint32_t> Clearances::within(double margin) noexcept {
    const double limit = moved_ + margin;
    std::size_t found = 0;
    for (std::size_t first = 0; first < count_; first += group) {
        double& soonest = soonest_[first / group];
        if (soonest >= limit) continue;
        double of_others = std::numeric_limits<double>::infinity();
        for (std::size_t i = first; i < std::min(count_, first + group); ++i) {  // without a branch: nobody could guess it
            const double until = until_[i];
            const bool is_within = until < limit;
            within_[found] = static_cast<std::uint32_t>(i);
            found += is_within ? 1 : 0;
            of_others = std::min(of_others, is_within ? std::numeric_limits<double>::infinity() : until);
        }
        soonest = of_others;
    }
    return {within_.data(), found};
}

void Clearances::note(std::uint32_t point, double clear) noexcept {
    until_[point] = moved_ + clear;
    double& soonest = soonest_[point / group];
    soonest = std::min(soonest, until_[point]);
}

}  // namespace kerf
