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

/// Functions for the readers of all image headers. A reader throws a Refusal; `check_image_file()` reports it.
namespace kerf::bone::header {

struct HeaderError {
    const char* code;
    std::string message, advice;
};
[[noreturn]] void refuse(const char* code, std::string message, std::string advice);
[[noreturn]] void refuse_truncated(std::uint64_t got, std::uint64_t need, const std::string& of);

/// Returns a number as text with six significant digits, in any locale.
[[nodiscard]] std::string number_text(double value);

/// Returns the millimetres per unit: mm, cm, m, um and their names. Returns nothing for an unknown unit.
[[nodiscard]] std::optional<double> millimetres_in(std::string_view unit);

/// Stores the size. Refuses an image that is not a volume (E0623) or is too large (E0624).
void check_size(const std::vector<long long>& size, ImageFile& image);

/// The steps from voxel to voxel along i, j, k, and the position of the first voxel [mm].
struct Placement {
    std::array<Vec3, 3> steps{};
    Vec3 origin{};
};
void check_placement(const Placement& placement);

/// Checks a placement and stores it in LPS: `to_lps` is 1 or −1 for each axis of the patient.
void place(ImageFile& image, const Placement& placement, Vec3 to_lps);

/// Returns whether two sizes in one header differ by more than rounding. Many programs write few digits.
[[nodiscard]] bool differ(double a, double b, double tolerance);

[[nodiscard]] std::uint64_t size_of_file(const std::string& file);
[[nodiscard]] std::string first_bytes(const std::string& file, std::size_t count);

/// Returns the path of the file that a header names for its voxels. It must be a regular file in the header's folder or
/// below it, also after all links are followed. `field` is the header field with the name.
[[nodiscard]] std::string data_file_of(const std::string& header, const std::string& name, const char* field);

/// Each reads the header of one format. They do not count the bytes of the voxels.
[[nodiscard]] ImageFile read_nifti(const std::string& file, bool is_packed);
[[nodiscard]] ImageFile read_nrrd(const std::string& file);
[[nodiscard]] ImageFile read_meta(const std::string& file);

}  // namespace kerf::bone::header
