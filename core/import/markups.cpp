// SPDX-License-Identifier: Apache-2.0
#include "core/import/markups.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/field/fnv1a.h"
#include "core/import/data_file.h"
#include "core/procedure/document.h"
#include "core/procedure/read_anatomy.h"

namespace kerf {
namespace {

using Json = nlohmann::json;

constexpr double furthest = 2.0;  // [m] of a coordinate, as in documents

/// What is wrong with the file; becomes a Diagnostic at the only way out.
struct Refusal {
    const char* code;
    std::string message;
};

/// A piece of the file that may be shown to a person: short, and without control characters.
std::string shown(std::string_view text) {
    std::string result(text.substr(0, 40));
    for (char& c : result)
        if (static_cast<unsigned char>(c) < 0x20) c = '?';
    return "`" + result + "`";
}

bool is_id(std::string_view word) {
    const auto is_letter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    };
    return !word.empty() && word.size() <= 64 && is_letter(word.front()) &&
           std::all_of(word.begin(), word.end(),
                       [&](char c) { return is_letter(c) || c == '.' || c == '_' || c == '-'; });
}

/// What one file adds.
struct Landmarks {
    std::vector<LandmarkPoint> points;
    std::vector<LandmarkAxis> axes;
    std::vector<LandmarkPlane> planes;
};

class Reader {
public:
    explicit Reader(const MarkupsFile& file) : file_(file) {}

    Landmarks found;

    void fcsv(std::string_view text);
    void json(const std::string& text);

private:
    [[nodiscard]] std::string id_of(const std::string& label) const {
        const auto renamed = file_.names.find(label);
        const std::string& id = renamed == file_.names.end() ? label : renamed->second;
        if (!is_id(id))
            throw Refusal{"E0683", "a markup is called " + shown(label) +
                                       ", which is no id. Give it one: `names: [{label: \"" + label.substr(0, 40) +
                                       "\", id: entry}]`."};
        return id;
    }
    /// Millimetres in the file's frame to LPS metres.
    [[nodiscard]] Vec3 place(Vec3 mm) const {
        const Vec3 at = 1e-3 * (is_ras_ ? Vec3{-mm.x, -mm.y, mm.z} : mm);
        if (!is_finite(at) || std::abs(at.x) > furthest || std::abs(at.y) > furthest || std::abs(at.z) > furthest)
            throw Refusal{"E0682", "a markup lies more than 2 m away. Export it in millimetres."};
        return at;
    }
    void take_frame(const std::string& word) {
        if (word == "LPS" || word == "1")
            is_ras_ = false;
        else if (word == "RAS" || word == "0")
            is_ras_ = true;
        else
            throw Refusal{"E0681", "the coordinate system is " + shown(word) +
                                       ", must be LPS or RAS. Export the markups from 3D Slicer again."};
    }
    void point(const std::string& label, Vec3 mm) {
        found.points.push_back({id_of(label), place(mm), file_.tolerance, LandmarkPoint::Lies::anywhere});
    }
    void markup(const Json& markup);
    void line(const std::string& name, const std::vector<Vec3>& places);
    void plane(const std::string& name, const Json& markup, const std::vector<Vec3>& places);

    const MarkupsFile& file_;
    bool is_ras_ = false;
};

// ---- .fcsv ----------------------------------------------------------------------------------------------------------

std::vector<std::string> split(std::string_view line, char separator) {
    std::vector<std::string> words;
    for (std::size_t at = 0;;) {
        const std::size_t end = std::min(line.find(separator, at), line.size());
        words.emplace_back(line.substr(at, end - at));
        if (end == line.size()) return words;
        at = end + 1;
    }
}

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t\r");
    return begin == std::string_view::npos ? std::string_view()
                                           : text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

/// What stands behind `# key =`; nothing if the line says something else.
std::optional<std::string_view> remark(std::string_view line, std::string_view key) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos || trimmed(line.substr(1, equals - 1)) != key) return std::nullopt;
    return trimmed(line.substr(equals + 1));
}

