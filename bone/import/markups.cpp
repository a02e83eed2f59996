// SPDX-License-Identifier: Apache-2.0
#include "bone/import/markups.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "bone/import/data_file.h"
#include "core/field/fnv1a.h"
#include "documents/id.h"
#include "documents/read_anatomy.h"
#include "documents/yaml/document.h"
#include "text/printable.h"

namespace kerf::bone {
namespace {

using Json = nlohmann::json;
using documents::is_id;

constexpr std::size_t largest_text = 1u << 20;  // [bytes]
constexpr double furthest = 2.0;                // [m] of a coordinate, as in documents

/// An error of the file. `add_markups()` turns it into a Diagnostic.
struct ImportError {
    const char* code;
    std::string message;
};

/// Returns text of the file in a form that can be shown to people.
std::string shown(std::string_view text) { return "`" + text::excerpt(text, 40) + "`"; }

/// Returns an id made of the letters of a label: `entry "left"` gives `entry-left`.
std::string id_from_label(std::string_view label) {
    std::string id;
    for (const char c : label) {
        if (id.size() == 40) break;
        if (is_id(std::string_view(&c, 1)))
            id += c;
        else if (!id.empty() && id.back() != '-')
            id += '-';
    }
    while (!id.empty() && id.back() == '-') id.pop_back();
    return id.empty() ? "landmark" : id;
}

/// Returns the entry for `names` of a label that is not an id, or whose id exists already.
std::string entry_of(const std::string& label, const std::string& id) {
    return "{label: " + text::yaml_quoted(label) + ", id: " + id + "}";
}

/// Landmarks of one file.
struct Landmarks {
    std::vector<documents::LandmarkPoint> points;
    std::vector<documents::LandmarkAxis> axes;
    std::vector<documents::LandmarkPlane> planes;
    std::map<std::string, std::vector<std::string>> labels;  ///< labels in the file for each id
};

class Reader {
public:
    explicit Reader(const documents::MarkupsFile& file) : file_(file) {}

    Landmarks found;

    void fcsv(std::string_view text);
    void json(const std::string& text);

    /// Refuses labels that are not ids. The message has the entries for all of them.
    void check_names(const documents::Anatomy& anatomy) const;

private:
    /// Returns the id of a label. A label that is not an id is recorded, and gets a provisional id.
    [[nodiscard]] std::string id_of(const std::string& label) {
        if (label.empty()) throw ImportError{"E0683", "a markup has no label. Give it one in 3D Slicer."};
        const auto renamed = file_.names.find(label);
        const std::string& id = renamed == file_.names.end() ? label : renamed->second;
        const std::string used = is_id(id) ? id : "no id: " + label;
        if (!is_id(id) && !found.labels.contains(used)) nameless_.push_back(label);
        found.labels[used].push_back(label);
        return used;
    }
    /// Converts millimetres in the file's frame to LPS metres.
    [[nodiscard]] Vec3 to_lps(Vec3 mm) const {
        const Vec3 at = 1e-3 * (is_ras_ ? Vec3{-mm.x, -mm.y, mm.z} : mm);
        if (!is_finite(at) || std::abs(at.x) > furthest || std::abs(at.y) > furthest || std::abs(at.z) > furthest)
            throw ImportError{"E0682", "a markup lies more than 2 m away. Export it in millimetres."};
        return at;
    }
    void take_frame(const std::string& word) {
        if (word == "LPS" || word == "1")
            is_ras_ = false;
        else if (word == "RAS" || word == "0")
            is_ras_ = true;
        else
            throw ImportError{"E0681", "the coordinate system is " + shown(word) +
                                           ", must be LPS or RAS. Export the markups from 3D Slicer again."};
    }
    void point(const std::string& label, Vec3 mm) {
        found.points.push_back({id_of(label), to_lps(mm), file_.tolerance, documents::LandmarkPoint::Lies::anywhere});
    }
    void markup(const Json& markup);
    [[nodiscard]] std::string name_of(const Json& markup, const std::string& first_label) const;
    void line(const std::string& name, const std::vector<Vec3>& positions);
    void plane(const std::string& name, const Json& markup, const std::vector<Vec3>& positions);

