// SPDX-License-Identifier: Apache-2.0
#include "core/import/image/image_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/import/image/packed_bytes.h"
#include "kerf/math.hpp"

namespace kerf {
namespace {

constexpr int least_edge = 2, most_edge = 4096;  // [voxels]
constexpr std::uint64_t most_voxels = 512ull * 1024 * 1024;
constexpr double least_spacing = 1e-3, most_spacing = 100.0;  // [mm]
constexpr std::size_t most_header = 64 * 1024;                // [bytes] of text
constexpr int most_layers = 64, most_segments = 1000;         // of a segmentation

/// What is wrong with the file; becomes a Diagnostic at the only way out.
struct Refusal {
    const char* code;
    std::string message, advice;
};

[[noreturn]] void refuse(const char* code, std::string message, std::string advice) {
    throw Refusal{code, std::move(message), std::move(advice)};
}

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return result;
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blank = " \t\r\n";
    const std::size_t begin = text.find_first_not_of(blank);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(blank) - begin + 1);
}

/// A piece of the file that may be shown to a person: short, and without control characters.
std::string shown(std::string_view text) {
    std::string result(text.substr(0, 60));
    for (char& c : result)
        if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
    return result;
}

std::string number_text(double value) {
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 6);
    return std::string(text, end.ptr);
}

std::vector<std::string_view> words_of(std::string_view text, std::string_view separators = " \t\r,()") {
    std::vector<std::string_view> words;
    for (std::size_t at = 0; (at = text.find_first_not_of(separators, at)) != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
        words.push_back(text.substr(at, end - at));
        at = end;
    }
    return words;
}

/// Numbers separated by blanks, commas or parentheses.
template <class Number>
std::vector<Number> numbers_of(std::string_view text, const std::string& field) {
    std::vector<Number> numbers;
    for (const std::string_view word : words_of(text)) {
        Number value{};
        const auto end = std::from_chars(word.data(), word.data() + word.size(), value);
        if (end.ec != std::errc{} || end.ptr != word.data() + word.size())
            refuse("E0622", "`" + field + "` in the header is \"" + shown(text) + "\", must be numbers.",
                   "Export the image again.");
        numbers.push_back(value);
    }
    return numbers;
}

// ---- checks that all formats share --------------------------------------------------------------------------------

void check_size(const std::vector<long long>& size, ImageFile& image) {
    std::string text;
    for (const long long n : size) text += (text.empty() ? "" : " × ") + std::to_string(n);
    if (size.size() != 3)
        refuse("E0623", "the image has " + std::to_string(size.size()) + " dimension(s), must have 3.",
               "Export a single volume, not a slice, a series over time or colours.");
    for (const long long n : size)
        if (n < least_edge || n > most_edge)
            refuse("E0624", "the header says " + text + " voxels, each axis must have 2 … 4096.",
                   "Crop the image, or export it again if the header is wrong.");
    for (std::size_t axis = 0; axis < 3; ++axis) image.size[axis] = static_cast<int>(size[axis]);
    if (image.voxels() * static_cast<std::uint64_t>(image.layers) > most_voxels)
        refuse("E0624", "the header says " + text + " voxels, at most 512 million can be read.", "Crop the image.");
}

/// The steps from voxel to voxel along i, j, k, and the place of the first one [mm].
struct Placement {
    std::array<Vec3, 3> steps{};
    Vec3 origin{};
};

void check_placement(const Placement& placement) {
    const auto& [steps, origin] = placement;
    for (const Vec3& step : steps) {
        const double spacing = length(step);
        if (!(spacing >= least_spacing && spacing <= most_spacing))
            refuse("E0627", "a voxel is " + number_text(spacing) + " mm wide, must be 0.001 mm … 100 mm.",
                   "Export the image again, with its spacing in millimetres.");
    }
    const double volume = length(steps[0]) * length(steps[1]) * length(steps[2]);
    if (!(std::abs(dot(steps[0], cross(steps[1], steps[2]))) > 1e-3 * volume))
        refuse("E0627", "the three axes of the image lie in one plane.", "Export the image again.");
    if (!is_finite(origin) || length(origin) > 1e5)
        refuse("E0627", "the image's origin is no finite place within 100 m.", "Export the image again.");
}

