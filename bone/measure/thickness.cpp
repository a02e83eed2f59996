// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/thickness.h"

#include <algorithm>
#include <cmath>

namespace kerf::bone {

std::optional<Stretch> stretch_at(const MeasuredSurface& surface, const Line& line) {
    for (const Stretch& stretch : surface.stretches_on(line, -max_search_distance, max_search_distance))
        if (stretch.end > 0.0) return stretch;
    return std::nullopt;
}

std::optional<Measured> thickness_at(const MeasuredSurface& surface, const Line& line) {
    const auto stretch = stretch_at(surface, line);
    if (!stretch || !stretch->is_complete) return std::nullopt;
    const double wall = surface.wall_uncertainty();
    return Measured{stretch->end - stretch->begin,
                    std::hypot(wall / std::max(min_wall_cosine, stretch->cosine_at_begin),
                               wall / std::max(min_wall_cosine, stretch->cosine_at_end))};
}

std::optional<Measured> surface_distance(const MeasuredSurface& surface, Vec3 point) {
    const auto distance = surface.distance_to(point);
    if (!distance) return std::nullopt;
    return Measured{*distance, surface.wall_uncertainty()};
}

}  // namespace kerf::bone
