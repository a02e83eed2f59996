// SPDX-License-Identifier: Apache-2.0
#include "bone/import/planned_region.h"

#include <algorithm>
#include <cmath>

namespace kerf::bone {
namespace {

constexpr double around_axes = 15e-3;  // [m] of bone around the axes on every side

}  // namespace

Box planned_region(const std::vector<documents::LandmarkAxis>& axes, const Box& available) {
    Box box = empty_box;
    for (const auto& axis : axes)
        for (const Vec3 end : {axis.from, axis.to}) box = joined(box, end);
    const auto [low, high] = grown(box, around_axes);
    return {
        {std::max(low.x, available.low.x), std::max(low.y, available.low.y), std::max(low.z, available.low.z)},
        {std::min(high.x, available.high.x), std::min(high.y, available.high.y), std::min(high.z, available.high.z)}};
}

bool is_empty(const Box& box) noexcept {
    const Vec3 extent = box.high - box.low;
    return !(extent.x > 0.0 && extent.y > 0.0 && extent.z > 0.0);
}

}  // namespace kerf::bone
