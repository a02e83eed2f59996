// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bone/image/header_checks.h"
#include "bone/image/packed_bytes.h"

namespace kerf::bone::header {
namespace {

constexpr std::size_t header_size = 348;  // [bytes]

/// The bytes of a header, and its numbers in the byte order of the file. The offsets come from nifti1.h.
class Header {
public:
    explicit Header(std::string bytes) : bytes_(std::move(bytes)) {
        is_swapped_ = number<std::int32_t>(0) != static_cast<std::int32_t>(header_size);
    }
    template <class Number>
    [[nodiscard]] Number number(std::size_t at) const {
        char bytes[sizeof(Number)];
        std::memcpy(bytes, bytes_.data() + at, sizeof bytes);
        if (is_swapped_) std::reverse(std::begin(bytes), std::end(bytes));
        Number value;
        std::memcpy(&value, bytes, sizeof value);
        return value;
    }
    [[nodiscard]] int word(std::size_t at) const { return number<std::int16_t>(at); }
    [[nodiscard]] double real(std::size_t at) const { return static_cast<double>(number<float>(at)); }
    [[nodiscard]] bool is_swapped() const noexcept { return is_swapped_; }
    [[nodiscard]] const std::string& bytes() const noexcept { return bytes_; }

private:
    std::string bytes_;
    bool is_swapped_ = false;
};

ImageFile::Number number_of(int type) {
    using Number = ImageFile::Number;
    static const std::map<int, Number> known{{256, Number::int8},   {2, Number::uint8},     {4, Number::int16},
                                             {512, Number::uint16}, {8, Number::int32},     {768, Number::uint32},
                                             {1024, Number::int64}, {1280, Number::uint64}, {16, Number::float32},
                                             {64, Number::float64}};
    static const std::map<int, const char*> others{
        {1, "single bits"},        {32, "complex numbers"},
        {128, "colours"},          {1536, "floating point numbers of 16 bytes"},
        {1792, "complex numbers"}, {2048, "complex numbers"},
        {2304, "colours"}};
    if (const auto found = known.find(type); found != known.end()) return found->second;
    const auto other = others.find(type);
    refuse(
        "E0625",
        "`datatype` in the header is " + std::to_string(type) +
            (other == others.end() ? std::string(", which NIfTI-1 does not know") : ": " + std::string(other->second)) +
            "; a voxel must be one whole number or floating point number of at most 8 bytes.",
        "Export the image as 16-bit integers.");
}

/// Returns the rotation of `qform` times the spacing. The header has b, c, d of a unit quaternion (a, b, c, d); the
/// sign of the third axis is `pixdim[0]`. Source: nifti1.h, method 2.
Placement placement_by_quaternion(Vec3 bcd, Vec3 spacing, double sign, Vec3 origin) {
    const double b = bcd.x, c = bcd.y, d = bcd.z;
    const double a = std::sqrt(std::max(0.0, 1.0 - b * b - c * c - d * d));
    const Vec3 i{a * a + b * b - c * c - d * d, 2.0 * (b * c + a * d), 2.0 * (b * d - a * c)};
    const Vec3 j{2.0 * (b * c - a * d), a * a + c * c - b * b - d * d, 2.0 * (c * d + a * b)};
    const Vec3 k{2.0 * (b * d + a * c), 2.0 * (c * d - a * b), a * a + d * d - b * b - c * c};
    return {{spacing.x * i, spacing.y * j, (sign * spacing.z) * k}, origin};
}

/// Returns the largest distance between a voxel's positions in two placements [mm].
double disagreement(const Placement& a, const Placement& b, const std::array<int, 3>& size) {
    double largest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 apart = a.origin - b.origin;
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (corner >> axis & 1)
                apart = apart + static_cast<double>(size[axis] - 1) * (a.steps[axis] - b.steps[axis]);
        largest = std::max(largest, length(apart));
    }
    return largest;
}

double unit_of(const Header& header) {
    switch (const int unit = static_cast<unsigned char>(header.bytes()[123]) & 7; unit) {
        case 0:  // not given: NIfTI's usual unit
        case 2:
            return 1.0;
        case 1:
            return 1000.0;
        case 3:
            return 1e-3;
        default:
            refuse("E0627",
                   "`xyzt_units` in the header is " + std::to_string(unit) +
                       ", must be 1 (metres), 2 (millimetres) or 3 (micrometres).",
                   "Export the image again, with its spacing in millimetres.");
    }
}

/// Compares the lengths of `sform`'s columns with `pixdim`. Both are voxel sizes.
void compare_sizes(const Placement& by_matrix, Vec3 spacing, ImageFile& image) {
    const std::array<double, 3> written{spacing.x, spacing.y, spacing.z};
    const auto text = [](double x, double y, double z) {
        return number_text(x) + " × " + number_text(y) + " × " + number_text(z) + " mm";
    };
    double worst = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        // In a sheared image `pixdim` may be the length of the step or the distance between slices.
        const Vec3 across = normalized(cross(by_matrix.steps[(axis + 1) % 3], by_matrix.steps[(axis + 2) % 3]));
        double smallest = HUGE_VAL;
        for (const double by_column : {length(by_matrix.steps[axis]), std::abs(dot(by_matrix.steps[axis], across))})
            smallest = std::min(smallest, std::abs(by_column - written[axis]) / std::max(by_column, written[axis]));
        worst = std::max(worst, smallest);
    }
    constexpr double rounding = 1e-3, wrong = 1e-2;  // [–] many programs write `pixdim` with few digits
    if (worst <= rounding) return;
    const std::string both = "a voxel is " + text(spacing.x, spacing.y, spacing.z) + " by `pixdim` and " +
                             text(length(by_matrix.steps[0]), length(by_matrix.steps[1]), length(by_matrix.steps[2])) +
                             " by `sform`";
    if (worst > wrong)
        refuse("E0627", both + "; the two must agree.",
               "Export the image again from the program that has the scan's own spacing.");
    std::string doubt = both + "; `sform` was taken.";
    doubt[0] = 'A';
    image.doubts.push_back(std::move(doubt));
}

