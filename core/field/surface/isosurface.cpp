// SPDX-License-Identifier: Apache-2.0
#include "core/field/surface/isosurface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/field/surface/cell_cases.h"
#include "kerf/assert.hpp"

namespace kerf {
namespace {

constexpr std::uint32_t no_vertex = std::numeric_limits<std::uint32_t>::max();

/// One pass through the cells, layer by layer in z. Cell (i, j, k) lies between samples (i, j, k) and (i+1, j+1, k+1).
/// The outermost cells, from −1 on, reach out of the grid and close the surface.
class MarchingCubes {
public:
    explicit MarchingCubes(const SampleGrid& grid)
        : grid_(grid),
          row_(static_cast<std::size_t>(grid.size[0]) + 2),
          layer_(row_ * (static_cast<std::size_t>(grid.size[1]) + 2)) {
        for (auto& slice : samples_) slice.assign(layer_, unknown);
        for (auto& vertices : vertex_on_edge_) vertices.assign(layer_, no_vertex);
    }

    Mesh mesh() && {
        for (int k = -1; k < grid_.size[2]; ++k) {
            begin_layer(k);
            for (int j = -1; j < grid_.size[1]; ++j)
                for (int i = -1; i < grid_.size[0]; ++i) add_cell(i, j, k);
        }
        return std::move(mesh_);
    }

private:
    struct Sample {
        int i, j, k;
    };

    // Samples of four slices, k−1 … k+2, which the normals need; each is evaluated at its first use. No sample can be
    // `unknown`: value() turns every NaN into +1.
    static constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

    std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(j + 1) * row_ + static_cast<std::size_t>(i + 1);
    }

    bool is_in_grid(Sample s) const {
        return s.i >= 0 && s.j >= 0 && s.k >= 0 && s.i < grid_.size[0] && s.j < grid_.size[1] && s.k < grid_.size[2];
    }

    double value(Sample s) {
        if (!is_in_grid(s)) return 1.0;
        float& known = samples_[static_cast<std::size_t>(s.k) % 4][index(s.i, s.j)];
        if (std::isnan(known)) {
            known = grid_.value(s.i, s.j, s.k);
            if (std::isnan(known)) known = 1.0F;
            known = std::clamp(known, -1e30F, 1e30F);  // an infinite sample would have no zero next to it
        }
        return known;
    }

    bool is_inside(Sample s) { return value(s) < 0.0; }

    void begin_layer(int k) {
        // Slice k+2 replaces slice k−2, which is no longer needed.
        samples_[static_cast<std::size_t>(k + 2) % 4].assign(layer_, unknown);
        // The upper side of the previous layer is the lower side of this one.
        for (std::size_t axis = 0; axis < 2; ++axis) {
            std::swap(vertex_on_edge_[axis], vertex_on_edge_[axis + 2]);
            vertex_on_edge_[axis + 2].assign(layer_, no_vertex);
        }
        vertex_on_edge_[4].assign(layer_, no_vertex);
    }

    void add_cell(int i, int j, int k) {
        unsigned inside = 0;
        for (int c = 0; c < cell_corners; ++c)
            if (is_inside({i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1)})) inside |= 1U << c;
        const CellCase& cell = cell_cases[inside];
        for (int n = 0; n < cell.count; ++n) {
            std::array<std::uint32_t, 3> triangle{};
            for (std::size_t m = 0; m < 3; ++m)
                triangle[m] = vertex({i, j, k}, cell.triangles[static_cast<std::size_t>(n)][m]);
            mesh_.triangles.push_back(triangle);
        }
    }

    /// Returns the vertex on an edge of `cell`, made at its first use: neighbours use the same vertex on a common edge.
    std::uint32_t vertex(Sample cell, int edge) {
        const int corner = edge_start[static_cast<std::size_t>(edge)], axis = edge / 4;
        const Sample low{cell.i + (corner & 1), cell.j + (corner >> 1 & 1), cell.k + (corner >> 2 & 1)};
        const bool is_upper = low.k > cell.k;
        const std::size_t family = axis == 2 ? 4 : static_cast<std::size_t>(axis) + (is_upper ? 2 : 0);
        std::uint32_t& known = vertex_on_edge_[family][index(low.i, low.j)];
        if (known == no_vertex) {
            known = static_cast<std::uint32_t>(mesh_.vertices.size());
            add_vertex(low, axis);
        }
        return known;
    }

    void add_vertex(Sample low, int axis) {
        const Sample high{low.i + (axis == 0), low.j + (axis == 1), low.k + (axis == 2)};
        const double at_low = value(low), at_high = value(high);
        const double t = at_low / (at_low - at_high);  // one is negative and the other is not: 0 … 1
        const Vec3 along{axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
        const Vec3 steps = Vec3{double(low.i), double(low.j), double(low.k)} + t * along;
        mesh_.vertices.push_back(grid_.origin + grid_.spacing * steps);

        const Vec3 outwards = at_low < 0.0 ? along : -along;
        if (!is_in_grid(low) || !is_in_grid(high)) {
            mesh_.normals.push_back(outwards);
            return;
        }
        const Vec3 gradient = (1.0 - t) * difference(low) + t * difference(high);
        const Vec3 normal = normalized(gradient);
        mesh_.normals.push_back(is_finite(normal) && dot(normal, normal) > 0.5 ? normal : outwards);
    }

    /// Returns the change of the field per voxel at a sample in the grid: central, one-sided at the grid's border.
    Vec3 difference(Sample s) {
        const auto along = [&](Sample before, Sample after) {
            const bool has_before = is_in_grid(before), has_after = is_in_grid(after);
            if (!has_before && !has_after) return 0.0;
            const double change = value(has_after ? after : s) - value(has_before ? before : s);
            return has_before && has_after ? 0.5 * change : change;
        };
        return {along({s.i - 1, s.j, s.k}, {s.i + 1, s.j, s.k}), along({s.i, s.j - 1, s.k}, {s.i, s.j + 1, s.k}),
                along({s.i, s.j, s.k - 1}, {s.i, s.j, s.k + 1})};
    }

    const SampleGrid& grid_;
    std::size_t row_, layer_;  ///< samples in a row and in a layer, with one beyond each border
    std::array<std::vector<float>, 4> samples_;
    /// The vertex on each edge of a layer. Five lists: along x and y on its lower side, along x and y on its upper
    /// side, along z.
    std::array<std::vector<std::uint32_t>, 5> vertex_on_edge_;
    Mesh mesh_;
};

}  // namespace

Mesh isosurface(const SampleGrid& grid) {
    KERF_ASSERT(grid.spacing > 0.0, "give the spacing of the samples in metres");
    KERF_ASSERT(grid.value != nullptr, "give the function to draw");
    if (grid.size[0] <= 0 || grid.size[1] <= 0 || grid.size[2] <= 0) return {};
    return MarchingCubes(grid).mesh();
}

}  // namespace kerf