void Reader::fcsv(std::string_view text) {
    std::vector<std::string> columns{"id", "x", "y", "z", "ow", "ox", "oy", "oz", "vis", "sel", "lock", "label"};
    bool has_frame = false;
    for (const std::string& whole : split(text, '\n')) {
        const std::string_view line = trimmed(whole);
        if (line.empty()) continue;
        if (line.front() == '#') {
            if (const auto frame = remark(line, "CoordinateSystem")) {
                take_frame(std::string(*frame));
                has_frame = true;
            }
            if (const auto names = remark(line, "columns")) columns = split(*names, ',');
            continue;
        }
        if (!has_frame)
            throw Refusal{"E0681", "the file does not say its coordinate system. "
                                   "Export the markups from 3D Slicer again, as .mrk.json."};
        const std::vector<std::string> cells = split(line, ',');
        const auto cell = [&](const char* name) -> std::string {
            const auto column = std::find(columns.begin(), columns.end(), name);
            const auto at = static_cast<std::size_t>(column - columns.begin());
            if (column == columns.end() || at >= cells.size())
                throw Refusal{"E0680", std::string("a line has no column `") + name + "`. Export the markups again."};
            return std::string(trimmed(cells[at]));
        };
        const auto number = [&](const char* name) {
            const std::string word = cell(name);
            double value = 0.0;
            const auto end = std::from_chars(word.data(), word.data() + word.size(), value);
            if (end.ec != std::errc{} || end.ptr != word.data() + word.size())
                throw Refusal{"E0680", std::string("`") + name + "` of a point is " + shown(word) +
                                           ", must be a number. Export the markups again."};
            return value;
        };
        const double x = number("x"), y = number("y"), z = number("z");
        point(cell("label"), {x, y, z});
    }
}

// ---- .mrk.json ------------------------------------------------------------------------------------------------------

std::string text_of(const Json& map, const char* key) {
    const auto at = map.find(key);
    return at != map.end() && at->is_string() ? at->get<std::string>() : std::string();
}

std::optional<Vec3> vector_of(const Json& map, const char* key) {
    const auto at = map.find(key);
    if (at == map.end() || !at->is_array() || at->size() != 3) return std::nullopt;
    for (const Json& number : *at)
        if (!number.is_number()) return std::nullopt;
    return Vec3{(*at)[0].get<double>(), (*at)[1].get<double>(), (*at)[2].get<double>()};
}

void Reader::line(const std::string& name, const std::vector<Vec3>& places) {
    if (places.size() != 2 || length(places[1] - places[0]) < 1e-6)
        throw Refusal{"E0682", "the line " + shown(name) + " needs two points apart from each other. Place both."};
    found.axes.push_back({id_of(name), places[0], places[1], file_.tolerance});
}

void Reader::plane(const std::string& name, const Json& markup, const std::vector<Vec3>& places) {
    std::optional<Vec3> at = vector_of(markup, "center"), normal = vector_of(markup, "normal");
    if (!at) at = vector_of(markup, "origin");
    Vec3 where{}, across{};
    if (at && normal) {
        where = place(*at);
        across = is_ras_ ? Vec3{-normal->x, -normal->y, normal->z} : *normal;
    } else if (places.size() >= 3) {
        where = places[0];
        across = 1e6 * cross(places[1] - places[0], places[2] - places[0]);  // [mm²]
    }
    if (!is_finite(across) || length(across) < 1e-3)
        throw Refusal{"E0682", "the plane " + shown(name) + " has no normal. Place it in 3D Slicer and save it again."};
    found.planes.push_back({id_of(name), where, normalized(across), file_.tolerance});
}