/// Sets the placement from `sform`, or without it from `qform`. If both exist and differ, that is a doubt.
void place_nifti(const Header& header, ImageFile& image) {
    const double mm = unit_of(header);
    constexpr Vec3 ras{-1, -1, 1};
    const Vec3 spacing{mm * header.real(80), mm * header.real(84), mm * header.real(88)};
    for (const double s : {spacing.x, spacing.y, spacing.z})
        if (!(s > 0.0))
            refuse("E0627", "`pixdim` is " + number_text(s) + ", must be above 0 mm.", "Export the image again.");
    std::optional<Placement> by_matrix, by_quaternion;
    const int sform = header.word(254), qform = header.word(252);
    if (sform > 0) {
        by_matrix.emplace();
        for (std::size_t axis = 0; axis < 3; ++axis)
            by_matrix->steps[axis] =
                mm * Vec3{header.real(280 + 4 * axis), header.real(296 + 4 * axis), header.real(312 + 4 * axis)};
        by_matrix->origin = mm * Vec3{header.real(292), header.real(308), header.real(324)};
        check_placement(*by_matrix);
        compare_sizes(*by_matrix, spacing, image);
    }
    if (qform > 0) {
        const Vec3 quaternion{header.real(256), header.real(260), header.real(264)};
        if (!is_finite(quaternion) || length(quaternion) > 1.001)
            refuse("E0627", "the rotation of `qform` is no unit quaternion.", "Export the image again.");
        by_quaternion = placement_by_quaternion(quaternion, spacing, header.real(76) < 0.0 ? -1.0 : 1.0,
                                                mm * Vec3{header.real(268), header.real(272), header.real(276)});
        check_placement(*by_quaternion);
    }
    if (!by_matrix && !by_quaternion)
        refuse("E0627", "neither `qform_code` nor `sform_code` is above 0: left and right cannot be distinguished.",
               "Export the image with its orientation.");
    if (by_matrix && by_quaternion) {
        constexpr double same = 0.1;  // [mm]: single-precision headers, over the width of a body
        if (const double apart = disagreement(*by_matrix, *by_quaternion, image.size); apart > same)
            image.doubts.push_back("`sform` and `qform` of the file place voxels up to " + number_text(apart) +
                                   " mm apart; `sform` was taken.");
    }
    if (const int code = by_matrix ? sform : qform; code > 2)
        image.doubts.push_back("The file places its voxels in a standard brain's frame (code " + std::to_string(code) +
                               "), not in the scanner's: sizes may not be the patient's.");
    place(image, by_matrix ? *by_matrix : *by_quaternion, ras);
}

