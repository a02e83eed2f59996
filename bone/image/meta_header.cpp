// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bone/image/header_checks.h"
#include "bone/image/header_fields.h"
#include "text/printable.h"

namespace kerf::bone::header {
namespace {

constexpr std::size_t max_header = 64 * 1024;  // [bytes] of text

bool is_true(const Fields& fields, std::initializer_list<const char*> names, bool otherwise) {
    const std::string* value = find(fields, names);
    if (!value) return otherwise;
    const std::string word = lower(*value);
    for (const char* yes : {"true", "t", "yes", "1"})
        if (word == yes) return true;
    for (const char* no : {"false", "f", "no", "0"})
        if (word == no) return false;
    refuse("E0622",
           "`" + std::string(*names.begin()) + "` is \"" + text::excerpt(*value) + "\", must be True or False.",
           "Export the image again.");
}

std::optional<double> decimal_in(const Fields& fields, const char* name) {
    const std::string* text = find(fields, {name});
    if (!text) return std::nullopt;
    const auto numbers = decimals_of(*text, name);
    if (numbers.size() != 1 || !std::isfinite(numbers[0]))
        refuse("E0622", "`" + std::string(name) + "` is \"" + text::excerpt(*text) + "\", must be one finite number.",
               "Export the image again.");
    return numbers[0];
}

std::vector<double> three(const std::string& text, const char* field) {
    auto numbers = decimals_of(text, field);
    if (numbers.size() != 3)
        refuse("E0627", "`" + std::string(field) + "` needs three numbers.", "Export the image again.");
    return numbers;
}

/// Returns the width of a voxel along each axis, in the unit of the file. `ElementSize` is the extent of a voxel;
/// without `ElementSpacing` it is the spacing, too.
std::vector<double> spacing_of(const Fields& fields, ImageFile& image) {
    const std::string *spacing = find(fields, {"elementspacing"}), *size = find(fields, {"elementsize"});
    const std::vector<double> found =
        spacing || !size ? three(need(fields, {"elementspacing"}), "ElementSpacing") : three(*size, "ElementSize");
    for (const double s : found)
        if (!(s > 0.0))
            refuse("E0627",
                   "`" + std::string(spacing ? "ElementSpacing" : "ElementSize") + "` is " + number_text(s) +
                       ", must be above 0 mm.",
                   "Export the image again.");
    if (spacing && size) {
        const auto covered = three(*size, "ElementSize");
        if (differ(covered[0], found[0], 1e-3) || differ(covered[1], found[1], 1e-3) ||
            differ(covered[2], found[2], 1e-3))
            image.doubts.push_back("A voxel is " + text::excerpt(*spacing) + " wide by `ElementSpacing` and " +
                                   text::excerpt(*size) + " by `ElementSize`; `ElementSpacing` was taken.");
    }
    return found;
}

double unit_of(const Fields& fields) {
    const std::string* unit = find(fields, {"distanceunits"});
    if (!unit || *unit == "?" || unit->empty()) return 1.0;  // not given
    if (const auto mm = millimetres_in(*unit)) return *mm;
    refuse("E0627", "`DistanceUnits` is \"" + text::excerpt(*unit) + "\", must be um, mm, cm or m.",
           "Export the image in millimetres.");
}

/// Returns one letter for the side where each of the three axes begins: RAI for axes that run to left, back and head.
std::string letters_of(const std::array<Vec3, 3>& axes) {
    std::string letters;
    for (const Vec3& axis : axes) {
        const double x = std::abs(axis.x), y = std::abs(axis.y), z = std::abs(axis.z);
        letters += x >= y && x >= z ? (axis.x > 0.0 ? 'R' : 'L')
                   : y >= z         ? (axis.y > 0.0 ? 'A' : 'P')
                                    : (axis.z > 0.0 ? 'I' : 'S');
    }
    return letters;
}

/// Checks `AnatomicalOrientation` against the matrix. Without a matrix it is the only orientation in the file.
void check_letters(const Fields& fields, bool has_matrix, const std::array<Vec3, 3>& axes, ImageFile& image) {
    const std::string* written = find(fields, {"anatomicalorientation"});
    if (!written || written->find('?') != std::string::npos) return;
    std::string letters = *written;
    for (char& c : letters)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    const std::string by_matrix = letters_of(axes);
    if (letters == by_matrix) return;
    const std::string both = "`AnatomicalOrientation` is " + text::excerpt(*written) + ", but the axes " +
                             (has_matrix ? "of `TransformMatrix`" : "without a `TransformMatrix`") + " are " +
                             by_matrix;
    if (!has_matrix) refuse("E0627", both + ".", "Export the image with its `TransformMatrix`.");
    image.doubts.push_back(both + "; the matrix was taken.");
}

void place_meta(const Fields& fields, ImageFile& image) {
    const double mm = unit_of(fields);
    const std::vector<double> spacing = spacing_of(fields, image);
    const std::string* rotation = find(fields, {"transformmatrix", "rotation", "orientation"});
    const auto matrix = decimals_of(rotation ? *rotation : "1 0 0 0 1 0 0 0 1", "TransformMatrix");
    const std::string* offset = find(fields, {"offset", "position", "origin"});
    if (!offset)
        refuse("E0627", "the header has no `Offset`: where the voxels lie in the patient is not known.",
               "Export the image with its position.");
    const auto origin = decimals_of(*offset, "Offset");
    if (matrix.size() != 9 || origin.size() != 3)
        refuse("E0627", "`TransformMatrix` needs nine numbers, `Offset` three.", "Export the image again.");
    std::array<Vec3, 3> axes, steps;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        axes[axis] = {matrix[3 * axis], matrix[3 * axis + 1], matrix[3 * axis + 2]};
        if (const double size = length(axes[axis]); differ(size, 1.0, 1e-2))
            refuse("E0627",
                   "axis " + std::to_string(axis + 1) + " of `TransformMatrix` has length " + number_text(size) +
                       ", must be 1: `ElementSpacing` holds the size of a voxel.",
                   "Export the image again.");
        steps[axis] = mm * spacing[axis] * axes[axis];
    }
    if (const std::string* centre = find(fields, {"centerofrotation"})) {
        const auto at = three(*centre, "CenterOfRotation");
        const bool is_zero = at[0] == 0.0 && at[1] == 0.0 && at[2] == 0.0;
        if (!is_zero &&
            length(axes[0] - Vec3{1, 0, 0}) + length(axes[1] - Vec3{0, 1, 0}) + length(axes[2] - Vec3{0, 0, 1}) > 1e-6)
            refuse("E0627",
                   "`CenterOfRotation` is " + text::excerpt(*centre) +
                       "; programs do not agree what that does to the place "
                       "of a turned image.",
                   "Export the image with CenterOfRotation = 0 0 0.");
    }
    if (const std::string* parent = find(fields, {"parentid"}); parent && whole_of(*parent, "ParentID") >= 0)
        refuse("E0627", "the image is placed in another object's frame: `ParentID` is " + text::excerpt(*parent) + ".",
               "Export the image alone.");
    if (!rotation)
        image.doubts.push_back(
            "The header has no `TransformMatrix`; the axes were taken to point to the patient's left, back and head.");
    check_letters(fields, rotation != nullptr, axes, image);
    place(image, {steps, mm * Vec3{origin[0], origin[1], origin[2]}}, {1, 1, 1});
}

void read_values(const Fields& fields, ImageFile& image) {
    image.number = named_number(need(fields, {"elementtype"}));
    if (const std::string* channels = find(fields, {"elementnumberofchannels"});
        channels && whole_of(*channels, "ElementNumberOfChannels") != 1)
        refuse("E0623", "there are " + text::excerpt(*channels) + " numbers per voxel, must be 1.",
               "Export a single channel.");
    if (!is_true(fields, {"binarydata"}, true))
        refuse("E0625", "the voxels are written as text.", "Export the image with binary data.");
    image.is_big_endian = is_true(fields, {"binarydatabyteordermsb", "elementbyteordermsb"}, false);
    if (is_true(fields, {"compresseddata"}, false)) image.packing = ImageFile::Packing::deflated;
    if (const std::string* size = find(fields, {"compresseddatasize"});
        size && image.packing != ImageFile::Packing::raw)
        image.packed_bytes = static_cast<std::uint64_t>(std::max(0LL, whole_of(*size, "CompressedDataSize")));
    if (const std::string* skip = find(fields, {"headersize"}); skip && whole_of(*skip, "HeaderSize") != 0)
        refuse("E0622", "the header has `HeaderSize`.", "Export the image again.");
    image.slope = decimal_in(fields, "elementtointensityfunctionslope").value_or(1.0);
    image.intercept = decimal_in(fields, "elementtointensityfunctionoffset").value_or(0.0);
    if (image.slope == 0.0)
        refuse("E0622", "`ElementToIntensityFunctionSlope` is 0: all voxels would have one value.",
               "Export the image again.");
    if (const std::string* modality = find(fields, {"modality"})) {
        const std::string word = lower(*modality);
        if (word != "met_mod_ct" && word != "met_mod_unknown" && word != "met_mod_other" && word != "?")
            image.doubts.push_back("The image is no CT but " + text::excerpt(*modality) + ": its values are no HU.");
    }
}

}  // namespace

