// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "bone/surface/header_claims.h"
#include "bone/surface/polygon.h"
#include "bone/surface/read_surface.h"
#include "bone/surface/text_lines.h"

namespace kerf::bone {
namespace {

/// Returns the vertex of `7`, `7/1`, `7//3`, `-1/2/3`: the number before the first slash.
std::optional<long long> index_in(std::string_view word) {
    word = word.substr(0, word.find('/'));
    long long index = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    return index;
}

/// The words of a statement. A statement continues on the next line after a `\`, and ends before a remark. A whole line
/// of remark is a statement, too.
class StatementWords {
public:
    explicit StatementWords(TextLines& lines) : lines_(lines) {}

    /// Moves to the next statement. Returns false after the last.
    bool next_statement() {
        while (!next().empty()) {
        }
        is_first_ = true;
        return lines_.next();
    }
    /// Returns the next word; empty after the last.
    std::string_view next() {
        for (;;) {
            std::string_view word = lines_.word();
            if (word.empty()) {
                if (!continues_ || !lines_.next()) return {};
                continues_ = false;
                continue;
            }
            const bool begins_remark = word.starts_with('#');
            if (begins_remark && !is_first_) {
                lines_.drop_line();
                continue;
            }
            if (is_first_) is_remark_ = begins_remark;
            is_first_ = false;
            if (is_remark_ || !word.ends_with('\\') || !lines_.is_at_end()) return word;
            continues_ = true;
            word.remove_suffix(1);
            if (!word.empty()) return word;
        }
    }

private:
    TextLines& lines_;
    bool is_first_ = true, is_remark_ = false, continues_ = false;
};

/// Returns the name of the content of a statement, in the plural; null for statements without content.
const char* ignored_by(std::string_view word) {
    return word == "vn"                 ? "normals"
           : word == "vt"               ? "texture coordinates"
           : word == "g" || word == "o" ? "names of groups"
           : word == "usemtl"           ? "uses of materials"
           : word == "l"                ? "lines"
           : word == "p"                ? "points"
                                        : nullptr;
}

}  // namespace

std::optional<SurfaceFile> read_obj(std::string_view bytes, SurfaceError& error) {
    SurfaceFile file;
    file.has_topology = true;
    std::vector<std::uint32_t> corners;
    const auto text = utf8_of(bytes, error);
    if (!text) return std::nullopt;
    TextLines lines(*text);
    const auto refuse = [&](const char* code, const std::string& what) {
        error = {code, "line " + std::to_string(lines.number()) + " " + what, "Export the surface again."};
        return std::nullopt;
    };
    StatementWords words(lines);
    while (words.next_statement()) {
        const std::string_view word = words.next();
        if (word.starts_with('#')) {
            if (!read_claims(lines.whole_line(), file, error)) return std::nullopt;
        } else if (word == "v") {
            Vec3 at;
            for (double* number : {&at.x, &at.y, &at.z}) {
                const std::optional<double> value = number_in(words.next());
                if (!value) return refuse("E0643", "has no three numbers behind `v`.");
                *number = *value;
            }
            if (!is_finite(at)) return refuse("E0645", "has a coordinate that is no finite number.");
            // One more number is a weight; three are a colour.
            const std::optional<double> weight = number_in(words.next());
            const bool has_colour = weight && !words.next().empty();
            if (weight && *weight != 1.0 && !has_colour)
                return refuse("E0643", "gives the vertex a weight other than 1, as of a curved surface.");
            if (has_colour) ++file.ignored["colours"];
            if (file.mesh.vertices.size() == 3 * max_faces)
                return refuse("E0642", "is one vertex too many: 150 million at most.");
            file.mesh.vertices.push_back(at);
        } else if (word == "f" || word == "fo") {  // an older keyword
            corners.clear();
            for (std::string_view corner = words.next(); !corner.empty(); corner = words.next()) {
                const std::optional<long long> index = index_in(corner);
                if (!index) return refuse("E0643", "names a vertex by something that is no whole number.");
                const auto count = static_cast<long long>(file.mesh.vertices.size());
                const long long at = *index > 0 ? *index - 1 : count + *index;  // −1 is the last one so far
                if (*index == 0 || at < 0 || at >= count)
                    return refuse("E0646", "names vertex " + std::to_string(*index) + "; before it there are " +
                                               std::to_string(count) + ".");
                if (corners.size() == max_corners)
                    return refuse("E0643", "is a face of more than " + std::to_string(max_corners) + " corners.");
                corners.push_back(static_cast<std::uint32_t>(at));
            }
            if (corners.size() < 3) return refuse("E0643", "is a face of fewer than three corners.");
            if (file.mesh.triangles.size() + corners.size() > max_faces)
                return refuse("E0642", "is one face too many: 50 million at most.");
            add_polygon(file.mesh, corners);
        } else if (word == "surf" || word == "bzp" || word == "bsp" || word == "cdc" || word == "call") {
            return refuse("E0643", "has `" + std::string(word) + "`: curved surfaces and files in files are not read.");
        } else if (const char* what = ignored_by(word)) {  // no part of the surface
            ++file.ignored[what];
        }
    }
    if (file.mesh.triangles.empty()) {
        error = {"E0647", "the file has no face.", "Export the surface again."};
        return std::nullopt;
    }
    return file;
}

}  // namespace kerf::bone