void read_scale(const Header& header, ImageFile& image) {
    const double slope = header.real(112), intercept = header.real(116);
    if (!std::isfinite(slope) || !std::isfinite(intercept))
        refuse("E0622", "`scl_slope` or `scl_inter` is no finite number.", "Export the image again.");
    if (slope != 0.0) {  // 0 means that neither applies
        image.slope = slope;
        image.intercept = intercept;
    } else if (intercept != 0.0) {
        image.doubts.push_back("`scl_inter` is " + number_text(intercept) +
                               ", but `scl_slope` is 0, which NIfTI-1 defines as \"no scale\": it was not added.");
    }
}

std::string bytes_of_header(const std::string& file, bool is_packed) {
    if (!is_packed) return first_bytes(file, header_size);
    if (first_bytes(file, 2) != "\x1f\x8b")
        refuse("E0622", "the name ends in .gz, but this is no gzip file.", "Rename it to .nii, or compress it.");
    std::string bytes(header_size, '\0');
    bytes.resize(PackedBytes(file, 0, PackedBytes::Packing::deflated).take(bytes.data(), header_size));
    return bytes;
}

}  // namespace

ImageFile read_nifti(const std::string& file, bool is_packed) {
    std::string bytes = bytes_of_header(file, is_packed);
    if (bytes.size() < header_size) refuse_truncated(bytes.size(), header_size, "the file's header");
    const Header header(std::move(bytes));
    if (header.bytes().starts_with(std::string("\x1c\x02\0\0", 4)) ||
        header.bytes().starts_with(std::string("\0\0\x02\x1c", 4)))
        refuse("E0622", "this is NIfTI-2.", "Export it as NIfTI-1.");
    const std::string magic = header.bytes().substr(344, 4);
    if (magic == std::string("ni1\0", 4))
        refuse("E0622", "this is the header of a pair .hdr and .img.", "Export the image as one .nii or .nii.gz.");
    if (header.number<std::int32_t>(0) != static_cast<std::int32_t>(header_size) || magic != std::string("n+1\0", 4))
        refuse("E0622", "this is no NIfTI-1 file with its voxels in it.", "Export the image as .nii or .nii.gz.");

    ImageFile image;
    image.format = ImageFile::Format::nifti;
    image.packing = is_packed ? ImageFile::Packing::gzip_file : ImageFile::Packing::raw;
    image.data_file = file;
    std::vector<long long> size;
    for (int axis = 0; axis < std::clamp(header.word(40), 0, 7); ++axis)
        if (const int n = header.word(42 + 2 * static_cast<std::size_t>(axis)); axis < 3 || n != 1) size.push_back(n);
    check_size(size, image);

    image.number = number_of(header.word(70));
    image.is_big_endian = header.is_swapped();  // the reader is little endian, as all machines that run Kerf
    if (header.word(72) != 8 * image.bytes_per_voxel())
        refuse("E0622",
               "`bitpix` is " + std::to_string(header.word(72)) + ", but the voxel type has " +
                   std::to_string(8 * image.bytes_per_voxel()) + " bits.",
               "Export the image again.");
    const double offset = header.real(108);
    if (!(offset >= 352.0 && offset <= 16.0 * 1024 * 1024) || offset != std::floor(offset))
        refuse("E0622", "`vox_offset` is " + number_text(offset) + ", must be 352 or more.", "Export the image again.");
    image.data_offset = static_cast<std::uint64_t>(offset);
    read_scale(header, image);
    place_nifti(header, image);
    return image;
}

}  // namespace kerf::bone::header
