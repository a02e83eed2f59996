// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "bone/surface/header_claims.h"
#include "bone/surface/polygon.h"
#include "bone/surface/read_surface.h"
#include "bone/surface/text_lines.h"
#include "text/printable.h"

namespace kerf::bone {
namespace {

enum class Number { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::optional<Number> number_type(std::string_view word) {
    constexpr std::array<std::pair<std::string_view, Number>, 16> names{{{"char", Number::int8},
                                                                         {"int8", Number::int8},
                                                                         {"uchar", Number::uint8},
                                                                         {"uint8", Number::uint8},
                                                                         {"short", Number::int16},
                                                                         {"int16", Number::int16},
                                                                         {"ushort", Number::uint16},
                                                                         {"uint16", Number::uint16},
                                                                         {"int", Number::int32},
                                                                         {"int32", Number::int32},
                                                                         {"uint", Number::uint32},
                                                                         {"uint32", Number::uint32},
                                                                         {"float", Number::float32},
                                                                         {"float32", Number::float32},
                                                                         {"double", Number::float64},
                                                                         {"float64", Number::float64}}};
    for (const auto& [name, type] : names)
        if (word == name) return type;
    return std::nullopt;
}

std::size_t size_of(Number type) noexcept {
    constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}
bool is_whole(Number type) noexcept { return type != Number::float32 && type != Number::float64; }

struct Property {
    std::string name;
    Number type = Number::float32;
    std::optional<Number> count_type;  ///< of a list
};
struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};
enum class Form { text, little_endian, big_endian };
struct Header {
    SurfaceFile claims;  ///< frame and unit from its remarks
    Form form = Form::text;
    std::vector<Element> elements;
    std::string_view data;
};

/// The numbers behind the header, in order. Each read fails at the end of the file.
class Values {
public:
    Values(Form form, std::string_view data) : form_(form), data_(data), words_(data) {}

    std::optional<double> next(Number type) {
        if (form_ == Form::text) return number_in(words_.word_on_any_line());
        const std::size_t size = size_of(type);
        if (data_.size() < size) return std::nullopt;
        std::array<unsigned char, 8> raw{};
        for (std::size_t i = 0; i < size; ++i)
            raw[i] = static_cast<unsigned char>(data_[form_ == Form::little_endian ? i : size - 1 - i]);
        data_.remove_prefix(size);
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < size; ++i) bits |= static_cast<std::uint64_t>(raw[i]) << (8 * i);
        switch (type) {
            case Number::int8:
                return static_cast<double>(static_cast<std::int8_t>(bits));
            case Number::int16:
                return static_cast<double>(static_cast<std::int16_t>(bits));
            case Number::int32:
                return static_cast<double>(static_cast<std::int32_t>(bits));
            case Number::float32:
                return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
            case Number::float64:
                return std::bit_cast<double>(bits);
            default:
                return static_cast<double>(bits);
        }
    }

private:
    Form form_;
    std::string_view data_;
    TextLines words_;
};

SurfaceError malformed(const std::string& what) { return {"E0643", what, "Export the surface again, as binary PLY."}; }

std::optional<Header> read_header(std::string_view bytes, SurfaceError& error) {
    TextLines lines(bytes);
    const auto refuse = [&](const std::string& what) {
        error = malformed("line " + std::to_string(lines.number()) + " of the header " + what);
        return std::nullopt;
    };
    if (!lines.next() || lines.word() != "ply") {
        error = malformed("the file does not begin with `ply`.");
        return std::nullopt;
    }
    Header header;
    bool has_form = false;
    while (lines.next()) {
        const std::string_view word = lines.word();
        if (word == "end_header") {
            if (!has_form) return refuse("comes before any `format`.");
            header.data = lines.rest_of_text();
            return header;
        }
        if (word == "format") {
            const std::string_view form = lines.word();
            if (form == "ascii")
                header.form = Form::text;
            else if (form == "binary_little_endian")
                header.form = Form::little_endian;
            else if (form == "binary_big_endian")
                header.form = Form::big_endian;
            else
                return refuse("names a format that does not exist.");
            if (lines.word() != "1.0") return refuse("names a version other than 1.0.");
            has_form = true;
        } else if (word == "element") {
            Element element;
            element.name = lines.word();
            const std::string_view count = lines.word();
            const auto [end, wrong] = std::from_chars(count.data(), count.data() + count.size(), element.count);
            if (element.name.empty() || wrong != std::errc{} || end != count.data() + count.size())
                return refuse("has no name and count behind `element`.");
            header.elements.push_back(std::move(element));
        } else if (word == "property") {
            if (header.elements.empty()) return refuse("has a property before any element.");
            Property property;
            std::string_view type = lines.word();
            if (type == "list") {
                property.count_type = number_type(lines.word());
                if (!property.count_type || !is_whole(*property.count_type))
                    return refuse("counts a list in something else than whole numbers.");
                type = lines.word();
            }
            const std::optional<Number> known = number_type(type);
            property.name = lines.word();
            if (!known || property.name.empty()) return refuse("has no known type and name behind `property`.");
            property.type = *known;
            header.elements.back().properties.push_back(std::move(property));
        } else if (word == "comment" || word == "obj_info") {
            if (!read_claims(lines.whole_line(), header.claims, error)) return std::nullopt;
        } else if (!word.empty()) {
            return refuse("begins with none of PLY's words.");
        }
    }
    error = {"E0644", "the file ends before `end_header`.", "Copy or export it again."};
    return std::nullopt;
}

/// Returns the smallest size of a row [bytes], to check a count against the size of the file.
std::size_t min_size(const Element& element, Form form) noexcept {
    if (form == Form::text) return element.properties.size();
    std::size_t sum = 0;
    for (const Property& p : element.properties) sum += size_of(p.count_type.value_or(p.type));
    return sum;
}

std::size_t index_of(const Element& element, std::string_view name) noexcept {
    const auto& all = element.properties;
    return static_cast<std::size_t>(
        std::find_if(all.begin(), all.end(), [&](const Property& p) { return p.name == name; }) - all.begin());
}

/// Where an element's row has the coordinates of a vertex, or the list of corners; `none` where it has not.
struct Columns {
    explicit Columns(const Element& element) noexcept
        : is_vertex(element.name == "vertex"),
          is_face(element.name == "face"),
          axes{index_of(element, "x"), index_of(element, "y"), index_of(element, "z")},
          list(std::min(index_of(element, "vertex_indices"), index_of(element, "vertex_index"))),
          none(element.properties.size()) {}

