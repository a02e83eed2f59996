// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bone/image/image_file.h"
#include "kerf/math.hpp"

/// What the readers of all image headers share. A reader throws a Refusal; `check_image_file()` reports it.
namespace kerf::header {

struct Refusal {
    const char* code;
    std::string message, advice;
};
[[noreturn]] void refuse(const char* code, std::string message, std::string advice);
[[noreturn]] void refuse_truncated(std::uint64_t got, std::uint64_t need, const std::string& of);

/// A number with six significant digits, whatever the locale.
[[nodiscard]] std::string number_text(double value);

/// Millimetres in one of the unit: mm, cm, m, um and their names. None: the unit is not known.
[[nodiscard]] std::optional<double> millimetres_in(std::string_view unit);

/// Keeps the size; refuses what is no volume (E0623) or too large (E0624).
void check_size(const std::vector<long long>& size, ImageFile& image);

/// The steps from voxel to voxel along i, j, k, and the position of the first voxel [mm].
struct Placement {
    std::array<Vec3, 3> steps{};
    Vec3 origin{};
};
void check_placement(const Placement& placement);

/// Checks a placement and keeps it in LPS: `to_lps` is 1 or −1 for every axis of the patient.
void place(ImageFile& image, const Placement& placement, Vec3 to_lps);

/// Whether two sizes in one header differ by more than rounding: `written` is what most programs write with few digits.
[[nodiscard]] bool differ(double a, double b, double share);

[[nodiscard]] std::uint64_t size_of_file(const std::string& file);
[[nodiscard]] std::string first_bytes(const std::string& file, std::size_t count);

/// The file that a header names for its voxels: one regular file in the header's folder or below it, also once all
/// links are followed. `field` is what names it.
[[nodiscard]] std::string data_file_beside(const std::string& header, const std::string& name, const char* field);

/// Each reads one format's header. None of them counts the bytes of the voxels.
[[nodiscard]] ImageFile read_nifti(const std::string& file, bool is_packed);
[[nodiscard]] ImageFile read_nrrd(const std::string& file);
[[nodiscard]] ImageFile read_meta(const std::string& file);

}  // namespace kerf::header
