// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "bone/image/voxel_image.h"

/// Parallel slices as a scanner took them, and the straight grid that holds what they say.
namespace kerf {

/// Slices of one size and orientation, each with its first voxel at a place of its own. Frame: LPS, metres.
struct SliceStack {
    int columns = 0, rows = 0;
    Vec3 along_row{}, down_column{};  ///< [m] from a voxel to the next, at right angles
    std::vector<Vec3> origins;        ///< [m] in the order of their heights

    [[nodiscard]] Vec3 normal() const noexcept { return normalized(cross(along_row, down_column)); }
    /// Height of a slice over the first one along the normal [m].
    [[nodiscard]] double height(std::size_t slice) const noexcept { return dot(origins[slice] - origins[0], normal()); }
};

/// What the places of slices amount to.
struct StackShape {
    double distance = 0.0;     ///< [m] between neighbouring planes, as most are
    double least = 0.0;        ///< [m] the smallest one
    double most = 0.0;         ///< [m] the largest one
    double unevenness = 0.0;   ///< [m] the most by which a slice lies off the even line through all
    double tilt = 0.0;         ///< [rad] between the normal and the line through the origins
    double shift = 0.0;        ///< [voxels] by which the slices slide over each other in all
    double crookedness = 0.0;  ///< [voxels] the most by which a slice lies beside that line
    std::size_t repeated = 0;  ///< slices in the plane of the one before
    struct Gap {
        std::size_t behind = 0;  ///< the slice before it
        double width = 0.0;      ///< [m]
    };
    std::vector<Gap> gaps;  ///< wider than 1.25 distances: slices are missing there

    /// Voxels at even heights, one above the other: nothing needs to be computed.
    [[nodiscard]] bool is_straight() const noexcept { return is_even() && !is_tilted() && !is_crooked(); }
    [[nodiscard]] bool is_even() const noexcept { return unevenness <= 0.01 * distance; }
    [[nodiscard]] bool is_tilted() const noexcept { return shift > 0.1; }
    [[nodiscard]] bool is_crooked() const noexcept { return crookedness > 0.1; }
};

/// Pre: at least two slices, sorted.   [any] pure.
[[nodiscard]] StackShape shape_of(const SliceStack& stack);

/// The grid along the slices' own axes and their normal that holds them all: their own voxels where they are straight,
/// otherwise at least as fine as their narrowest gap. Too many voxels: a grid of none.   [any] pure.
[[nodiscard]] VoxelGrid straight_grid(const SliceStack& stack, const StackShape& shape);

/// Gives the values of a slice, row by row, NaN where nothing was measured; empty ends everything.
using SliceReader = std::function<std::vector<float>(std::size_t slice)>;

/// The voxels of a range of the straight grid. Each lies between two slices and gets the value between the two at its
/// own place: linear along the normal, bilinear in each slice. Only the slices that the range needs are asked for, each
/// once, in order. What lies outside all slices, or was not measured, gets the smallest value that was. No values: a
/// slice could not be read.   [main]
[[nodiscard]] VoxelImage straightened(const SliceStack& stack, const StackShape& shape, const VoxelGrid& grid,
                                      const VoxelRange& range, const SliceReader& read);

}  // namespace kerf