    bool is_vertex, is_face;
    std::array<std::size_t, 3> axes;
    std::size_t list, none;
};

/// Reads the rows behind a header into a mesh. Functions return false after setting `error_`.
class RowReader {
public:
    RowReader(const Header& header, SurfaceError& error)
        : header_(header), error_(error), file_(header.claims), values_(header.form, header.data) {
        file_.has_topology = true;
        for (const Element& element : header.elements)
            if (element.name == "vertex") vertices_ = element.count;
    }

    std::optional<SurfaceFile> read() {
        for (const Element& element : header_.elements)
            if (!read_element(element)) return std::nullopt;
        if (file_.mesh.triangles.empty()) {
            refuse({"E0647", "the file has no face.",
                    "Export the surface again; point clouds and strips of triangles are not read."});
            return std::nullopt;
        }
        return std::move(file_);
    }

private:
    bool refuse(SurfaceError error) {
        error_ = std::move(error);
        return false;
    }
    bool refuse_truncated(const Element& element) {
        return refuse({"E0644",
                       "the file ends, or has something that is no number, before the " +
                           std::to_string(element.count) + " rows of `" + element.name + "` that it promises.",
                       "Copy or export it again."});
    }

    bool read_element(const Element& element) {
        if (element.name == "tristrips" && element.count > 0)
            return refuse(malformed("the file has strips of triangles, which are not read."));
        if (element.properties.empty()) return true;
        if (element.count > header_.data.size() / min_size(element, header_.form)) return refuse_truncated(element);
        const Columns columns(element);
        if (!check_columns(element, columns)) return false;
        count_ignored(element, columns);
        if (columns.is_vertex) {
            file_.has_floats = element.properties[columns.axes[0]].type == Number::float32;
            file_.mesh.vertices.reserve(element.count);
        }
        row_.assign(columns.none, 0.0);
        for (std::uint64_t r = 0; r < element.count; ++r) {
            if (!read_row(element, columns, r)) return false;
            if (columns.is_vertex && !add_vertex(columns, r)) return false;
            if (columns.is_face && !add_face(r)) return false;
        }
        return true;
    }

