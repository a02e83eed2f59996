// SPDX-License-Identifier: Apache-2.0
#include "run/view/zone_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/field/surface/isosurface.h"
#include "documents/solids.h"
#include "run/view/surface_shape.h"

namespace kerf::run {

namespace {

constexpr double max_samples = 4e6;

/// Samples a zone's distance over `box`. Pre: `zone` outlives the result.
SampleGrid samples_of(const documents::Zone& zone, const Box& box, double spacing) {
    SampleGrid grid;
    grid.spacing = spacing;
    const Vec3 size = box.high - box.low;
    const std::array<double, 3> sides{size.x, size.y, size.z};
    std::array<double, 3> spare{};  // [m] of the grid beyond each side of the box: solids keep clear of its border
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double cells = std::ceil(sides[axis] / spacing) + 2.0;
        grid.size[axis] = static_cast<int>(cells) + 1;
        spare[axis] = 0.5 * (cells * spacing - sides[axis]);
    }
    grid.origin = box.low - Vec3{spare[0], spare[1], spare[2]};
    grid.value = [&zone, origin = grid.origin, spacing](int i, int j, int k) {
        constexpr double reach = 4.0;  // spacings from the surface within which its normals sample
        const Vec3 cell{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
        double distance = HUGE_VAL;
        for (const documents::Solid& solid : zone.solids)
            distance = std::min(distance, documents::distance_to(solid, origin + spacing * cell, reach * spacing));
        return static_cast<float>(distance);
    };
    return grid;
}

double sample_count(const Box& box, double spacing) noexcept {
    const Vec3 size = box.high - box.low;
    return (size.x / spacing + 3.0) * (size.y / spacing + 3.0) * (size.z / spacing + 3.0);
}

}  // namespace

ViewedMesh zone_shape(const documents::Zone& zone, double spacing) {
    const Box box = documents::bounds_of(zone.solids);
    const double largest = std::max({box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z});
    if (zone.solids.empty() || !std::isfinite(largest) || !(largest > 0.0)) return {};
    constexpr double coarsest = 24.0, finest = 400.0, coarser = 1.1;  // samples along the largest side; [–]
    const double first = largest / coarsest;
    spacing = std::clamp(spacing, largest / finest, first);
    while (sample_count(box, spacing) > max_samples) spacing *= coarser;

    // The number of triangles goes with the inverse square of the spacing, so a coarse surface predicts it.
    const double triangles = 0.9 * static_cast<double>(max_zone_triangles);
    for (double at = first;;) {
        const Mesh mesh = isosurface(samples_of(zone, box, at));
        const double needed = at * std::sqrt(static_cast<double>(mesh.triangles.size()) / triangles);
        if (at <= spacing && mesh.triangles.size() < max_zone_triangles) return viewed(mesh);
        spacing = at <= spacing ? at * coarser : std::max(spacing, needed);
        at = spacing;
    }
}

}  // namespace kerf::run
