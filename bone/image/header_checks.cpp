// SPDX-License-Identifier: Apache-2.0
#include "bone/image/header_checks.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <ios>
#include <system_error>
#include <utility>

#include "text/inside_folder.h"
#include "text/printable.h"
#include "text/regular_file.h"

namespace kerf::bone::header {
namespace {

constexpr int min_edge = 2, max_edge = 4096;  // [voxels]
constexpr std::uint64_t max_voxels = 512ull * 1024 * 1024;
constexpr double min_spacing = 1e-3, max_spacing = 100.0;  // [mm]

}  // namespace

void refuse(const char* code, std::string message, std::string advice) {
    throw HeaderError{code, std::move(message), std::move(advice)};
}

void refuse_truncated(std::uint64_t got, std::uint64_t need, const std::string& of) {
    refuse("E0626", of + " has " + std::to_string(got) + " bytes, the header promises " + std::to_string(need) + ".",
           "Copy the file again: it is cut short, or its header is wrong.");
}

std::string number_text(double value) {
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 6);
    return std::string(text, end.ptr);
}

std::optional<double> millimetres_in(std::string_view unit) {
    std::string lower(unit);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    for (const char* plural : {"meters", "metres", "microns"})
        if (lower.ends_with(plural)) lower.pop_back();
    for (const char* one : {"mm", "millimeter", "millimetre"})
        if (lower == one) return 1.0;
    for (const char* one : {"cm", "centimeter", "centimetre"})
        if (lower == one) return 10.0;
    for (const char* one : {"m", "meter", "metre"})
        if (lower == one) return 1000.0;
    // The micro sign and the Greek letter mu are different characters.
    for (const char* one : {"um", "\xc2\xb5m", "\xce\xbcm", "micron", "micrometer", "micrometre"})
        if (lower == one) return 1e-3;
    return std::nullopt;
}

void check_size(const std::vector<long long>& size, ImageFile& image) {
    std::string text;
    for (const long long n : size) text += (text.empty() ? "" : " × ") + std::to_string(n);
    if (size.size() != 3)
        refuse("E0623", "the image has " + std::to_string(size.size()) + " dimension(s), must have 3.",
               "Export a single volume, not a slice, a series over time or colours.");
    for (const long long n : size)
        if (n < min_edge || n > max_edge)
            refuse("E0624", "the header says " + text + " voxels, each axis must have 2 … 4096.",
                   "Crop the image, or export it again if the header is wrong.");
    for (std::size_t axis = 0; axis < 3; ++axis) image.size[axis] = static_cast<int>(size[axis]);
    if (image.voxels() * static_cast<std::uint64_t>(image.layers) > max_voxels)
        refuse("E0624", "the header says " + text + " voxels, at most 512 million can be read.", "Crop the image.");
}

void check_placement(const Placement& placement) {
    const auto& [steps, origin] = placement;
    for (const Vec3& step : steps) {
        const double spacing = length(step);
        if (!(spacing >= min_spacing && spacing <= max_spacing))
            refuse("E0627", "a voxel is " + number_text(spacing) + " mm wide, must be 0.001 mm … 100 mm.",
                   "Export the image again, with its spacing in millimetres.");
    }
    const double volume = length(steps[0]) * length(steps[1]) * length(steps[2]);
    if (!(std::abs(dot(steps[0], cross(steps[1], steps[2]))) > 1e-3 * volume))
        refuse("E0627", "the three axes of the image lie in one plane.", "Export the image again.");
    if (!is_finite(origin) || length(origin) > 1e5)
        refuse("E0627", "the image's origin is no finite place within 100 m.", "Export the image again.");
}

void place(ImageFile& image, const Placement& placement, Vec3 to_lps) {
    check_placement(placement);
    for (std::size_t axis = 0; axis < 4; ++axis) {
        const Vec3 v = 1e-3 * (axis < 3 ? placement.steps[axis] : placement.origin);
        image.lps_from_index[axis] = to_lps.x * v.x;
        image.lps_from_index[4 + axis] = to_lps.y * v.y;
        image.lps_from_index[8 + axis] = to_lps.z * v.z;
    }
}

bool differ(double a, double b, double tolerance) {
    return !(std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b)));
}

std::uint64_t size_of_file(const std::string& file) {
    if (const auto fault = text::fault_of_file(file)) refuse("E0620", fault->problem, fault->advice);
    std::error_code error;
    const auto size = std::filesystem::file_size(file, error);
    if (error) refuse("E0620", "its size cannot be read.", "Check the permissions.");
    return size;
}

std::string first_bytes(const std::string& file, std::size_t count) {
    std::ifstream in = text::open_regular_file(file);
    if (!in) refuse("E0620", "the file cannot be opened.", "Check the permissions.");
    std::string bytes(count, '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(count));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
    return bytes;
}

std::string data_file_of(const std::string& header, const std::string& name, const char* field) {
    const std::filesystem::path written(name);
    const bool is_one_file = name.find_first_of("\\%*?") == std::string::npos && !written.is_absolute();
    const bool leaves = std::find(written.begin(), written.end(), "..") != written.end();
    const std::string folder = std::filesystem::path(header).parent_path().string();
    if (name.empty() || !is_one_file || leaves)
        refuse("E0622",
               "`" + std::string(field) + "` names the voxels' file \"" + text::excerpt(name) +
                   "\", must be one file beside the header, or in a folder beside it.",
               "Put the file there, or export the image as one file.");
    std::string file = (std::filesystem::path(folder) / written).string();
    if (!text::is_inside_folder(file, folder))
        refuse("E0619",
               "`" + std::string(field) + "` names \"" + text::excerpt(name) +
                   "\", a link that leads out of the header's folder.",
               "Put the file itself there.");
    return file;
}

}  // namespace kerf::bone::header
