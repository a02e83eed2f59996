// SPDX-License-Identifier: Apache-2.0
#include "bone/image/read_image.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

#include "bone/image/image_file.h"
#include "bone/image/packed_bytes.h"

namespace kerf::bone {
namespace {

static_assert(std::endian::native == std::endian::little, "swap the bytes of little-endian files");

/// An error. `read_image()` turns it into a Diagnostic.
struct ReadError {
    const char* code;
    std::string message;
};

text::Diagnostic refused(const std::string& file, const char* code, std::string message) {
    return text::error_about(file, code, std::move(message) + " Export the image again, for example as .nii.gz.");
}

/// Appends the numbers of one layer from `bytes`: `count` voxels with `layers` numbers each.
template <class Stored>
void append(std::vector<float>& values, const std::vector<char>& bytes, std::size_t count, const ImageFile& header,
            int layer) {
    for (std::size_t n = 0; n < count; ++n) {
        char one[sizeof(Stored)];
        std::memcpy(
            one,
            bytes.data() + (n * static_cast<std::size_t>(header.layers) + static_cast<std::size_t>(layer)) * sizeof one,
            sizeof one);
        if (header.is_big_endian) std::reverse(std::begin(one), std::end(one));
        Stored stored;
        std::memcpy(&stored, one, sizeof stored);
        if constexpr (sizeof(Stored) == 8 && std::is_integral_v<Stored>)
            if (!std::in_range<std::int32_t>(stored) && !std::in_range<std::uint32_t>(stored))
                throw ReadError{"E0629", "a voxel is out of range: got " + std::to_string(stored) +
                                             ", expected -2147483648 … 4294967295."};
        values.push_back(static_cast<float>(header.slope * static_cast<double>(stored) + header.intercept));
    }
}

void append_row(std::vector<float>& values, const std::vector<char>& bytes, std::size_t count, const ImageFile& header,
                int layer) {
    using Number = ImageFile::Number;
    const auto as = [&]<class Stored>(Stored) { append<Stored>(values, bytes, count, header, layer); };
    switch (header.number) {
        case Number::int8:
            return as(std::int8_t{});
        case Number::uint8:
            return as(std::uint8_t{});
        case Number::int16:
            return as(std::int16_t{});
        case Number::uint16:
            return as(std::uint16_t{});
        case Number::int32:
            return as(std::int32_t{});
        case Number::uint32:
            return as(std::uint32_t{});
        case Number::int64:
            return as(std::int64_t{});
        case Number::uint64:
            return as(std::uint64_t{});
        case Number::float32:
            return as(float{});
        case Number::float64:
            return as(double{});
    }
}

/// Reads row by row and skips the bytes between the rows of the range.
std::vector<float> values_of(const ImageFile& header, const VoxelGrid& grid, const VoxelRange& range, int layer) {
    const bool is_packed = header.packing != ImageFile::Packing::raw,
               is_all = header.packing == ImageFile::Packing::gzip_file;
    PackedBytes bytes(header.data_file, is_all ? 0 : header.data_offset,
                      is_packed ? PackedBytes::Packing::deflated : PackedBytes::Packing::none);
    const ReadError changed{"E0628", "the file has changed since its header was checked: voxels are missing."};
    std::uint64_t at = 0;  // offset in the bytes of the voxels
    if (is_all && bytes.take(nullptr, header.data_offset) != header.data_offset) throw changed;

    const std::uint64_t per_voxel =
        static_cast<std::uint64_t>(header.bytes_per_voxel()) * static_cast<std::uint64_t>(header.layers);
    const auto columns = static_cast<std::size_t>(range.size[0]);
    std::vector<char> row(columns * per_voxel);
    std::vector<float> values;
    values.reserve(range.voxels());
    for (int k = 0; k < range.size[2]; ++k)
        for (int j = 0; j < range.size[1]; ++j) {
            const std::uint64_t begin = grid.offset(range.first[0], range.first[1] + j, range.first[2] + k) * per_voxel;
            if (begin > at && bytes.take(nullptr, begin - at) != begin - at) throw changed;
            if (bytes.take(row.data(), row.size()) != row.size()) throw changed;
            at = begin + row.size();
            append_row(values, row, columns, header, layer);
        }
    return values;
}

}  // namespace

text::Result<VoxelImage> read_image(const std::string& file) {
    const text::Result<ImageFile> header = check_image_file(file);
    if (!header) return header.diagnostics();
    if (header->layers > 1)
        return text::Diagnostics{
            refused(file, "E0623",
                    "the voxels have too many numbers: got " + std::to_string(header->layers) + ", expected 1.")};
    return read_image(file, *header, {{0, 0, 0}, header->size}, 0);
}

text::Result<VoxelImage> read_image(const std::string& file, const ImageFile& header, const VoxelRange& range,
                                    int layer) {
    try {
        VoxelGrid grid;
        grid.size = header.size;
        if (!grid.place(header.lps_from_index)) throw ReadError{"E0627", "the image's axes have no usable directions."};
        VoxelImage image;
        static_cast<VoxelGrid&>(image) = grid.part(range);
        image.values = values_of(header, grid, range, layer);
        if (!std::all_of(image.values.begin(), image.values.end(), [](float v) { return std::isfinite(v); }))
            throw ReadError{"E0629", "a voxel is not a finite number."};
        return image;
    } catch (const ReadError& refusal) {
        return text::Diagnostics{refused(file, refusal.code, refusal.message)};
    } catch (const std::exception& error) {  // out of memory
        return text::Diagnostics{refused(file, "E0628", std::string("reading stopped: ") + error.what() + ".")};
    }
}

}  // namespace kerf::bone
