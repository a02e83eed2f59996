// SPDX-License-Identifier: Apache-2.0
#include "bone/image/acquisitions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace kerf::bone {
namespace {

/// Returns the groups in the order of their keys.
template <class KeyOf>
std::vector<Acquisition> grouped(const std::vector<DicomSlice>& slices, const KeyOf& key_of) {
    std::map<decltype(key_of(slices.front())), Acquisition> groups;
    const Vec3 normal = slices.front().normal();
    for (std::size_t n = 0; n < slices.size(); ++n) {
        Acquisition& group = groups[key_of(slices[n])];
        const double height = dot(slices[n].origin, normal);
        group.low = group.slices.empty() ? height : std::min(group.low, height);
        group.high = group.slices.empty() ? height : std::max(group.high, height);
        group.slices.push_back(n);
    }
    std::vector<Acquisition> all;
    for (auto& [key, group] : groups) all.push_back(std::move(group));
    return all;
}

void name(std::vector<Acquisition>& all, const std::vector<DicomSlice>& slices) {
    std::map<int, std::size_t> with_number, used;
    const auto number_of = [&](const Acquisition& one) { return slices[one.slices.front()].acquisition; };
    for (const Acquisition& one : all) ++with_number[number_of(one)];
    for (Acquisition& one : all) {
        const int number = number_of(one);
        const std::size_t n = used[number]++;
        one.name = number == 0 ? "" : std::to_string(number);
        if (number == 0 || with_number[number] > 1)
            one.name += n < 26 ? std::string(1, static_cast<char>('a' + n)) : "z" + std::to_string(n + 1);
    }
}

}  // namespace

std::vector<Acquisition> acquisitions_of(const std::vector<DicomSlice>& slices) {
    auto all = grouped(slices, [](const DicomSlice& s) { return std::tuple(s.acquisition, s.pass); });
    if (all.size() == 1) {
        auto by_time = grouped(slices, [](const DicomSlice& s) { return s.acquired_at; });
        const bool is_shared =
            std::all_of(by_time.begin(), by_time.end(), [](const Acquisition& a) { return a.slices.size() > 1; });
        if (is_shared && do_overlap(by_time)) all = std::move(by_time);
    }
    name(all, slices);
    return all;
}

bool do_overlap(const std::vector<Acquisition>& acquisitions) {
    constexpr double touching = 1e-6;  // [m]
    std::vector<const Acquisition*> sorted;
    for (const Acquisition& one : acquisitions) sorted.push_back(&one);
    std::sort(sorted.begin(), sorted.end(), [](const auto* a, const auto* b) { return a->low < b->low; });
    double reached = -HUGE_VAL;
    for (const Acquisition* one : sorted) {
        if (one->low <= reached + touching) return true;
        reached = std::max(reached, one->high);
    }
    return false;
}

}  // namespace kerf::bone