ImageFile read_meta(const std::string& file) {
    const std::string text = first_bytes(file, max_header);
    Fields fields;
    std::size_t at = text.starts_with("\xef\xbb\xbf") ? 3 : 0;  // a byte order mark
    while (at < text.size() && !fields.contains("elementdatafile")) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = trimmed(std::string_view(text).substr(at, end - at));
        at = std::min(end + 1, text.size());
        if (line.empty()) continue;
        const std::size_t equals = line.find('=');
        if (equals == std::string_view::npos)
            refuse("E0622", "the header has the line \"" + text::excerpt(line) + "\".",
                   "Export the image as .mha, .nrrd or .nii.gz.");
        add(fields, line.substr(0, equals), line.substr(equals + 1));
    }
    const std::string& data = need(fields, {"elementdatafile"});
    if (const std::string* type = find(fields, {"objecttype"}); type && lower(*type) != "image")
        refuse("E0622", "the header describes an object of type `" + text::excerpt(*type) + "`, must be Image.",
               "Export the image as .mha, .nrrd or .nii.gz.");

    ImageFile image;
    image.format = ImageFile::Format::meta;
    const auto sizes = wholes_of(need(fields, {"dimsize"}), "DimSize");
    if (whole_of(need(fields, {"ndims"}), "NDims") != static_cast<long long>(sizes.size()))
        refuse("E0622", "`NDims` and the number of sizes in `DimSize` differ.", "Export the image again.");
    check_size(sizes, image);
    read_values(fields, image);
    place_meta(fields, image);
    if (lower(data) == "local") {
        image.data_file = file;
        image.data_offset = at;
        return image;
    }
    if (const std::string first = lower(data.substr(0, 4)); first == "list" && (data.size() == 4 || data[4] == ' '))
        refuse("E0622", "the voxels are in several files, must be in one beside the header.",
               "Export the image as one .mha.");
    image.data_file = data_file_of(file, data, "ElementDataFile");
    return image;
}

}  // namespace kerf::bone::header