    bool check_columns(const Element& element, const Columns& columns) {
        if (columns.is_vertex) {
            const auto is_missing = [&](std::size_t axis) {
                return axis == columns.none || element.properties[axis].count_type;
            };
            if (std::any_of(columns.axes.begin(), columns.axes.end(), is_missing))
                return refuse(malformed("the vertices have no x, y and z."));
            if (element.count > 3 * max_faces)
                return refuse(
                    {"E0642", "the file has more than 150 million vertices.", "Export the surface with fewer faces."});
        }
        if (columns.is_face && (columns.list == columns.none || !element.properties[columns.list].count_type))
            return refuse(malformed("the faces have no list `vertex_indices`."));
        return true;
    }

    /// Counts the values that are no part of the surface: for each element the columns that are not used.
    void count_ignored(const Element& element, const Columns& columns) {
        if (element.count == 0) return;
        if (!columns.is_vertex && !columns.is_face) {
            file_.ignored["rows of `" + text::excerpt(element.name, 40) + "`"] += element.count;
            return;
        }
        for (std::size_t p = 0; p < columns.none; ++p) {
            const auto& axes = columns.axes;
            const bool is_used =
                columns.is_vertex ? std::find(axes.begin(), axes.end(), p) != axes.end() : p == columns.list;
            if (!is_used)
                file_.ignored["values `" + text::excerpt(element.properties[p].name, 40) + "`"] += element.count;
        }
    }

    /// Reads row `r` into `row_`, and the corners of a face into `corners_`.
    bool read_row(const Element& element, const Columns& columns, std::uint64_t r) {
        corners_.clear();
        for (std::size_t p = 0; p < columns.none; ++p) {
            const Property& property = element.properties[p];
            const std::optional<double> value = values_.next(property.count_type.value_or(property.type));
            if (!value) return refuse_truncated(element);
            row_[p] = *value;
            if (property.count_type && !read_list(element, property, *value, columns.is_face && p == columns.list, r))
                return false;
        }
        return true;
    }

    bool read_list(const Element& element, const Property& property, double size, bool is_polygon, std::uint64_t r) {
        if (!(size >= 0.0 && size <= 4294967295.0) || size != std::floor(size) ||
            (is_polygon && size > static_cast<double>(max_corners)))
            return refuse(malformed(
                "row " + std::to_string(r + 1) + " of `" + element.name + "` has a list of " +
                (is_polygon ? "more than " + std::to_string(max_corners) + " corners" : "an impossible length") + "."));
        const auto length = static_cast<std::uint64_t>(size);
        for (std::uint64_t i = 0; i < length; ++i) {
            const std::optional<double> item = values_.next(property.type);
            if (!item) return refuse_truncated(element);
            if (!is_polygon) continue;
            if (!(*item >= 0.0 && *item < static_cast<double>(vertices_)) || *item != std::floor(*item))
                return refuse({"E0646",
                               "face " + std::to_string(r + 1) + " names a vertex that is none of the " +
                                   std::to_string(vertices_) + ".",
                               "Export the surface again."});
            corners_.push_back(static_cast<std::uint32_t>(*item));
        }
        return true;
    }

    bool add_vertex(const Columns& columns, std::uint64_t r) {
        const Vec3 at{row_[columns.axes[0]], row_[columns.axes[1]], row_[columns.axes[2]]};
        if (!is_finite(at))
            return refuse({"E0645", "vertex " + std::to_string(r + 1) + " has a coordinate that is no finite number.",
                           "Export the surface again."});
        file_.mesh.vertices.push_back(at);
        return true;
    }

    bool add_face(std::uint64_t r) {
        if (file_.mesh.vertices.size() != vertices_) return refuse(malformed("the faces come before the vertices."));
        if (corners_.size() < 3)
            return refuse(malformed("face " + std::to_string(r + 1) + " has fewer than three corners."));
        if (file_.mesh.triangles.size() + corners_.size() > max_faces)
            return refuse(
                {"E0642", "the file has more than 50 million faces.", "Export the surface with fewer faces."});
        add_polygon(file_.mesh, corners_);
        return true;
    }

    const Header& header_;
    SurfaceError& error_;
    SurfaceFile file_;
    Values values_;
    std::uint64_t vertices_ = 0;  ///< that the header promises
    std::vector<std::uint32_t> corners_;
    std::vector<double> row_;
};

}  // namespace

std::optional<SurfaceFile> read_ply(std::string_view bytes, SurfaceError& error) {
    const auto text = utf8_of(bytes, error);
    if (!text) return std::nullopt;
    const std::optional<Header> header = read_header(*text, error);
    if (!header) return std::nullopt;
    return RowReader(*header, error).read();
}

}  // namespace kerf::bone