/// Checks a placement and keeps it in LPS: `to_lps` is 1 or −1 for every axis of the patient.
void place(ImageFile& image, const Placement& placement, Vec3 to_lps) {
    check_placement(placement);
    for (std::size_t axis = 0; axis < 4; ++axis) {
        const Vec3 v = 1e-3 * (axis < 3 ? placement.steps[axis] : placement.origin);
        image.lps_from_index[axis] = to_lps.x * v.x;
        image.lps_from_index[4 + axis] = to_lps.y * v.y;
        image.lps_from_index[8 + axis] = to_lps.z * v.z;
    }
}

// ---- bytes ---------------------------------------------------------------------------------------------------------

std::uint64_t size_of_file(const std::string& file) {
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (error || !std::filesystem::exists(status))
        refuse("E0620", "there is no such file.", "Check the name, and the folder it is in.");
    if (!std::filesystem::is_regular_file(status)) refuse("E0620", "this is no regular file.", "Name an image file.");
    const auto size = std::filesystem::file_size(file, error);
    if (error) refuse("E0620", "its size cannot be read.", "Check the permissions.");
    return size;
}

std::ifstream opened(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) refuse("E0620", "the file cannot be opened.", "Check the permissions.");
    return in;
}

std::string first_bytes(const std::string& file, std::size_t count) {
    std::ifstream in = opened(file);
    std::string bytes(count, '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(count));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
    return bytes;
}

[[noreturn]] void refuse_truncated(std::uint64_t got, std::uint64_t need, const std::string& of) {
    refuse("E0626", of + " has " + std::to_string(got) + " bytes, the header promises " + std::to_string(need) + ".",
           "Copy the file again: it is cut short, or its header is wrong.");
}

/// How many bytes can be unpacked, at most `wanted`.
std::uint64_t unpacked_bytes(const std::string& file, std::uint64_t offset, std::uint64_t wanted) {
    PackedBytes bytes(file, offset, PackedBytes::Packing::deflated);
    if (!bytes.is_open()) refuse("E0620", "the file cannot be opened.", "Check the permissions.");
    const std::uint64_t total = bytes.take(nullptr, wanted);
    if (bytes.is_damaged())
        refuse("E0626", "its compressed data are damaged after " + std::to_string(total) + " bytes.",
               "Copy the file again.");
    return total;
}

void check_bytes(const ImageFile& image) {
    const std::uint64_t file_size = size_of_file(image.data_file);
    const std::uint64_t need = image.data_offset + image.data_bytes();
    if (image.packing == ImageFile::Packing::raw) {
        if (file_size < need) refuse_truncated(file_size, need, "the file with the voxels");
    } else if (image.packing == ImageFile::Packing::gzip_file) {
        const std::uint64_t got = unpacked_bytes(image.data_file, 0, need);
        if (got < need) refuse_truncated(got, need, "unpacked, the file");
    } else {
        const std::uint64_t got = unpacked_bytes(image.data_file, image.data_offset, image.data_bytes());
        if (got < image.data_bytes()) refuse_truncated(got, image.data_bytes(), "unpacked, the block of voxels");
    }
}

// ---- NIfTI-1 --------------------------------------------------------------------------------------------------------

constexpr std::size_t nifti_header = 348;  // [bytes]

/// One number of the header, in the byte order of the file.
template <class Number>
Number nifti_field(const std::string& header, std::size_t at, bool is_swapped) {
    char bytes[sizeof(Number)];
    std::memcpy(bytes, header.data() + at, sizeof bytes);
    if (is_swapped) std::reverse(std::begin(bytes), std::end(bytes));
    Number value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

std::optional<ImageFile::Number> nifti_number(int type) {
    using Number = ImageFile::Number;
    static const std::map<int, Number> known{{256, Number::int8},   {2, Number::uint8},   {4, Number::int16},
                                             {512, Number::uint16}, {8, Number::int32},   {768, Number::uint32},
                                             {16, Number::float32}, {64, Number::float64}};
    const auto found = known.find(type);
    return found == known.end() ? std::nullopt : std::optional(found->second);
}

/// Rotation of `qform` times the spacing: unit quaternion (a, b, c, d) of which b, c, d are written; the sign of the
/// third axis is `pixdim[0]`. Source: nifti1.h, method 2.
Placement placement_by_quaternion(Vec3 bcd, Vec3 spacing, double sign, Vec3 origin) {
    const double b = bcd.x, c = bcd.y, d = bcd.z;
    const double a = std::sqrt(std::max(0.0, 1.0 - b * b - c * c - d * d));
    const Vec3 i{a * a + b * b - c * c - d * d, 2.0 * (b * c + a * d), 2.0 * (b * d - a * c)};
    const Vec3 j{2.0 * (b * c - a * d), a * a + c * c - b * b - d * d, 2.0 * (c * d + a * b)};
    const Vec3 k{2.0 * (b * d + a * c), 2.0 * (c * d - a * b), a * a + d * d - b * b - c * c};
    return {{spacing.x * i, spacing.y * j, (sign * spacing.z) * k}, origin};
}

/// The largest distance between the places that two placements give a voxel of the image [mm].
double disagreement(const Placement& a, const Placement& b, const std::array<int, 3>& size) {
    double most = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 apart = a.origin - b.origin;
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (corner >> axis & 1)
                apart = apart + static_cast<double>(size[axis] - 1) * (a.steps[axis] - b.steps[axis]);
        most = std::max(most, length(apart));
    }
    return most;
}

/// `sform` where there is one, or else `qform`. Where both are there and differ, that is a doubt.
void place_nifti(const std::string& header, bool is_swapped, ImageFile& image) {
    const auto real = [&](std::size_t at) { return static_cast<double>(nifti_field<float>(header, at, is_swapped)); };
    const auto word = [&](std::size_t at) { return nifti_field<std::int16_t>(header, at, is_swapped); };
    const int unit = static_cast<unsigned char>(header[123]) & 7;
    const double mm = unit == 1 ? 1000.0 : unit == 3 ? 0.001 : 1.0;  // metres, micrometres; unknown means millimetres
    constexpr Vec3 ras{-1, -1, 1};

    const Vec3 spacing{mm * real(80), mm * real(84), mm * real(88)};
    for (const double s : {spacing.x, spacing.y, spacing.z})
        if (!(s > 0.0))
            refuse("E0627", "`pixdim` is " + number_text(s) + ", must be above 0 mm.", "Export the image again.");
    std::optional<Placement> by_matrix, by_quaternion;
    if (word(254) > 0) {
        by_matrix.emplace();
        for (std::size_t axis = 0; axis < 3; ++axis)
            by_matrix->steps[axis] = mm * Vec3{real(280 + 4 * axis), real(296 + 4 * axis), real(312 + 4 * axis)};
        by_matrix->origin = mm * Vec3{real(292), real(308), real(324)};
        check_placement(*by_matrix);
    }
    if (word(252) > 0) {
        const Vec3 quaternion{real(256), real(260), real(264)};
        if (!is_finite(quaternion) || length(quaternion) > 1.001)
            refuse("E0627", "the rotation of `qform` is no unit quaternion.", "Export the image again.");
        by_quaternion = placement_by_quaternion(quaternion, spacing, real(76) < 0.0 ? -1.0 : 1.0,
                                                mm * Vec3{real(268), real(272), real(276)});
        check_placement(*by_quaternion);
    }
    if (!by_matrix && !by_quaternion)
        refuse("E0627", "neither `qform_code` nor `sform_code` is above 0: nobody can tell left from right.",
               "Export the image with its orientation.");
    if (by_matrix && by_quaternion) {
        constexpr double same = 0.1;  // [mm]: headers are single precision, over the width of a body
        if (const double apart = disagreement(*by_matrix, *by_quaternion, image.size); apart > same)
            image.doubts.push_back("`sform` and `qform` of the file place voxels up to " + number_text(apart) +
                                   " mm apart; `sform` was taken.");
    }
    place(image, by_matrix ? *by_matrix : *by_quaternion, ras);
}

ImageFile check_nifti(const std::string& file, bool is_packed) {
    std::string header;
    if (is_packed) {
        if (first_bytes(file, 2) != "\x1f\x8b")
            refuse("E0622", "the name ends in .gz, but this is no gzip file.", "Rename it to .nii, or compress it.");
        header.resize(nifti_header);
        header.resize(PackedBytes(file, 0, PackedBytes::Packing::deflated).take(header.data(), nifti_header));
    } else {
        header = first_bytes(file, nifti_header);
    }
    if (header.size() < nifti_header) refuse_truncated(header.size(), nifti_header, "the file's header");

    bool is_swapped = false;
    for (const bool swapped : {false, true})
        if (nifti_field<std::int32_t>(header, 0, swapped) == 540)
            refuse("E0622", "this is NIfTI-2.", "Export it as NIfTI-1.");
    if (nifti_field<std::int32_t>(header, 0, false) != 348) is_swapped = true;
    if (nifti_field<std::int32_t>(header, 0, is_swapped) != 348 || std::memcmp(header.data() + 344, "n+1\0", 4) != 0)
        refuse("E0622", "this is no NIfTI-1 file with its voxels in it.", "Export the image as .nii or .nii.gz.");

    const auto word = [&](std::size_t at) { return nifti_field<std::int16_t>(header, at, is_swapped); };
    ImageFile image;
    image.format = ImageFile::Format::nifti;
    image.packing = is_packed ? ImageFile::Packing::gzip_file : ImageFile::Packing::raw;
    image.data_file = file;
    const int dimensions = word(40);
    std::vector<long long> size;
    for (int axis = 0; axis < std::clamp(dimensions, 0, 7); ++axis)
        if (const int n = word(42 + 2 * static_cast<std::size_t>(axis)); axis < 3 || n != 1) size.push_back(n);
    check_size(size, image);

    const int type = word(70);
    const auto number = nifti_number(type);
    if (!number)
        refuse("E0625",
               "the header names voxel type " + std::to_string(type) + ", must be an integer or float of 1 to 8 bytes.",
               "Export the image as 16-bit integers.");
    image.number = *number;
    image.is_big_endian = is_swapped;  // as everything is that Kerf runs on, the reader is little endian
    if (word(72) != 8 * image.bytes_per_voxel())
        refuse("E0622",
               "`bitpix` is " + std::to_string(word(72)) + ", but the voxel type has " +
                   std::to_string(8 * image.bytes_per_voxel()) + " bits.",
               "Export the image again.");
    const auto offset = static_cast<double>(nifti_field<float>(header, 108, is_swapped));
    if (!(offset >= 352.0 && offset <= 16.0 * 1024 * 1024) || offset != std::floor(offset))
        refuse("E0622", "`vox_offset` is " + number_text(offset) + ", must be 352 or more.", "Export the image again.");
    image.data_offset = static_cast<std::uint64_t>(offset);
    for (const std::size_t at : {std::size_t{112}, std::size_t{116}})
        if (!std::isfinite(nifti_field<float>(header, at, is_swapped)))
            refuse("E0622", "`scl_slope` or `scl_inter` is no finite number.", "Export the image again.");
    if (const auto slope = static_cast<double>(nifti_field<float>(header, 112, is_swapped));
        slope != 0.0) {  // 0 means that neither counts
        image.slope = slope;
        image.intercept = static_cast<double>(nifti_field<float>(header, 116, is_swapped));
    }
    place_nifti(header, is_swapped, image);
    return image;
}

// ---- headers of text ------------------------------------------------------------------------------------------------

using Fields = std::map<std::string, std::string>;

const std::string* find(const Fields& fields, std::initializer_list<const char*> names) {
    const std::string* found = nullptr;
    for (const char* name : names)
        if (const auto at = fields.find(name); at != fields.end()) {
            if (found) refuse("E0622", "the header has two names for `" + at->first + "`.", "Remove one.");
            found = &at->second;
        }
    return found;
}

const std::string& need(const Fields& fields, std::initializer_list<const char*> names) {
    if (const std::string* found = find(fields, names)) return *found;
    refuse("E0622", "the header has no `" + std::string(*names.begin()) + "`.", "Export the image again.");
}

void add(Fields& fields, std::string_view name, std::string_view value) {
    if (!fields.emplace(lower(trimmed(name)), std::string(trimmed(value))).second)
        refuse("E0622", "the header has `" + shown(trimmed(name)) + "` twice.", "Export the image again.");
}

ImageFile::Number named_number(const std::string& type) {
    using Number = ImageFile::Number;
    static const std::map<std::string, Number> known{{"signed char", Number::int8},
                                                     {"int8", Number::int8},
                                                     {"int8_t", Number::int8},
                                                     {"uchar", Number::uint8},
                                                     {"unsigned char", Number::uint8},
                                                     {"uint8", Number::uint8},
                                                     {"uint8_t", Number::uint8},
                                                     {"short", Number::int16},
                                                     {"short int", Number::int16},
                                                     {"signed short", Number::int16},
                                                     {"signed short int", Number::int16},
                                                     {"int16", Number::int16},
                                                     {"int16_t", Number::int16},
                                                     {"ushort", Number::uint16},
                                                     {"unsigned short", Number::uint16},
                                                     {"unsigned short int", Number::uint16},
                                                     {"uint16", Number::uint16},
                                                     {"uint16_t", Number::uint16},
                                                     {"int", Number::int32},
                                                     {"signed int", Number::int32},
                                                     {"int32", Number::int32},
                                                     {"int32_t", Number::int32},
                                                     {"uint", Number::uint32},
                                                     {"unsigned int", Number::uint32},
                                                     {"uint32", Number::uint32},
                                                     {"uint32_t", Number::uint32},
                                                     {"float", Number::float32},
                                                     {"double", Number::float64},
                                                     {"met_char", Number::int8},
                                                     {"met_uchar", Number::uint8},
                                                     {"met_short", Number::int16},
                                                     {"met_ushort", Number::uint16},
                                                     {"met_int", Number::int32},
                                                     {"met_uint", Number::uint32},
                                                     {"met_float", Number::float32},
                                                     {"met_double", Number::float64}};
    const auto found = known.find(lower(type));
    if (found == known.end())
        refuse("E0625",
               "the header names voxel type `" + shown(type) + "`, must be an integer or float of 1 to 8 bytes.",
               "Export the image as 16-bit integers.");
    return found->second;
}

// ---- NRRD -----------------------------------------------------------------------------------------------------------

/// What 3D Slicer writes of each segment: `Segment0_Name`, `Segment0_LabelValue`, `Segment0_Layer`.
std::vector<Segment> segments_of(const Fields& remarks, int layers) {
    const auto whole = [&](const std::string& key, int otherwise) {
        const auto at = remarks.find(key);
        if (at == remarks.end()) return otherwise;
        const auto value = numbers_of<int>(at->second, key);
        if (value.size() != 1)
            refuse("E0622", "`" + key + "` must be one whole number.", "Export the segmentation again.");
        return value[0];
    };
    std::vector<Segment> segments;
    for (int n = 0; n < most_segments; ++n) {
        const std::string prefix = "Segment" + std::to_string(n) + "_";
        const auto name = remarks.find(prefix + "Name");
        if (name == remarks.end()) break;
        Segment segment{std::string(trimmed(name->second)), whole(prefix + "LabelValue", 1),
                        whole(prefix + "Layer", 0)};
        if (segment.layer < 0 || segment.layer >= layers)
            refuse("E0622",
                   "`" + prefix + "Layer` is " + std::to_string(segment.layer) + ", but the layers are 0 … " +
                       std::to_string(layers - 1) + ".",
                   "Export the segmentation again.");
        segments.push_back(std::move(segment));
    }
    return segments;
}

ImageFile check_nrrd(const std::string& file) {
    const std::string text = first_bytes(file, most_header);
    if (text.compare(0, 7, "NRRD000") != 0)
        refuse("E0622", "this is no NRRD file.", "Export the image as .nrrd, .nii.gz or .mha.");
    Fields fields, remarks;
    std::size_t at = 0;
    bool has_end = false;
    for (bool is_first = true; at < text.size(); is_first = false) {
        const std::size_t end = text.find('\n', at);
        if (end == std::string::npos) break;
        const std::string_view line = trimmed(std::string_view(text).substr(at, end - at));
        at = end + 1;
        if (line.empty()) {
            has_end = true;
            break;
        }
        if (is_first || line[0] == '#') continue;
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos)
            refuse("E0622", "the header has the line \"" + shown(line) + "\".", "Export the image again.");
        if (colon + 1 < line.size() && line[colon + 1] == '=') {  // a remark of whoever wrote it
            remarks.emplace(line.substr(0, colon), line.substr(colon + 2));
            continue;
        }
        add(fields, line.substr(0, colon), line.substr(colon + 1));
    }
    if (find(fields, {"data file", "datafile"}))
        refuse("E0622", "the voxels are in another file.", "Export the image as one .nrrd.");
    if (!has_end) refuse("E0626", "the header does not end.", "Copy the file again: it is cut short.");
    for (const char* skip : {"line skip", "lineskip", "byte skip", "byteskip"})
        if (const std::string* found = find(fields, {skip}); found && *found != "0")
            refuse("E0622", "the header has `" + std::string(skip) + "`.", "Export the image again.");

    ImageFile image;
    image.format = ImageFile::Format::nrrd;
    image.data_file = file;
    image.data_offset = at;
    auto sizes = numbers_of<long long>(need(fields, {"sizes"}), "sizes");
    const auto dimension = numbers_of<long long>(need(fields, {"dimension"}), "dimension");
    if (dimension.size() != 1 || dimension[0] != static_cast<long long>(sizes.size()))
        refuse("E0622", "`dimension` and the number of `sizes` differ.", "Export the image again.");
    const std::string* kinds = find(fields, {"kinds"});
    if (sizes.size() == 4 && kinds && lower(*kinds).rfind("list", 0) == 0) {  // a segmentation in layers
        if (sizes[0] < 1 || sizes[0] > most_layers)
            refuse("E0623", "the segmentation has " + std::to_string(sizes[0]) + " layers, must have 1 … 64.",
                   "Export one segment at a time.");
        image.layers = static_cast<int>(sizes[0]);
        sizes.erase(sizes.begin());
    }
    check_size(sizes, image);
    image.number = named_number(need(fields, {"type"}));
    if (image.bytes_per_voxel() > 1) {
        const std::string endian = lower(need(fields, {"endian"}));
        if (endian != "little" && endian != "big")
            refuse("E0622", "`endian` is \"" + shown(endian) + "\", must be little or big.", "Export the image again.");
        image.is_big_endian = endian == "big";
    }

    const std::string encoding = lower(need(fields, {"encoding"}));
    if (encoding == "gzip" || encoding == "gz")
        image.packing = ImageFile::Packing::deflated;
    else if (encoding != "raw")
        refuse("E0625", "the encoding is `" + shown(encoding) + "`, must be raw or gzip.",
               "Export the image with gzip.");

    const std::string space = lower(need(fields, {"space"}));
    static const std::array<const char*, 6> spaces{"left-posterior-superior", "lps", "right-anterior-superior", "ras",
                                                   "left-anterior-superior",  "las"};
    if (std::find(spaces.begin(), spaces.end(), space) == spaces.end())
        refuse("E0627", "`space` is \"" + shown(space) + "\": nobody can tell left from right.",
               "Export the image with space: left-posterior-superior.");
    if (find(fields, {"space units"}) && need(fields, {"space units"}) != "\"mm\" \"mm\" \"mm\"")
        refuse("E0627", "`space units` is not \"mm\" three times.", "Export the image in millimetres.");
    std::string_view steps = trimmed(need(fields, {"space directions"}));
    if (image.layers > 1 || steps.rfind("none", 0) == 0) steps.remove_prefix(std::min<std::size_t>(4, steps.size()));
    const auto directions = numbers_of<double>(steps, "space directions");
    const auto origin = numbers_of<double>(need(fields, {"space origin"}), "space origin");
    if (directions.size() != 9 || origin.size() != 3)
        refuse("E0627", "`space directions` needs three vectors, `space origin` one.", "Export the image again.");
    const auto vector = [&](std::size_t i) { return Vec3{directions[i], directions[i + 1], directions[i + 2]}; };
    const bool is_lps = space == "lps" || space == "left-posterior-superior";
    const Vec3 to_lps{space[0] == 'r' ? -1.0 : 1.0, is_lps ? 1.0 : -1.0, 1.0};
    place(image, {{vector(0), vector(3), vector(6)}, {origin[0], origin[1], origin[2]}}, to_lps);
    image.segments = segments_of(remarks, image.layers);
    return image;
}

