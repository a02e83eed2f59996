// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "conformance/chart/awl_ways.h"

#include <algorithm>

#include "conformance/chart/pushed_awl.h"
#include "kerf/units.hpp"

namespace kerf::chart {

using namespace literals;

namespace {

/// A way of its own, so that what breaks at the entry is not seen.
AwlWay way_through(double towards_canal, double shell, std::string wall, std::string remark) {
    constexpr double from = 11.0_mm, to = 26.0_mm, step = 0.2_mm;
    const Scene scene = pedicle_awl_scene(towards_canal, shell);
    PushedAwl awl({}, scene);
    AwlWay way{.wall = std::move(wall), .remark = std::move(remark)};
    for (int n = 0; from + n * step <= to; ++n) way.pushes.push_back({from + n * step, awl.push_at(from + n * step)});
    return way;
}

}  // namespace

double AwlWay::most() const noexcept {
    double most = 0.0;
    for (const At& at : pushes) most = std::max(most, at.push);
    return most;
}

std::vector<AwlWay> awl_ways() {
    constexpr double towards_canal = aimed_wrong * 1.0_deg;
    return {way_through(0.0, 1.0_mm, "", ""),
            way_through(towards_canal, 1.0_mm, "the phantom's wall of 1 mm", "a wall breaks by the square of its thickness"),
            way_through(towards_canal, 0.8_mm, "0.8 mm, the medial wall of L3", "its mean in men; in women 0.9 mm [l3-pedicle-wall]"),
            way_through(towards_canal, 0.35_mm, "0.35 mm, a vertebra's shell", "[silva-1994]")};
}

}  // namespace kerf::chart
