// SPDX-License-Identifier: Apache-2.0
#include "core/import/planned_region.h"

#include <algorithm>
#include <cmath>

namespace kerf {
namespace {

constexpr double around_axes = 15e-3;  // [m] of bone that is taken along on every side

}  // namespace

Box box_around(const std::vector<LandmarkAxis>& axes) noexcept {
    Box box{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    for (const auto& axis : axes)
        for (const Vec3 end : {axis.from, axis.to}) {
            box.low = {std::min(box.low.x, end.x), std::min(box.low.y, end.y), std::min(box.low.z, end.z)};
            box.high = {std::max(box.high.x, end.x), std::max(box.high.y, end.y), std::max(box.high.z, end.z)};
        }
    return grown(box, around_axes);
}

Box common_part(const Box& a, const Box& b) noexcept {
    return {{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y), std::max(a.low.z, b.low.z)},
            {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y), std::min(a.high.z, b.high.z)}};
}

bool is_empty(const Box& box) noexcept {
    return !(box.low.x < box.high.x && box.low.y < box.high.y && box.low.z < box.high.z);
}

Box grown(const Box& box, double margin) noexcept {
    const Vec3 around{margin, margin, margin};
    return {box.low - around, box.high + around};
}

Region region_on(const Grid& grid, const Box& box) {
    const auto up = [&](double at, double origin) {
        return static_cast<int>(std::ceil((at - origin) / grid.spacing - 1e-6));
    };
    const auto down = [&](double at, double origin) {
        return static_cast<int>(std::floor((at - origin) / grid.spacing + 1e-6));
    };
    return {
        grid.sample_position(up(box.low.x, grid.origin.x), up(box.low.y, grid.origin.y), up(box.low.z, grid.origin.z)),
        grid.sample_position(down(box.high.x, grid.origin.x), down(box.high.y, grid.origin.y),
                             down(box.high.z, grid.origin.z))};
}

}  // namespace kerf
