// SPDX-License-Identifier: Apache-2.0
// The first byte says which ending the file's name gets: n .nii, z .nii.gz, r .nrrd, m .mha, else .mhd, whose voxels
// may be in the file itself. The voxels are read where the header promises few.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "bone/image/image_file.h"
#include "bone/image/scan.h"
#include "tests/fuzz/diagnosed.h"
#include "tests/fuzz/scratch_file.h"

namespace {

std::string name_of(char format) {
    switch (format) {
        case 'n':
            return "image.nii";
        case 'z':
            return "image.nii.gz";
        case 'r':
            return "image.nrrd";
        case 'm':
            return "image.mha";
        default:
            return "image.mhd";
    }
}

}  // namespace

bool kerf::fuzz::reads(std::string_view input) {
    static const ScratchFolder folder;
    if (input.empty()) return false;
    const std::string file = folder.hold(name_of(input[0]), input.substr(1));

    text::Diagnostics diagnostics;
    const auto header = bone::check_image_file(file).take(diagnostics);
    require_reason(header.has_value(), diagnostics);
    if (!header) return false;
    for (const double number : header->lps_from_index) require(std::isfinite(number), "the voxels lie somewhere");
    constexpr std::uint64_t few = 64 * 1024;
    if (header->voxels() * static_cast<std::uint64_t>(header->layers) > few) return true;

    const auto scan = bone::open_scan(file, {}, {}).take(diagnostics);
    require_reason(scan.has_value(), diagnostics);
    if (!scan || scan->grid().all().voxels() > few) return scan.has_value();
    const auto image = scan->read(scan->grid().all(), 0, {}).take(diagnostics);
    require_reason(image.has_value(), diagnostics);
    if (!image) return false;
    require(image->values.size() == scan->grid().all().voxels(), "all voxels are there, and no others");
    require(std::all_of(image->values.begin(), image->values.end(), [](float value) { return std::isfinite(value); }),
            "every voxel is a number");
    return true;
}