    const documents::MarkupsFile& file_;
    std::vector<std::string> nameless_;
    bool is_ras_ = false;
};

// ---- .fcsv ----------------------------------------------------------------------------------------------------------

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t\r");
    return begin == std::string_view::npos ? std::string_view()
                                           : text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::vector<std::string> split(std::string_view line, char separator) {
    std::vector<std::string> words;
    for (std::size_t at = 0;;) {
        const std::size_t end = std::min(line.find(separator, at), line.size());
        words.emplace_back(line.substr(at, end - at));
        if (end == line.size()) return words;
        at = end + 1;
    }
}

/// Returns the cells between commas. A cell in double quotes may contain commas, and doubled quotes for single ones, as
/// RFC 4180 defines.
std::vector<std::string> cells_of(std::string_view line) {
    std::vector<std::string> cells(1);
    bool is_quoted = false, was_quoted = false;
    for (std::size_t at = 0; at < line.size(); ++at) {
        const char c = line[at];
        if (is_quoted && c == '"' && at + 1 < line.size() && line[at + 1] == '"') {
            cells.back() += line[++at];
        } else if (is_quoted && c == '"') {
            is_quoted = false;
        } else if (!is_quoted && c == '"' && !was_quoted && trimmed(cells.back()).empty()) {
            is_quoted = was_quoted = true;
            cells.back().clear();
        } else if (!is_quoted && c == ',') {
            if (!was_quoted) cells.back() = std::string(trimmed(cells.back()));
            cells.emplace_back();
            was_quoted = false;
        } else if (!was_quoted || is_quoted) {
            cells.back() += c;
        } else if (c != ' ' && c != '\t') {
            throw ImportError{"E0680", "a line has text behind a quoted cell. Export the markups again."};
        }
    }
    if (is_quoted)
        throw ImportError{"E0680", "a line has a quotation mark that is not closed. Export the markups again."};
    if (!was_quoted) cells.back() = std::string(trimmed(cells.back()));
    return cells;
}

/// Returns the text behind `# key =`; nothing if the line is different.
std::optional<std::string_view> remark(std::string_view line, std::string_view key) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos || trimmed(line.substr(1, equals - 1)) != key) return std::nullopt;
    return trimmed(line.substr(equals + 1));
}

void Reader::fcsv(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // a byte order mark
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
            if (const auto names = remark(line, "columns")) columns = cells_of(*names);
            continue;
        }
        if (!has_frame)
            throw ImportError{"E0681", "the file does not say its coordinate system. "
                                       "Export the markups from 3D Slicer again, as .mrk.json."};
        const std::vector<std::string> cells = cells_of(line);
        const auto cell = [&](const char* name) -> std::string {
            const auto column = std::find(columns.begin(), columns.end(), name);
            const auto at = static_cast<std::size_t>(column - columns.begin());
            if (column == columns.end() || at >= cells.size())
                throw ImportError{"E0680",
                                  std::string("a line has no column `") + name + "`. Export the markups again."};
            return cells[at];
        };
        const auto number = [&](const char* name) {
            const std::string word = cell(name);
            double value = 0.0;
            const std::size_t plus = word.size() > 1 && word[0] == '+' && word[1] != '-' ? 1 : 0;
            const auto end = std::from_chars(word.data() + plus, word.data() + word.size(), value);
            if (end.ec != std::errc{} || end.ptr != word.data() + word.size())
                throw ImportError{"E0680", std::string("`") + name + "` of a point is " + shown(word) +
                                               ", must be a number. Export the markups again."};
            return value;
        };
        const double x = number("x"), y = number("y"), z = number("z");
        point(cell("label"), {x, y, z});
    }
}

// ---- .mrk.json ------------------------------------------------------------------------------------------------------

/// Refuses a value in another form than 3D Slicer writes it.
[[noreturn]] void refuse_form(const char* key, const char* form) {
    throw ImportError{"E0680", std::string("`") + key + "` of a markup is not " + form +
                                   ". Export the markups from 3D Slicer again."};
}

