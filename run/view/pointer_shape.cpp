// SPDX-License-Identifier: Apache-2.0
#include "run/view/pointer_shape.h"

#include <cmath>
#include <numbers>

#include "run/view/facets.h"

namespace kerf::run {

ViewedMesh pointer_shape(double diameter) {
    constexpr std::size_t columns = 32;
    const double radius = 0.5 * diameter;
    Rows rows{.columns = columns, .points = {}};
    const auto add = [&](double z, double at) {
        for (std::size_t i = 0; i < columns; ++i) {
            const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / columns;
            rows.points.push_back({at * std::cos(angle), at * std::sin(angle), z});
        }
    };
    add(0.0, 0.0);
    add(-radius, radius);
    add(-pointer_length, radius);
    add(-pointer_length, 0.0);
    Facets facets;
    add_rows(facets, rows);
    return mesh_of(facets);
}

}  // namespace kerf::run