// ---- MetaImage ------------------------------------------------------------------------------------------------------

bool is_true(const Fields& fields, std::initializer_list<const char*> names, bool otherwise) {
    const std::string* value = find(fields, names);
    if (!value) return otherwise;
    const std::string word = lower(*value);
    if (word == "true" || word == "1") return true;
    if (word == "false" || word == "0") return false;
    refuse("E0622", "`" + std::string(*names.begin()) + "` is \"" + shown(*value) + "\", must be True or False.",
           "Export the image again.");
}

ImageFile check_meta(const std::string& file) {
    const std::string text = first_bytes(file, most_header);
    Fields fields;
    std::size_t at = 0;
    while (at < text.size() && !fields.contains("elementdatafile")) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = trimmed(std::string_view(text).substr(at, end - at));
        at = std::min(end + 1, text.size());
        if (line.empty()) continue;
        const std::size_t equals = line.find('=');
        if (equals == std::string_view::npos)
            refuse("E0622", "the header has the line \"" + shown(line) + "\".",
                   "Export the image as .mha, .nrrd or .nii.gz.");
        add(fields, line.substr(0, equals), line.substr(equals + 1));
    }
    const std::string& data = need(fields, {"elementdatafile"});

    ImageFile image;
    image.format = ImageFile::Format::meta;
    const auto sizes = numbers_of<long long>(need(fields, {"dimsize"}), "DimSize");
    const auto dimensions = numbers_of<long long>(need(fields, {"ndims"}), "NDims");
    if (dimensions.size() != 1 || dimensions[0] != static_cast<long long>(sizes.size()))
        refuse("E0622", "`NDims` and the number of sizes in `DimSize` differ.", "Export the image again.");
    check_size(sizes, image);
    image.number = named_number(need(fields, {"elementtype"}));
    if (const std::string* channels = find(fields, {"elementnumberofchannels"}); channels && *channels != "1")
        refuse("E0623", "there are " + shown(*channels) + " numbers per voxel, must be 1.", "Export a single channel.");
    if (!is_true(fields, {"binarydata"}, true))
        refuse("E0625", "the voxels are written as text.", "Export the image with binary data.");
    image.is_big_endian = is_true(fields, {"binarydatabyteordermsb", "elementbyteordermsb"}, false);
    if (is_true(fields, {"compresseddata"}, false)) image.packing = ImageFile::Packing::deflated;
    if (const std::string* skip = find(fields, {"headersize"}); skip && *skip != "0")
        refuse("E0622", "the header has `HeaderSize`.", "Export the image again.");

    const auto spacing = numbers_of<double>(need(fields, {"elementspacing"}), "ElementSpacing");
    if (spacing.size() != 3) refuse("E0627", "`ElementSpacing` needs three numbers.", "Export the image again.");
    for (const double s : spacing)
        if (!(s > 0.0))
            refuse("E0627", "`ElementSpacing` is " + number_text(s) + ", must be above 0 mm.",
                   "Export the image again.");
    const std::string* rotation = find(fields, {"transformmatrix", "rotation", "orientation"});
    const auto matrix = numbers_of<double>(rotation ? *rotation : "1 0 0 0 1 0 0 0 1", "TransformMatrix");
    const std::string* offset = find(fields, {"offset", "position", "origin"});
    if (!offset)
        refuse("E0627", "the header has no `Offset`: nobody can tell where in the patient the voxels are.",
               "Export the image with its position.");
    if (!rotation)
        image.doubts.push_back(
            "The header has no `TransformMatrix`; the axes were taken to point to the patient's left, back and head.");
    const auto origin = numbers_of<double>(*offset, "Offset");
    if (matrix.size() != 9 || origin.size() != 3)
        refuse("E0627", "`TransformMatrix` needs nine numbers, `Offset` three.", "Export the image again.");
    std::array<Vec3, 3> steps;
    for (std::size_t axis = 0; axis < 3; ++axis)
        steps[axis] = spacing[axis] * Vec3{matrix[3 * axis], matrix[3 * axis + 1], matrix[3 * axis + 2]};
    place(image, {steps, {origin[0], origin[1], origin[2]}}, {1, 1, 1});

    if (lower(data) == "local") {
        image.data_file = file;
        image.data_offset = at;
        return image;
    }
    const std::filesystem::path name(data);
    if (data.find_first_of("/\\%* ") != std::string::npos || lower(data) == "list" || name.filename() != name ||
        name == "..")
        refuse("E0622",
               "the voxels are in \"" + shown(data) + "\", must be one file beside the header, without blanks.",
               "Export the image as one .mha.");
    image.data_file = (std::filesystem::path(file).parent_path() / name).string();
    return image;
}