void Reader::markup(const Json& markup) {
    if (!markup.is_object()) throw Refusal{"E0680", "a markup is no object. Export the markups again."};
    const std::string type = text_of(markup, "type"), frame = text_of(markup, "coordinateSystem");
    if (frame.empty())
        throw Refusal{"E0681", "a markup does not say its `coordinateSystem`. Export it from 3D Slicer again."};
    take_frame(frame);
    if (const std::string unit = text_of(markup, "coordinateUnits"); !unit.empty() && unit != "mm")
        throw Refusal{"E0681", "the coordinates are in " + shown(unit) + ", must be mm. Export them in millimetres."};

    std::vector<Vec3> places;
    std::string first_label;
    const auto points = markup.find("controlPoints");
    if (points != markup.end() && points->is_array())
        for (const Json& one : *points) {
            const std::optional<Vec3> mm = one.is_object() ? vector_of(one, "position") : std::nullopt;
            const std::string status = one.is_object() ? text_of(one, "positionStatus") : "";
            if (!mm || (!status.empty() && status != "defined"))
                throw Refusal{"E0682", "a point " + shown(one.is_object() ? text_of(one, "label") : "") +
                                           " has no place. Place it in 3D Slicer, or delete it."};
            if (type == "Fiducial")
                point(text_of(one, "label"), *mm);
            else
                places.push_back(place(*mm));
            if (first_label.empty()) first_label = text_of(one, "label");
        }
    if (type == "Fiducial") return;
    const std::string name = text_of(markup, "name").empty() ? first_label : text_of(markup, "name");
    if (type == "Line") return line(name, places);
    if (type == "Plane") return plane(name, markup, places);
    throw Refusal{"E0682", "a markup is of type " + shown(type) +
                               "; points (Fiducial), lines (Line) and planes (Plane) are read. Remove it."};
}

void Reader::json(const std::string& text) {
    const Json document = Json::parse(text, nullptr, false);
    if (document.is_discarded() || !document.is_object() || !document.contains("markups") ||
        !document["markups"].is_array())
        throw Refusal{"E0680", "this is no file of 3D Slicer's markups: it has no list `markups`. Export it again."};
    for (const Json& one : document["markups"]) markup(one);
}

// ---- all of it ------------------------------------------------------------------------------------------------------

bool has_landmark(const Anatomy& anatomy, const std::string& id) {
    const auto is_it = [&](const auto& landmark) { return landmark.id == id; };
    return std::any_of(anatomy.points.begin(), anatomy.points.end(), is_it) ||
           std::any_of(anatomy.axes.begin(), anatomy.axes.end(), is_it) ||
           std::any_of(anatomy.planes.begin(), anatomy.planes.end(), is_it);
}

template <class Landmark>
void move_into(std::vector<Landmark>& all, std::vector<Landmark>& more, const Anatomy& anatomy) {
    for (Landmark& one : more) {
        if (has_landmark(anatomy, one.id))
            throw Refusal{"E0683", "there are two landmarks `" + one.id + "`. Rename one: `names: [{label: " + one.id +
                                       ", id: another}]`."};
        all.push_back(std::move(one));
    }
}

void add(const MarkupsFile& file, const std::string& path, const std::string& text, Anatomy& anatomy) {
    Reader reader(file);
    if (path.ends_with(".fcsv"))
        reader.fcsv(text);
    else if (path.ends_with(".json"))
        reader.json(text);
    else
        throw Refusal{"E0680", "the file's ending names no markups. Use .mrk.json or .fcsv."};
    Anatomy more = anatomy;
    move_into(more.points, reader.found.points, more);
    move_into(more.axes, reader.found.axes, more);
    move_into(more.planes, reader.found.planes, more);
    anatomy = std::move(more);
}

}  // namespace

std::vector<std::uint64_t> add_markups(Anatomy& anatomy, Diagnostics& diagnostics) {
    std::vector<std::uint64_t> hashes;
    const std::vector<MarkupsFile> files = anatomy.markups;
    for (const MarkupsFile& file : files) {
        const std::string path = found_data_file(file.file, anatomy.file);
        const std::size_t first = diagnostics.size();
        const auto because_named = [&] {
            because_of(in_anatomy(anatomy, {"landmarks", "markups"}, "the file is named here."), diagnostics, first);
        };
        const std::optional<std::string> text = read_text_file(path, diagnostics);
        if (!text) {
            because_named();
            continue;
        }
        Fnv1a hash;
        hash.add(*text);
        hashes.push_back(hash.value());
        try {
            add(file, path, *text, anatomy);
        } catch (const Refusal& refusal) {
            diagnostics.push_back(error_about(path, refusal.code, refusal.message));
            because_named();
        }
    }
    anatomy.markups.clear();
    return hashes;
}

}  // namespace kerf
