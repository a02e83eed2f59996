// SPDX-License-Identifier: Apache-2.0
// The files of one folder, one behind the other: two bytes of length, the higher one first, then so many of the file.
#include "bone/image/dicom_series.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "bone/image/dicom_file.h"
#include "tests/fuzz/diagnosed.h"
#include "tests/fuzz/scratch_file.h"

namespace kerf::fuzz {
namespace {

constexpr std::size_t max_files = 32;

std::vector<bone::DicomHeader> headers_in(std::string_view input, const ScratchFolder& folder) {
    std::vector<bone::DicomHeader> headers;
    while (input.size() >= 2 && headers.size() < max_files) {
        const auto byte = [&](std::size_t at) {
            return static_cast<std::size_t>(static_cast<unsigned char>(input[at]));
        };
        const std::size_t size = std::min(byte(0) << 8 | byte(1), input.size() - 2);
        headers.push_back(
            bone::read_dicom_header(folder.hold("slice" + std::to_string(headers.size()), input.substr(2, size))));
        input.remove_prefix(2 + size);
    }
    return headers;
}

/// The voxels of a series that has few, put straight as a scan's are.
void straighten(const bone::DicomSeries& series) {
    constexpr std::size_t few = 64 * 1024;
    const bone::VoxelGrid grid = bone::straight_grid(series.stack, series.shape);
    const bool is_plain = std::none_of(series.slices.begin(), series.slices.end(),
                                       [](const bone::DicomSlice& s) { return s.is_compressed; });
    if (!is_plain || grid.all().voxels() > few) return;
    std::string trouble;
    const bone::VoxelImage image = straightened(series.stack, series.shape, grid, grid.all(), [&](std::size_t slice) {
        return bone::read_dicom_voxels(series.slices[slice], trouble);
    });
    require(image.values.empty() == !trouble.empty(), "voxels come, or else a trouble");
    require(std::all_of(image.values.begin(), image.values.end(), [](float value) { return std::isfinite(value); }),
            "every voxel is a number");
}

}  // namespace

bool reads(std::string_view input) {
    static const ScratchFolder folder;
    const std::vector<bone::DicomHeader> headers = headers_in(input, folder);
    bool is_read = false;
    for (const bool may_resample : {false, true}) {
        text::Diagnostics diagnostics;
        const auto series =
            bone::series_of(headers, {.name = "", .may_resample = may_resample}, "folder").take(diagnostics);
        require_reason(series.has_value(), diagnostics);
        if (!series) continue;
        is_read = true;
        require(series->slices.size() >= 2 && series->slices.size() == series->stack.origins.size(),
                "a volume has slices");
        for (std::size_t n = 1; n < series->slices.size(); ++n)
            require(series->stack.height(n) > series->stack.height(n - 1), "slices lie in the order of their heights");
        straighten(*series);
    }
    return is_read;
}

}  // namespace kerf::fuzz
