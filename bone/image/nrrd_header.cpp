// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bone/image/header_checks.h"
#include "bone/image/header_fields.h"
#include "bone/image/segments.h"
#include "text/printable.h"

namespace kerf::bone::header {
namespace {

constexpr std::size_t max_header = 1024 * 1024;  // [bytes] of text; 3D Slicer writes about 1 kB for each segment
constexpr int max_layers = 64;

/// The lines of a header.
struct Text {
    Fields fields;
    Remarks remarks;
    std::size_t end = 0;    ///< [bytes] beginning of the voxels, if they are in the same file
    bool is_ended = false;  ///< an empty line ended the header
};

/// Returns a remark's value without the two escapes of NRRD.
std::string unescaped(std::string_view value) {
    std::string text;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const bool is_escape =
            value[i] == '\\' && i + 1 < value.size() && (value[i + 1] == 'n' || value[i + 1] == '\\');
        if (!is_escape)
            text += value[i];
        else
            text += value[++i] == 'n' ? '\n' : '\\';
    }
    return text;
}

Text lines_of(const std::string& file) {
    const std::string bytes =
        first_bytes(file, static_cast<std::size_t>(std::min<std::uint64_t>(size_of_file(file), max_header)));
    Text text;
    std::size_t at = bytes.starts_with("\xef\xbb\xbf") ? 3 : 0;  // a byte order mark
    if (bytes.compare(at, 7, "NRRD000") != 0)
        refuse("E0622", "this is no NRRD file.", "Export the image as .nrrd, .nii.gz or .mha.");
    for (bool is_first = true; at < bytes.size() && !text.is_ended; is_first = false) {
        const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
        const std::string_view line = trimmed(std::string_view(bytes).substr(at, end - at));
        at = std::min(end + 1, bytes.size());
        if (line.empty()) text.is_ended = true;
        if (line.empty() || is_first || line[0] == '#') continue;
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos && bytes.find('\n', at - 1) == std::string::npos) break;  // cut short
        if (colon == std::string_view::npos)
            refuse("E0622", "the header has the line \"" + text::excerpt(line) + "\".", "Export the image again.");
        if (colon + 1 == line.size() || line[colon + 1] != '=') {
            add(text.fields, line.substr(0, colon), line.substr(colon + 1));
            continue;
        }
        const bool is_new = text.remarks.emplace(line.substr(0, colon), unescaped(line.substr(colon + 2))).second;
        if (!is_new && line.starts_with("Segment"))
            refuse("E0622", "the header has `" + text::excerpt(line.substr(0, colon)) + "` twice.",
                   "Export the segmentation again.");
    }
    text.end = at;
    if (!text.is_ended && bytes.size() == max_header)
        refuse("E0622", "the header is longer than 1 MB.", "Export fewer segments.");
    return text;
}

// ---- fields with one value for each axis ----------------------------------------------------------------------------

void check_count(std::size_t count, std::size_t axes, const char* field) {
    if (count != axes)
        refuse("E0622",
               "`" + std::string(field) + "` has " + std::to_string(count) + " values for " + std::to_string(axes) +
                   " axes.",
               "Export the image again.");
}

/// Parses `none` or `(1,0,0)` for each axis.
std::vector<std::optional<Vec3>> vectors_of(std::string_view text, const char* field) {
    std::vector<std::optional<Vec3>> vectors;
    const auto malformed = [&] {
        refuse("E0627",
               "`" + std::string(field) + "` in the header is \"" + text::excerpt(text) +
                   "\", must be `none` or three numbers in parentheses for each axis.",
               "Export the image again.");
    };
    for (std::string_view rest = trimmed(text); !rest.empty(); rest = trimmed(rest)) {
        if (lower(rest.substr(0, 4)) == "none") {
            vectors.emplace_back();
            rest.remove_prefix(4);
            continue;
        }
        const std::size_t end = rest.find(')');
        if (rest[0] != '(' || end == std::string_view::npos) malformed();
        const auto numbers = decimals_of(rest.substr(0, end), field);
        if (numbers.size() != 3) malformed();
        vectors.push_back(Vec3{numbers[0], numbers[1], numbers[2]});
        rest.remove_prefix(end + 1);
    }
    return vectors;
}

