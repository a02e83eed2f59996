// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kerf/math.hpp"
#include "run/view/viewed_run.h"

/// Triangles of a shape before they get normals.
namespace kerf::run {

inline constexpr std::size_t max_tool_triangles = 30000;  ///< of one tool

struct Facets {
    std::vector<Vec3> points;  ///< [m]; equal points are one point
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint8_t> sheets;  ///< of each triangle, 0 or a number: an edge within a sheet above 0
                                       ///< is smooth, one between two such sheets is a crease

    /// Adds a point and returns its index.
    std::uint32_t add(Vec3 point) {
        points.push_back(point);
        return static_cast<std::uint32_t>(points.size() - 1);
    }
    /// Adds a triangle, anticlockwise seen from outside.
    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint8_t sheet = 0) {
        triangles.push_back({a, b, c});
        sheets.push_back(sheet);
    }
    /// Adds a quadrilateral, anticlockwise seen from outside. The diagonal whose middle is farther from the z axis
    /// divides it, which keeps ridges sharp.
    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, std::uint8_t sheet);
};

/// Points around the z axis, row by row, from the tip backwards. Within a row the azimuth rises. A row of equal points
/// is a pole.
struct Rows {
    std::size_t columns = 0;
    std::vector<Vec3> points;  ///< [m]

    [[nodiscard]] std::size_t count() const noexcept { return columns == 0 ? 0 : points.size() / columns; }
};

/// Adds the surface between all neighbouring rows. Rows that go towards the tip bound a bore.
void add_rows(Facets& facets, const Rows& rows);

/// Returns the mesh of facets. Facets that meet at less than 30° have a common normal at their common points; at
/// other edges the points are doubled. Triangles without area are left out.   [main]
[[nodiscard]] ViewedMesh mesh_of(const Facets& facets);

}  // namespace kerf::run
