// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "text/source.h"

/// What an image file says of itself, and whether that is true: looked at before any voxel gets memory.
///
///     E0619  a link to the voxels leads out of the header's folder
///     E0620  the file is missing, no regular file, or cannot be read
///     E0621  the name ends in none of the known endings
///     E0622  the header is malformed, or asks for something that is not read (several files, NIfTI-2)
///     E0623  not three dimensions, or several numbers per voxel
///     E0624  an axis under 2 or over 4096 voxels, or over 512 million voxels in all
///     E0625  a type of voxel, or an encoding, that is not read
///     E0626  fewer or more bytes than the header's sizes need, or damaged compressed data
///     E0627  no usable spacing, orientation or frame, or two that differ
///     E0628  the file was another one when its voxels were read
///     E0629  a voxel that is no finite number
///     E0636  structures whose voxels cannot be told apart
///
/// Every field of the formats' specifications that changes geometry or values is honoured, refused or doubted:
/// tests/bone/image/header_fields_test.cpp lists them.
namespace kerf {

/// One structure of a segmentation that 3D Slicer wrote.
struct Segment {
    std::string name;
    int label = 1;  ///< of its voxels
    int layer = 0;  ///< in which they are
};

struct ImageFile {
    enum class Format { nifti, nrrd, meta };
    enum class Number { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };
    enum class Packing { raw, gzip_file, deflated };  ///< as it stands · the whole file · the voxels only
    Format format = Format::nifti;
    std::array<int, 3> size{};
    std::array<double, 12> lps_from_index{};  ///< 3×4, row by row [m], as the header places the voxels; may be sheared
    int layers = 1;                           ///< numbers per voxel: of a segmentation whose structures overlap; else 1
    Number number = Number::int16;            ///< what a voxel is stored as, in one layer
    bool is_big_endian = false;
    double slope = 1.0, intercept = 0.0;  ///< value = slope × stored + intercept
    std::vector<Segment> segments;        ///< named ones; empty: only numbers
    Packing packing = Packing::raw;
    std::string data_file;            ///< beside or the same as the header
    std::uint64_t data_offset = 0;    ///< [bytes] in the unpacked file for gzip_file, else in data_file
    std::uint64_t packed_bytes = 0;   ///< of `deflated` voxels, as the header says; 0: it does not
    std::vector<std::string> doubts;  ///< what the header leaves open, and what was taken; a sentence each

    [[nodiscard]] std::uint64_t voxels() const noexcept {
        return static_cast<std::uint64_t>(size[0]) * static_cast<std::uint64_t>(size[1]) *
               static_cast<std::uint64_t>(size[2]);
    }
    /// Of one voxel in one layer.
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

/// Reads the header and counts the bytes of the voxels; compressed ones are unpacked into a small buffer and dropped,
/// so that their check sum is compared.
/// Empty, with one error, when anything does not fit. Never throws.   [main]
[[nodiscard]] std::optional<ImageFile> check_image_file(const std::string& file, Diagnostics& diagnostics);

}  // namespace kerf
