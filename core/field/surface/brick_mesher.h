// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/field/cut/cut_field.h"
#include "core/field/grid/body.h"

/// Makes the surface of the remaining bone of a body, brick by brick.
namespace kerf {

/// A view of the surface in the cells of one brick. A brick's cells lie between its samples 0 … 8. In the first bricks
/// of the grid they begin at sample −1, so that the surface is closed there.
///
/// Vertices are in three runs, by the axis of their edge: x, y, z. Each run is sorted by z, then y, then x of the edge.
/// So vertices that belong to two bricks have the same order and the same bits in both.
struct PatchView {
    std::span<const SurfaceVertex> vertices;
    std::span<const std::uint8_t> tissue;  ///< per vertex: the material half a voxel inwards
    std::span<const std::uint16_t> edges;  ///< per vertex: slot of its edge's lower sample | axis << 12
    std::span<const std::array<std::uint16_t, 3>> triangles;  ///< anticlockwise seen from outside
};

/// A stored copy of a patch. Immutable: any thread may read it.
class BrickPatch {
public:
    explicit BrickPatch(const PatchView& patch);

    [[nodiscard]] PatchView view() const noexcept { return {vertices_, tissue_, edges_, triangles_}; }
    [[nodiscard]] const std::vector<SurfaceVertex>& vertices() const noexcept { return vertices_; }
    [[nodiscard]] const std::vector<std::uint8_t>& tissue() const noexcept { return tissue_; }
    [[nodiscard]] const std::vector<std::array<std::uint16_t, 3>>& triangles() const noexcept { return triangles_; }
    /// Returns whether a vertex lies on an edge that touches side `side` of the brick, 0 … 5: −x, +x, −y, +y, −z, +z.
    /// Then its normal depends on the neighbour there.
    [[nodiscard]] bool depends_on(int side) const noexcept { return (sides_ >> side & 1) != 0; }
    [[nodiscard]] bool is_same_as(const PatchView& other) const noexcept;

private:
    std::vector<SurfaceVertex> vertices_;
    std::vector<std::uint8_t> tissue_;
    std::vector<std::uint16_t> edges_;
    std::vector<std::array<std::uint16_t, 3>> triangles_;
    unsigned sides_ = 0;
};

/// Marching cubes of max(surface, cut), cut off flat at the body's region, with the table and the rules of
/// `isosurface`: zero counts as outside, and samples outside the grid have the value of a quarter of the clamp, one
/// voxel. Single precision: the error of a vertex is the last bit of its coordinates, 30 nm at 0.3 m.
///
/// Not thread-safe: it has its own work memory.
class BrickMesher {
public:
    /// Makes a mesher. The body must outlive it.   [main, worker]
    explicit BrickMesher(const Body& body);

    /// Returns false if no cell of the brick can have a surface. Decides by the signs of the bone, stored cuts, and the
    /// position relative to grid and region.   [worker]
    [[nodiscard]] bool may_cross(const CutField& cut, std::size_t brick) const noexcept;
    /// Prefetches the samples that a following `mesh` of the brick reads.   [worker]
    void prefetch(const CutField& cut, std::size_t brick) const noexcept;
    /// Returns the patch of a brick; empty if it has no surface. Valid until the next `mesh`.   [worker]
    PatchView mesh(const CutField& cut, std::size_t brick) noexcept;

private:
    static constexpr std::size_t slot_count = 10 * std::size_t{slot_layer}, margin = 288;
    static constexpr std::size_t max_patch_cells = 9 * 9 * 9, slack = 16;
    static constexpr std::size_t max_patch_vertices = 3 * 9 * 9 * 9, max_patch_triangles = 5 * max_patch_cells;

    [[nodiscard]] std::array<int, 3> coordinates_of(std::size_t brick) const noexcept;
    [[nodiscard]] BrickAround around(const FieldShape& field, const std::array<int, 3>& at) const noexcept;
    [[nodiscard]] std::int16_t* samples() noexcept { return samples_.data() + margin; }
    [[nodiscard]] bool is_near_region_faces(const std::array<int, 3>& at) const noexcept;
    void cut_off_at_region(const std::array<int, 3>& at) noexcept;
    void clear_signs_from(const std::array<int, 3>& end) noexcept;
    void list_edges_and_cells(const std::array<int, 3>& first) noexcept;
    void make_triangles() noexcept;
    void close_at_border(const std::array<int, 3>& at) noexcept;
    void assign_tissues(std::size_t brick) noexcept;

    const Body* body_;
    GridFrame locator_;
    SampleFrame frame_{};
    /// For each axis, the signed distance [quanta] of each sample to the region along it, negative inside. From sample
    /// −1 to one past the apron. Empty without bounds.
    std::array<std::vector<std::int16_t>, 3> beyond_;

    alignas(64) std::array<std::int16_t, margin + 11 * slot_layer + margin> samples_{};
    alignas(64) std::array<std::uint16_t, slot_count / slot_row + 2 * slot_row> inside_{};
    std::array<std::array<std::uint16_t, max_patch_cells + slack>, 3> edges_along_{};
    std::array<std::size_t, 3> count_along_{};
    std::array<std::uint16_t, max_patch_cells + slack> cells_{};
    std::size_t cell_count_ = 0, vertex_count_ = 0, triangle_count_ = 0;
    std::array<std::uint16_t, 3 * slot_count> number_{};  ///< vertex by axis · slot_count + slot of its edge
    std::array<SurfaceVertex, max_patch_vertices + slack> vertices_{};
    std::array<std::uint16_t, max_patch_vertices + slack> edges_{};
    std::array<std::uint8_t, max_patch_vertices + slack> tissue_{};
    std::array<std::array<std::uint16_t, 3>, max_patch_triangles + slack> triangles_{};
};

}  // namespace kerf