/// Returns the text of a key; nothing if the key is absent. Refuses a value that is not text.
std::optional<std::string> text_of(const Json& map, const char* key) {
    const auto at = map.find(key);
    if (at == map.end()) return std::nullopt;
    if (!at->is_string()) refuse_form(key, "a text");
    return at->get<std::string>();
}

/// Returns the vector of a key; nothing if the key is absent. Refuses a value that is not three numbers.
std::optional<Vec3> vector_of(const Json& map, const char* key) {
    const auto at = map.find(key);
    if (at == map.end()) return std::nullopt;
    const bool is_vector = at->is_array() && at->size() == 3 &&
                           std::all_of(at->begin(), at->end(), [](const Json& number) { return number.is_number(); });
    if (!is_vector) refuse_form(key, "a list of three numbers");
    return Vec3{(*at)[0].get<double>(), (*at)[1].get<double>(), (*at)[2].get<double>()};
}

/// Returns the code of a unit: a text, or a list of code, scheme and meaning. Nothing if the key is absent.
std::optional<std::string> unit_of(const Json& map) {
    constexpr const char* key = "coordinateUnits";
    const auto at = map.find(key);
    if (at == map.end() || at->is_string()) return text_of(map, key);
    const bool is_code = at->is_array() && at->size() == 3 &&
                         std::all_of(at->begin(), at->end(), [](const Json& word) { return word.is_string(); });
    if (!is_code) refuse_form(key, "a text or a list of three");
    return (*at)[1] == "UCUM" ? (*at)[0].get<std::string>()
                              : (*at)[0].get<std::string>() + " of " + (*at)[1].get<std::string>();
}

void Reader::line(const std::string& name, const std::vector<Vec3>& positions) {
    if (positions.size() != 2 || length(positions[1] - positions[0]) < 1e-6)
        throw ImportError{"E0682", "the line " + shown(name) + " needs two points apart from each other. Place both."};
    found.axes.push_back({id_of(name), positions[0], positions[1], file_.tolerance});
}

void Reader::plane(const std::string& name, const Json& markup, const std::vector<Vec3>& positions) {
    const std::optional<Vec3> centre = vector_of(markup, "center"), origin = vector_of(markup, "origin"),
                              normal = vector_of(markup, "normal"), at = centre ? centre : origin;
    Vec3 where{}, across{};
    if (at && normal) {
        where = to_lps(*at);
        across = is_ras_ ? Vec3{-normal->x, -normal->y, normal->z} : *normal;
    } else if (positions.size() >= 3) {
        where = positions[0];
        across = 1e6 * cross(positions[1] - positions[0], positions[2] - positions[0]);  // [mm²]
    }
    if (!is_finite(across) || length(across) < 1e-3)
        throw ImportError{"E0682",
                          "the plane " + shown(name) + " has no normal. Place it in 3D Slicer and save it again."};
    found.planes.push_back({id_of(name), where, normalized(across), file_.tolerance});
}

std::string Reader::name_of(const Json& markup, const std::string& first_label) const {
    const std::string name = text_of(markup, "name").value_or("");
    return name.empty() ? first_label : name;
}

