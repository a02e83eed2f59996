// SPDX-License-Identifier: Apache-2.0
#include "core/import/image/read_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/import/image/image_file.h"

namespace kerf {
namespace {

Diagnostic refused(const std::string& file, const char* code, std::string message) {
    Diagnostic wrong;
    wrong.code = code;
    wrong.place.file = file;
    wrong.message = std::move(message) + " Export the image again, for example as .nii.gz.";
    return wrong;
}

/// The voxels of a range and one layer, as the file scales them.
template <class Stored>
std::vector<float> taken(const std::string& bytes, const ImageFile& header, const VoxelGrid& grid,
                         const VoxelRange& range, int layer) {
    std::vector<float> values;
    values.reserve(range.voxels());
    const auto layers = static_cast<std::size_t>(header.layers);
    std::array<char, sizeof(Stored)> one;
    for (int k = 0; k < range.size[2]; ++k)
        for (int j = 0; j < range.size[1]; ++j) {
            const std::size_t row = grid.offset(range.first[0], range.first[1] + j, range.first[2] + k);
            for (std::size_t i = 0; i < static_cast<std::size_t>(range.size[0]); ++i) {
                const std::size_t at = (row + i) * layers + static_cast<std::size_t>(layer);
                std::memcpy(one.data(), bytes.data() + at * sizeof(Stored), sizeof(Stored));
                if (header.is_big_endian) std::reverse(one.begin(), one.end());
                Stored stored;
                std::memcpy(&stored, one.data(), sizeof stored);
                values.push_back(static_cast<float>(header.slope * static_cast<double>(stored) + header.intercept));
            }
        }
    return values;
}

std::vector<float> taken(const std::string& bytes, const ImageFile& header, const VoxelGrid& grid,
                         const VoxelRange& range, int layer) {
    const auto as = [&]<class Stored>(Stored) { return taken<Stored>(bytes, header, grid, range, layer); };
    switch (header.bytes_per_voxel) {
        case 1:
            return header.is_signed ? as(std::int8_t{}) : as(std::uint8_t{});
        case 2:
            return header.is_signed ? as(std::int16_t{}) : as(std::uint16_t{});
        case 4:
            if (header.is_real) return as(float{});
            return header.is_signed ? as(std::int32_t{}) : as(std::uint32_t{});
        default:
            return as(double{});
    }
}

}  // namespace

std::optional<VoxelImage> read_image(const std::string& file, Diagnostics& diagnostics) {
    const std::optional<ImageFile> header = check_image_file(file, diagnostics);
    if (!header) return std::nullopt;
    if (header->layers > 1) {
        diagnostics.push_back(
            refused(file, "E0623", "there are " + std::to_string(header->layers) + " numbers per voxel, must be 1."));
        return std::nullopt;
    }
    return read_image(file, *header, {{0, 0, 0}, header->size}, 0, diagnostics);
}

std::optional<VoxelImage> read_image(const std::string& file, const ImageFile& header, const VoxelRange& range,
                                     int layer, Diagnostics& diagnostics) {
    VoxelGrid grid;
    grid.size = header.size;
    if (!grid.place(header.lps_from_index)) {
        diagnostics.push_back(refused(file, "E0627", "the image's axes have no usable directions."));
        return std::nullopt;
    }
    const std::optional<std::string> bytes = read_voxel_bytes(file, header, diagnostics);
    if (!bytes) return std::nullopt;
    VoxelImage image;
    static_cast<VoxelGrid&>(image) = grid.part(range);
    image.values = taken(*bytes, header, grid, range, layer);
    if (!std::all_of(image.values.begin(), image.values.end(), [](float v) { return std::isfinite(v); })) {
        diagnostics.push_back(refused(file, "E0629", "a voxel is no finite number."));
        return std::nullopt;
    }
    return image;
}

}  // namespace kerf