bool ends_in(const std::string& name, std::string_view ending) {
    return name.size() > ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

ImageFile checked(const std::string& file) {
    size_of_file(file);
    const std::string name = lower(file);
    ImageFile image;
    if (ends_in(name, ".nii"))
        image = check_nifti(file, false);
    else if (ends_in(name, ".nii.gz"))
        image = check_nifti(file, true);
    else if (ends_in(name, ".nrrd"))
        image = check_nrrd(file);
    else if (ends_in(name, ".mha") || ends_in(name, ".mhd"))
        image = check_meta(file);
    else
        refuse("E0621", "the file's ending names no format that can be read.",
               "Use NIfTI (.nii, .nii.gz), NRRD (.nrrd) or MetaImage (.mha, .mhd); for a surface STL, OBJ or PLY.");
    check_bytes(image);
    return image;
}

}  // namespace

std::optional<ImageFile> check_image_file(const std::string& file, Diagnostics& diagnostics) {
    try {
        return checked(file);
    } catch (const Refusal& refusal) {
        diagnostics.push_back(error_about(file, refusal.code, refusal.message + " " + refusal.advice));
    } catch (const std::exception& error) {  // no memory, or a name that is no path
        diagnostics.push_back(
            error_about(file, "E0620", std::string("the file cannot be checked: ") + error.what() + "."));
    }
    return std::nullopt;
}

}  // namespace kerf