/// Returns the numbers per voxel: the size of a first axis that is not an axis of space. Removes this axis.
int layers_of(std::vector<long long>& sizes, const std::string* kinds) {
    if (sizes.size() != 4 || kinds == nullptr) return 1;
    const auto words = words_of(*kinds);
    const bool is_list = !words.empty() && lower(words[0]) == "list", is_single = !words.empty() && sizes[0] == 1;
    if (!is_list && !is_single) return 1;
    if (sizes[0] < 1 || sizes[0] > max_layers)
        refuse("E0623", "the header says " + std::to_string(sizes[0]) + " numbers for each voxel, must be 1 … 64.",
               "Export one segment at a time.");
    const auto layers = static_cast<int>(sizes[0]);
    sizes.erase(sizes.begin());
    return layers;
}

/// Refuses axes behind the layers that are not of space.
void check_kinds(const Fields& fields, std::size_t axes, std::size_t first) {
    const std::string* kinds = find(fields, {"kinds"});
    if (!kinds) return;
    const auto words = words_of(*kinds);
    check_count(words.size(), axes, "kinds");
    for (std::size_t axis = first; axis < axes; ++axis) {
        const std::string kind = lower(words[axis]);
        if (kind != "domain" && kind != "space" && kind != "???" && kind != "none")
            refuse("E0623",
                   "axis " + std::to_string(axis + 1) + " of the image is of kind `" + text::excerpt(words[axis]) +
                       "`, must be `domain` or `space`.",
                   "Export a single volume, not a series over time, vectors or colours.");
    }
}

/// Returns the millimetres per unit of `space directions` and `space origin`.
double unit_of(const Fields& fields, std::size_t axes, std::size_t first) {
    const auto common = [&](const char* field, std::size_t count, std::size_t from) -> std::optional<double> {
        const std::string* text = find(fields, {field});
        if (!text) return std::nullopt;
        const auto words = quoted_words_of(*text, field);
        check_count(words.size(), count, field);
        std::optional<double> all;
        for (std::size_t i = from; i < count; ++i) {
            if (words[i].empty() || words[i] == "???" || lower(words[i]) == "none") continue;  // not given
            const auto one = millimetres_in(words[i]);
            if (!one || (all && *all != *one))
                refuse("E0627",
                       "`" + std::string(field) + "` in the header is " + text::excerpt(*text) +
                           ", must be mm, cm, m or um for all three axes alike.",
                       "Export the image in millimetres.");
            all = one;
        }
        return all;
    };
    const auto of_space = common("space units", 3, 0), of_axes = common("units", axes, first);
    const double mm = of_space.value_or(1.0);
    if (of_axes && *of_axes != mm)
        refuse("E0627",
               "`units` in the header is " + text::excerpt(need(fields, {"units"})) +
                   ", but `space directions` are in " +
                   (of_space ? text::excerpt(need(fields, {"space units"})) : "\"mm\"") + ".",
               "Export the image in millimetres.");
    return mm;
}

/// Checks a size or a position that the header gives a second time.
void check_repeated(const Fields& fields, std::size_t axes, std::size_t first, const std::array<Vec3, 3>& steps) {
    if (const std::string* text = find(fields, {"spacings"})) {
        const auto spacings = decimals_of(*text, "spacings");
        check_count(spacings.size(), axes, "spacings");
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (const double written = std::abs(spacings[first + axis]);
                std::isfinite(written) && differ(written, length(steps[axis]), 1e-3))
                refuse("E0627",
                       "a voxel is " + number_text(written) + " wide by `spacings` and " +
                           number_text(length(steps[axis])) + " by `space directions`; the two must agree.",
                       "Export the image again.");
    }
    for (const auto& names : {std::array{"axis mins", "axismins"}, std::array{"axis maxs", "axismaxs"}})
        if (const std::string* text = find(fields, {names[0], names[1]})) {
            const auto ends = decimals_of(*text, names[0]);
            check_count(ends.size(), axes, names[0]);
            if (std::any_of(ends.begin() + static_cast<std::ptrdiff_t>(first), ends.end(),
                            [](double end) { return std::isfinite(end); }))
                refuse("E0627",
                       "the header places the voxels twice, by `" + std::string(names[0]) + "` and by `space origin`.",
                       "Export the image with `space origin` alone.");
        }
}

