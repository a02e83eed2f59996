// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "bone/image/voxel_image.h"

/// Parallel slices as scanned, and the straight grid that covers them.
namespace kerf::bone {

/// Slices with the same size and orientation, each with its own position of the first voxel. Frame: LPS, metres.
struct SliceStack {
    int columns = 0, rows = 0;
    Vec3 along_row{}, down_column{};  ///< [m] from a voxel to the next, at right angles
    std::vector<Vec3> origins;        ///< [m] in the order of their heights

    [[nodiscard]] Vec3 normal() const noexcept { return normalized(cross(along_row, down_column)); }
    /// Returns the height of a slice over the first one along the normal [m].
    [[nodiscard]] double height(std::size_t slice) const noexcept { return dot(origins[slice] - origins[0], normal()); }
};

/// Spacing and alignment of a stack.
struct StackShape {
    double distance = 0.0;      ///< [m] usual distance between neighbouring planes (median)
    double min_distance = 0.0;  ///< [m] smallest distance
    double max_distance = 0.0;  ///< [m] largest distance
    double unevenness = 0.0;    ///< [m] largest deviation of a slice from even heights
    double tilt = 0.0;          ///< [rad] between the normal and the line through the origins
    double shift = 0.0;         ///< [voxels] total sideways shift from first to last slice
    double crookedness = 0.0;   ///< [voxels] largest sideways distance of a slice from that line
    std::size_t repeated = 0;   ///< slices in the plane of the one before
    struct Gap {
        std::size_t behind = 0;  ///< the slice before it
        double width = 0.0;      ///< [m]
    };
    std::vector<Gap> gaps;  ///< wider than 1.25 distances: slices are missing

    /// Returns whether voxels lie at even heights, one above the other, so that no resampling is needed.
    [[nodiscard]] bool is_straight() const noexcept { return is_even() && !is_tilted() && !is_crooked(); }
    [[nodiscard]] bool is_even() const noexcept { return unevenness <= 0.01 * distance; }
    [[nodiscard]] bool is_tilted() const noexcept { return shift > 0.1; }
    [[nodiscard]] bool is_crooked() const noexcept { return crookedness > 0.1; }
};

/// Returns spacing and alignment. Pre: at least two slices, sorted.   [any] pure.
[[nodiscard]] StackShape shape_of(const SliceStack& stack);

/// Returns the number of even steps between the first and last slice of the straight grid.   [any] pure.
[[nodiscard]] double straight_steps(const SliceStack& stack, const StackShape& shape);

/// Returns the grid along the slices' axes and their normal that covers all slices. A straight stack keeps its own
/// voxels; otherwise slices are at least as fine as the smallest distance. With too many voxels the grid is empty.
/// [any] pure.
[[nodiscard]] VoxelGrid straight_grid(const SliceStack& stack, const StackShape& shape);

/// Returns the values of a slice, row by row, NaN where nothing was measured. An empty result ends `straightened`.
using SliceReader = std::function<std::vector<float>(std::size_t slice)>;

/// Returns the voxels of a range of the straight grid, interpolated between two slices: linear along the normal,
/// bilinear in each slice. Reads only the slices that the range needs, each once, in order. Voxels outside all slices
/// and unmeasured voxels get the smallest measured value. No values if a slice could not be read.   [main]
[[nodiscard]] VoxelImage straightened(const SliceStack& stack, const StackShape& shape, const VoxelGrid& grid,
                                      const VoxelRange& range, const SliceReader& read);

}  // namespace kerf::bone
