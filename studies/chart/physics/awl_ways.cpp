// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/physics/awl_ways.h"

#include <algorithm>

#include "kerf/units.hpp"
#include "studies/chart/physics/pushed_awl.h"

namespace kerf::chart {

using namespace literals;

namespace {

/// A way of its own, so that what breaks at the entry is not seen.
AwlWay way_through(const PedicleWall* wall) {
    constexpr double from = 11.0_mm, to = 26.0_mm, step = 0.2_mm;  // before it goes on into the body
    const Scene scene =
        wall == nullptr ? pedicle_awl_scene({})
                        : pedicle_awl_scene({.towards_canal = (wall->is_medial ? 1.0 : -1.0) * aimed_wrong * 1.0_deg,
                                             .shell = wall->thickness,
                                             .bone = wall->bone()});
    PushedAwl awl({}, scene);
    AwlWay way{.wall = wall};
    for (int n = 0; from + n * step <= to; ++n) way.push = std::max(way.push, awl.push_at(from + n * step));
    return way;
}

}  // namespace

std::string PedicleWall::name() const {
    return (is_medial ? "medial wall, L" : "lateral wall, L") + std::to_string(level);
}

std::span<const PedicleWall> pedicle_walls() noexcept {
    constexpr bool medial = true, lateral = false;
    static constexpr PedicleWall walls[] = {
        {medial, 1, 0.8_mm},  {medial, 2, 0.8_mm},  {medial, 3, 0.8_mm},  {medial, 4, 1.3_mm},  {medial, 5, 1.3_mm},
        {lateral, 1, 0.6_mm}, {lateral, 2, 0.7_mm}, {lateral, 3, 0.9_mm}, {lateral, 4, 1.1_mm}, {lateral, 5, 1.7_mm}};
    return walls;
}

std::vector<AwlWay> awl_ways() {
    std::vector<AwlWay> ways{way_through(nullptr)};
    for (const PedicleWall& wall : pedicle_walls()) {
        const auto alike = std::find_if(ways.begin(), ways.end(), [&](const AwlWay& way) {
            return way.wall != nullptr && way.wall->is_medial == wall.is_medial &&
                   way.wall->thickness == wall.thickness;
        });
        ways.push_back(alike == ways.end() ? way_through(&wall) : AwlWay{&wall, alike->push});
    }
    return ways;
}

}  // namespace kerf::chart