/// Returns the factors from the header's space to LPS: 1 or −1 for each axis.
Vec3 frame_of(const Fields& fields) {
    const std::string space = lower(need(fields, {"space"}));
    static const std::array<const char*, 6> spaces{"left-posterior-superior", "lps", "right-anterior-superior", "ras",
                                                   "left-anterior-superior",  "las"};
    if (std::find(spaces.begin(), spaces.end(), space) == spaces.end())
        refuse("E0627", "`space` is \"" + text::excerpt(space) + "\": left and right cannot be distinguished.",
               "Export the image with space: left-posterior-superior.");
    if (const std::string* dimension = find(fields, {"space dimension"}); dimension && *dimension != "3")
        refuse("E0627", "`space dimension` is " + text::excerpt(*dimension) + ", but `space` has three.",
               "Export the image again.");
    const bool is_lps = space == "lps" || space == "left-posterior-superior";
    return {space[0] == 'r' ? -1.0 : 1.0, is_lps ? 1.0 : -1.0, 1.0};
}

// ---- the voxels -----------------------------------------------------------------------------------------------------

/// Refuses fields that change the meaning of stored numbers.
void check_values(const Fields& fields, const ImageFile& image) {
    for (const auto& names : {std::array{"old min", "oldmin"}, std::array{"old max", "oldmax"}})
        if (find(fields, {names[0], names[1]}))
            refuse("E0622",
                   "the values were changed to fit their type: the header has `" + std::string(names[0]) + "`.",
                   "Export the image with its own values.");
    if (const std::string* number = find(fields, {"number"})) {
        const auto all = image.voxels() * static_cast<std::uint64_t>(image.layers);
        if (whole_of(*number, "number") != static_cast<long long>(all))
            refuse("E0622",
                   "`number` is " + text::excerpt(*number) + ", but `sizes` make " + std::to_string(all) + " numbers.",
                   "Export the image again.");
    }
}

/// Applies the bytes to skip before the voxels. −1 counts from the end of the file, as NRRD defines it.
void skip(const Fields& fields, ImageFile& image) {
    const std::string *lines = find(fields, {"line skip", "lineskip"}),
                      *bytes = find(fields, {"byte skip", "byteskip"});
    const long long line_count = lines ? whole_of(*lines, "line skip") : 0,
                    byte_count = bytes ? whole_of(*bytes, "byte skip") : 0;
    if (line_count == 0 && byte_count == 0) return;
    if (image.packing != ImageFile::Packing::raw || line_count != 0 || byte_count < -1)
        refuse("E0622",
               "the header has `" + std::string(line_count != 0 ? "line skip" : "byte skip") + ": " +
                   std::to_string(line_count != 0 ? line_count : byte_count) +
                   "`; only `byte skip` before raw voxels is read.",
               "Export the image again.");
    const std::uint64_t size = size_of_file(image.data_file), need = image.data_bytes();
    if (byte_count > 0)
        image.data_offset += static_cast<std::uint64_t>(byte_count);
    else if (size >= need && size - need >= image.data_offset)
        image.data_offset = size - need;
    else
        refuse_truncated(size, need, "the file with the voxels");
}

