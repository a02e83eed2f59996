// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "text/result.h"

/// The contents of an image file's header, checked against the file before memory for voxels is allocated.
///
///     E0619  a link to the voxels leads out of the header's folder
///     E0620  the file is missing, is not a regular file, or cannot be read
///     E0621  the name has none of the known endings
///     E0622  the header is malformed, or needs an unsupported feature (several files, NIfTI-2)
///     E0623  not three dimensions, or several numbers per voxel
///     E0624  an axis under 2 or over 4096 voxels, or over 512 million voxels in total
///     E0625  an unsupported type of voxel or encoding
///     E0626  fewer or more bytes than the header's sizes need, or damaged compressed data
///     E0627  no usable spacing, orientation or frame, or two that differ
///     E0628  the file changed before its voxels were read
///     E0629  a voxel that is not a finite number
///     E0636  structures whose voxels cannot be distinguished
///
/// Every field of the formats' specifications that changes geometry or values is applied, refused or reported as a
/// doubt: tests/bone/image/header_fields_test.cpp lists them.
namespace kerf::bone {

/// One structure of a segmentation by 3D Slicer.
struct Segment {
    std::string name;
    int label = 1;  ///< value of its voxels
    int layer = 0;  ///< layer of its voxels
};

struct ImageFile {
    enum class Format { nifti, nrrd, meta };
    enum class Number { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };
    enum class Packing { raw, gzip_file, deflated };  ///< not packed · the whole file · the voxels only
    Format format = Format::nifti;
    std::array<int, 3> size{};
    std::array<double, 12> lps_from_index{};  ///< 3×4, row by row [m], as in the header; may be sheared
    int layers = 1;                           ///< numbers per voxel; above 1 if structures overlap
    Number number = Number::int16;            ///< stored type of a voxel in one layer
    bool is_big_endian = false;
    double slope = 1.0, intercept = 0.0;  ///< value = slope × stored + intercept
    std::vector<Segment> segments;        ///< with names; empty: the voxels only have numbers
    Packing packing = Packing::raw;
    std::string data_file;            ///< next to the header, or the header itself
    std::uint64_t data_offset = 0;    ///< [bytes] in the unpacked file for gzip_file, else in data_file
    std::uint64_t packed_bytes = 0;   ///< size of `deflated` voxels in the header; 0: not given
    std::vector<std::string> doubts;  ///< ambiguities of the header and their resolution, one sentence each

    [[nodiscard]] std::uint64_t voxels() const noexcept {
        return static_cast<std::uint64_t>(size[0]) * static_cast<std::uint64_t>(size[1]) *
               static_cast<std::uint64_t>(size[2]);
    }
    /// Returns the bytes of one voxel in one layer.
    [[nodiscard]] int bytes_per_voxel() const noexcept {
        return number == Number::int8 || number == Number::uint8                                  ? 1
               : number == Number::int16 || number == Number::uint16                              ? 2
               : number == Number::float64 || number == Number::int64 || number == Number::uint64 ? 8
                                                                                                  : 4;
    }
    [[nodiscard]] std::uint64_t data_bytes() const noexcept {
        return voxels() * static_cast<std::uint64_t>(bytes_per_voxel()) * static_cast<std::uint64_t>(layers);
    }
};

/// Reads the header and counts the bytes of the voxels. Compressed voxels are unpacked into a small buffer and dropped,
/// so that their checksum is checked. Returns nothing, with one error, if a check fails. Never throws.   [main]
[[nodiscard]] text::Result<ImageFile> check_image_file(const std::string& file);

}  // namespace kerf::bone
