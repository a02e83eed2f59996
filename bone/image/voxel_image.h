// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/field/grid/box.h"
#include "kerf/math.hpp"

/// A CT or a label map as plain values.
namespace kerf::bone {

/// A box of voxels: its first voxel and its size, along i, j, k.
struct VoxelRange {
    std::array<int, 3> first{}, size{};
    [[nodiscard]] std::size_t voxels() const noexcept {
        return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
               static_cast<std::size_t>(size[2]);
    }
};

/// Position of voxels in the patient. Frame: LPS, metres; (0,0,0) is the centre of the first voxel.
struct VoxelGrid {
    std::array<int, 3> size{};                ///< voxels along i, j, k
    std::array<double, 12> lps_from_index{};  ///< 3×4, row by row [m]; may be sheared (tilted gantry)
    std::array<double, 12> index_from_lps{};  ///< its inverse [voxels]

    [[nodiscard]] std::size_t offset(int i, int j, int k) const noexcept {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(j)) *
                   static_cast<std::size_t>(size[0]) +
               static_cast<std::size_t>(i);
    }
    [[nodiscard]] bool has(int i, int j, int k) const noexcept {
        return i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2];
    }
    [[nodiscard]] VoxelRange all() const noexcept { return {{0, 0, 0}, size}; }

    /// Convert voxel index to LPS [m], and back.   [any] pure.
    [[nodiscard]] Vec3 lps(Vec3 index) const noexcept { return transformed(lps_from_index, index); }
    [[nodiscard]] Vec3 index(Vec3 lps) const noexcept { return transformed(index_from_lps, lps); }

    /// Step from a voxel to the next along one axis [m], and its length [m].
    [[nodiscard]] Vec3 step(std::size_t axis) const noexcept {
        return {lps_from_index[axis], lps_from_index[4 + axis], lps_from_index[8 + axis]};
    }
    [[nodiscard]] double spacing(std::size_t axis) const noexcept { return length(step(axis)); }
    [[nodiscard]] Vec3 origin() const noexcept { return {lps_from_index[3], lps_from_index[7], lps_from_index[11]}; }

    /// Returns the box around the centres of all voxels. A grid that is rotated against LPS does not fill it.
    [[nodiscard]] Box box() const noexcept;

    /// Returns the voxels in a box and the next ones around it; empty if grid and box do not overlap in volume.
    [[nodiscard]] VoxelRange range(const Box& box) const noexcept;

    /// Returns the grid of the voxels in a range. Pre: the range lies in the grid.
    [[nodiscard]] VoxelGrid part(const VoxelRange& range) const noexcept;

    /// Returns whether two axes deviate from right angles by more than a thousandth.
    [[nodiscard]] bool is_sheared() const noexcept;

    /// Sets both matrices. Returns false, without a change, if the matrix has no inverse.
    bool place(const std::array<double, 12>& from_index) noexcept;
    bool place(Vec3 along_i, Vec3 along_j, Vec3 along_k, Vec3 origin) noexcept;

private:
    static Vec3 transformed(const std::array<double, 12>& m, Vec3 p) noexcept {
        return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
    }
};

/// Returns whether two grids have the same size and the same voxel positions, to 0.01 mm.
[[nodiscard]] bool on_one_grid(const VoxelGrid& a, const VoxelGrid& b) noexcept;

/// Voxels with their values.
struct VoxelImage : VoxelGrid {
    std::vector<float> values;  ///< i fastest; HU, grey or label, scaled as the header defines

    /// Returns the value of a voxel. Pre: `has(i, j, k)`.
    [[nodiscard]] float at(int i, int j, int k) const noexcept { return values[offset(i, j, k)]; }

    /// Returns the value between the centres of the first and last voxels; `outside` elsewhere, and for NaN.   [any]
    /// pure.
    [[nodiscard]] double sample_trilinear(Vec3 lps, double outside) const noexcept;

    /// Returns the voxels of a range as an image. Pre: the range lies in the image.
    [[nodiscard]] VoxelImage cropped(const VoxelRange& range) const;
};

}  // namespace kerf::bone