/// Refuses representations other than a binary labelmap. A fractional labelmap has fractions, a closed surface no
/// voxels.
void check_representation(const Remarks& remarks) {
    for (const char* key : {"Segmentation_SourceRepresentation", "Segmentation_MasterRepresentation"})
        if (const auto at = remarks.find(key); at != remarks.end() && lower(trimmed(at->second)) != "binary labelmap")
            refuse("E0623", "the segmentation is a \"" + text::excerpt(at->second) + "\", must be a binary labelmap.",
                   "Export it from 3D Slicer as a binary labelmap.");
}

}  // namespace

ImageFile read_nrrd(const std::string& file) {
    const Text text = lines_of(file);
    const Fields& fields = text.fields;
    ImageFile image;
    image.format = ImageFile::Format::nrrd;
    image.data_file = file;
    image.data_offset = text.end;
    if (const std::string* data = find(fields, {"data file", "datafile"})) {
        if (const std::string first = lower(data->substr(0, 4));
            first == "list" && (data->size() == 4 || (*data)[4] == ' '))
            refuse("E0622", "the voxels are in several files, must be in one beside the header.",
                   "Export the image as one .nrrd.");
        image.data_file = data_file_of(file, *data, "data file");
        image.data_offset = 0;
    } else if (!text.is_ended) {
        refuse("E0626", "the header does not end.", "Copy the file again: it is cut short.");
    }

    auto sizes = wholes_of(need(fields, {"sizes"}), "sizes");
    const std::size_t axes = sizes.size();
    if (whole_of(need(fields, {"dimension"}), "dimension") != static_cast<long long>(axes))
        refuse("E0622", "`dimension` and the number of `sizes` differ.", "Export the image again.");
    image.layers = layers_of(sizes, find(fields, {"kinds"}));
    const std::size_t first = axes - sizes.size();  // axis of space
    check_size(sizes, image);
    check_kinds(fields, axes, first);
    image.number = named_number(need(fields, {"type"}));
    if (image.bytes_per_voxel() > 1) {
        const std::string endian = lower(need(fields, {"endian"}));
        if (endian != "little" && endian != "big")
            refuse("E0622", "`endian` is \"" + text::excerpt(endian) + "\", must be little or big.",
                   "Export the image again.");
        image.is_big_endian = endian == "big";
    }
    const std::string encoding = lower(need(fields, {"encoding"}));
    if (encoding == "gzip" || encoding == "gz")
        image.packing = ImageFile::Packing::deflated;
    else if (encoding != "raw")
        refuse("E0625", "the encoding is `" + text::excerpt(encoding) + "`, must be raw or gzip.",
               "Export the image with gzip.");
    check_values(fields, image);
    skip(fields, image);

    const Vec3 to_lps = frame_of(fields);
    const auto directions = vectors_of(need(fields, {"space directions"}), "space directions");
    const auto origin = vectors_of(need(fields, {"space origin"}), "space origin");
    check_count(directions.size(), axes, "space directions");
    if (origin.size() != 1 || !origin[0])
        refuse("E0627", "`space origin` must be one vector of three numbers.", "Export the image again.");
    std::array<Vec3, 3> steps;
    for (std::size_t axis = 0; axis < axes; ++axis) {
        if (directions[axis].has_value() != (axis >= first))
            refuse("E0627",
                   "`space directions` has " + std::string(axis >= first ? "`none`" : "a vector") + " for axis " +
                       std::to_string(axis + 1) + ".",
                   "Export the image again.");
        if (axis >= first) steps[axis - first] = *directions[axis];
    }
    check_repeated(fields, axes, first, steps);
    const double mm = unit_of(fields, axes, first);
    place(image, {{mm * steps[0], mm * steps[1], mm * steps[2]}, mm * *origin[0]}, to_lps);

    check_representation(text.remarks);
    image.segments = segments_of(text.remarks, image.layers);
    if (image.layers > 1 && image.segments.empty())
        refuse("E0623",
               "there are " + std::to_string(image.layers) +
                   " numbers for each voxel, and the header does not name "
                   "them; must be 1, or the segments of 3D Slicer.",
               "Export a single channel.");
    return image;
}

}  // namespace kerf::bone::header