void Reader::markup(const Json& markup) {
    if (!markup.is_object()) throw ImportError{"E0680", "a markup is no object. Export the markups again."};
    const auto frame = text_of(markup, "coordinateSystem");
    if (!frame)
        throw ImportError{"E0681", "a markup does not say its `coordinateSystem`. Export it from 3D Slicer again."};
    take_frame(*frame);
    if (const std::string unit = unit_of(markup).value_or("mm"); unit != "mm")
        throw ImportError{"E0681",
                          "the coordinates are in " + shown(unit) + ", must be mm. Export them in millimetres."};
    const auto type = text_of(markup, "type");
    if (!type) throw ImportError{"E0682", "a markup does not say its `type`. Export it from 3D Slicer again."};

    std::vector<Vec3> positions;
    std::string first_label;
    const auto points = markup.find("controlPoints");
    if (points == markup.end() && *type == "Fiducial")
        throw ImportError{"E0682", "a markup has no `controlPoints`. Place its points in 3D Slicer and save it again."};
    if (points != markup.end() && !points->is_array()) refuse_form("controlPoints", "a list");
    if (points != markup.end())
        for (const Json& one : *points) {
            if (!one.is_object()) refuse_form("controlPoints", "a list of objects");
            const std::string label = text_of(one, "label").value_or("");
            const std::string status = text_of(one, "positionStatus").value_or("defined");
            const bool is_placed = status == "defined" && one.contains("position");
            if (!is_placed)
                throw ImportError{"E0682",
                                  "a point " + shown(label) + " has no place. Place it in 3D Slicer, or delete it."};
            const Vec3 mm = *vector_of(one, "position");
            if (*type == "Fiducial")
                point(label, mm);
            else
                positions.push_back(to_lps(mm));
            if (first_label.empty()) first_label = label;
        }
    if (*type == "Fiducial") return;
    if (*type == "Line") return line(name_of(markup, first_label), positions);
    if (*type == "Plane") return plane(name_of(markup, first_label), markup, positions);
    throw ImportError{"E0682", "a markup is of type " + shown(*type) +
                                   "; points (Fiducial), lines (Line) and planes (Plane) are read. Remove it."};
}

/// Returns the document. Refuses an object with a repeated key, because the parser would silently keep one value.
Json parsed(const std::string& text) {
    std::vector<std::set<std::string>> open;
    std::optional<std::string> twice;
    const auto watch = [&](int, Json::parse_event_t event, Json& value) {
        if (event == Json::parse_event_t::object_start) open.emplace_back();
        if (event == Json::parse_event_t::object_end) open.pop_back();
        if (event == Json::parse_event_t::key && !open.back().insert(value.get<std::string>()).second)
            twice = value.get<std::string>();
        return true;
    };
    Json document = Json::parse(text, watch, false);
    if (!document.is_discarded() && twice)
        throw ImportError{"E0680", "the key " + shown(*twice) + " occurs twice in one object. Remove one."};
    return document;
}

void Reader::json(const std::string& text) {
    const Json document = parsed(text);
    if (document.is_discarded() || !document.is_object() || !document.contains("markups") ||
        !document["markups"].is_array())
        throw ImportError{"E0680",
                          "this is no file of 3D Slicer's markups: it has no list `markups`. Export it again."};
    for (const Json& one : document["markups"]) markup(one);
}

// ---- the whole file -------------------------------------------------------------------------------------------------

bool has_landmark(const documents::Anatomy& anatomy, const std::string& id) {
    const auto is_it = [&](const auto& landmark) { return landmark.id == id; };
    return std::any_of(anatomy.points.begin(), anatomy.points.end(), is_it) ||
           std::any_of(anatomy.axes.begin(), anatomy.axes.end(), is_it) ||
           std::any_of(anatomy.planes.begin(), anatomy.planes.end(), is_it);
}

/// Returns the id, or the id with the first number that makes it unique.
std::string free_id(const std::string& id, const std::function<bool(const std::string&)>& is_taken) {
    std::string one = id;
    for (int n = 2; is_taken(one); ++n) one = id + "-" + std::to_string(n);
    return one;
}

/// Describes where to write entries: under `names` of the file, existing or not.
std::string advice(const documents::MarkupsFile& file, const std::string& entries) {
    return file.names.empty() ? "`names: [" + entries + "]`" : "`" + entries + "` (in its list `names`)";
}

