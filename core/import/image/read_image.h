// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/procedure/source.h"
#include "kerf/math.hpp"

/// A CT or a label map as plain values. What reads it (ITK) is seen by one unit only.
namespace kerf {

/// Voxels with their place in the patient. Frame: LPS, metres; (0,0,0) is the centre of the first voxel.
struct VoxelImage {
    std::array<int, 3> size{};                ///< voxels along i, j, k
    std::array<double, 12> lps_from_index{};  ///< 3×4, row by row [m]; may be sheared (tilted gantry)
    std::array<double, 12> index_from_lps{};  ///< its inverse [voxels]
    std::vector<float> values;                ///< i fastest; HU, grey or label, scaled as the file says

    [[nodiscard]] std::size_t offset(int i, int j, int k) const noexcept {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(j)) *
                   static_cast<std::size_t>(size[0]) +
               static_cast<std::size_t>(i);
    }
    [[nodiscard]] bool has(int i, int j, int k) const noexcept {
        return i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2];
    }
    /// Pre: `has(i, j, k)`.
    [[nodiscard]] float at(int i, int j, int k) const noexcept { return values[offset(i, j, k)]; }

    /// Voxel index to LPS [m], and back.   [any] pure.
    [[nodiscard]] Vec3 lps(Vec3 index) const noexcept { return transformed(lps_from_index, index); }
    [[nodiscard]] Vec3 index(Vec3 lps) const noexcept { return transformed(index_from_lps, lps); }

    /// Edge length of a voxel along one axis [m].
    [[nodiscard]] double spacing(std::size_t axis) const noexcept {
        return length(Vec3{lps_from_index[axis], lps_from_index[4 + axis], lps_from_index[8 + axis]});
    }

    /// Value between the centres of the first and last voxels; `outside` everywhere else, and for NaN.   [any] pure.
    [[nodiscard]] double sample_trilinear(Vec3 lps, double outside) const noexcept;

    /// Sets both matrices. False, and nothing is changed, if this one has no inverse.
    bool place(const std::array<double, 12>& from_index) noexcept;

private:
    static Vec3 transformed(const std::array<double, 12>& m, Vec3 p) noexcept {
        return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
    }
};

/// Reads NIfTI-1 (.nii, .nii.gz), NRRD (.nrrd) or MetaImage (.mha, .mhd): three dimensions, one number per voxel.
/// The file is checked by `check_image_file()` first, so that a small file that lies costs no memory.
/// Error (E062x, codes in core/import/image/image_file.h): nothing is left half-read. Never throws.   [main]
[[nodiscard]] std::optional<VoxelImage> read_image(const std::string& file, Diagnostics& diagnostics);

}  // namespace kerf