void Reader::check_names(const documents::Anatomy& anatomy) const {
    if (nameless_.empty()) return;
    for (const std::string& label : nameless_)  // no document may contain these characters
        if (text::printable(label) != label)
            throw ImportError{"E0683", "a markup is called " + shown(label) +
                                           ", which holds characters that show nothing. Rename it in 3D Slicer."};
    constexpr std::size_t largest = 20;
    std::set<std::string> given;
    std::string entries;
    for (std::size_t n = 0; n < std::min(largest, nameless_.size()); ++n) {
        const std::string id = free_id(id_from_label(nameless_[n]), [&](const std::string& one) {
            return given.contains(one) || found.labels.contains(one) || has_landmark(anatomy, one);
        });
        given.insert(id);
        entries += (n > 0 ? ", " : "") + entry_of(nameless_[n], id);
    }
    const std::size_t others = nameless_.size() - 1;
    throw ImportError{"E0683", "a markup is called " + shown(nameless_.front()) + ", which is no id" +
                                   (others == 0 ? "" : ", and so are " + std::to_string(others) + " more") + ". Give " +
                                   (others == 0 ? "it one" : "them ids") + ": " + advice(file_, entries) +
                                   (nameless_.size() > largest ? ", and so on." : ".")};
}

template <class Landmark>
void move_into(std::vector<Landmark>& all, const Reader& reader, const documents::MarkupsFile& file,
               const std::vector<Landmark>& more, documents::Anatomy& anatomy) {
    for (const Landmark& one : more) {
        if (has_landmark(anatomy, one.id)) {
            const std::vector<std::string>& labels = reader.found.labels.at(one.id);
            const bool is_one_label = std::count(labels.begin(), labels.end(), labels.front()) > 1;
            const std::string id = free_id(one.id, [&](const std::string& other) {
                return has_landmark(anatomy, other) || reader.found.labels.contains(other);
            });
            throw ImportError{"E0683", "there are two landmarks `" + one.id + "`. " +
                                           (is_one_label ? "Both have the label " + shown(labels.front()) +
                                                               " in the file: rename one in 3D Slicer."
                                            : file.names.contains(labels.back())
                                                ? "Write another id for " + shown(labels.back()) + " under `names`."
                                                : "Rename one: " + advice(file, entry_of(labels.back(), id)) + ".")};
        }
        all.push_back(one);
    }
}

void add(const documents::MarkupsFile& file, const std::string& path, const std::string& text,
         documents::Anatomy& anatomy) {
    Reader reader(file);
    if (path.ends_with(".fcsv"))
        reader.fcsv(text);
    else if (path.ends_with(".json"))
        reader.json(text);
    else
        throw ImportError{"E0680", "the file's ending names no markups. Use .mrk.json or .fcsv."};
    reader.check_names(anatomy);
    documents::Anatomy more = anatomy;
    move_into(more.points, reader, file, reader.found.points, more);
    move_into(more.axes, reader, file, reader.found.axes, more);
    move_into(more.planes, reader, file, reader.found.planes, more);
    anatomy = std::move(more);
}

}  // namespace

std::vector<std::uint64_t> add_markups(documents::Anatomy& anatomy, text::Diagnostics& diagnostics) {
    std::vector<std::uint64_t> hashes;
    const std::vector<documents::MarkupsFile> files = anatomy.markups;
    for (const documents::MarkupsFile& file : files) {
        const std::string path = found_data_file(file.file, anatomy.file);
        const std::size_t first = diagnostics.size();
        const auto because_named = [&] {
            text::because_of(documents::in_anatomy(anatomy, {"landmarks", "markups"}, "the file is named here."),
                             diagnostics, first);
        };
        std::optional<std::string> text;
        if (is_data_file_inside(path, anatomy.file, diagnostics))
            text = documents::read_text_file(path).take(diagnostics);
        if (!text) {
            because_named();
            continue;
        }
        if (text->size() > largest_text) {  // read_text_file() stops at this size
            diagnostics.push_back(
                text::error_about(path, "E0680", "the file is larger than 1 MB. Export fewer markups."));
            because_named();
            continue;
        }
        Fnv1a hash;
        hash.add(*text);
        hashes.push_back(hash.value());
        try {
            add(file, path, *text, anatomy);
        } catch (const ImportError& refusal) {
            diagnostics.push_back(text::error_about(path, refusal.code, refusal.message));
            because_named();
        }
    }
    anatomy.markups.clear();
    return hashes;
}

}  // namespace kerf::bone
