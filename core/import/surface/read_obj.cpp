// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/import/surface/polygon.h"
#include "core/import/surface/read_surface.h"
#include "core/import/surface/text_lines.h"

namespace kerf {
namespace {

/// The vertex of `7`, `7/1`, `7//3`, `-1/2/3`: only what stands before the first slash.
std::optional<long long> index_in(std::string_view word) {
    word = word.substr(0, word.find('/'));
    long long index = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    return index;
}

}  // namespace

std::optional<SurfaceFile> read_obj(std::string_view bytes, SurfaceError& error) {
    SurfaceFile file;
    file.has_topology = true;
    std::vector<std::uint32_t> corners;
    if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);  // a byte order mark: it would hide the first word
    TextLines lines(bytes);
    const auto refuse = [&](const char* code, const std::string& what) {
        error = {code, "line " + std::to_string(lines.number()) + " " + what, "Export the surface again."};
        return std::nullopt;
    };
    while (lines.next()) {
        const std::string_view word = lines.word();
        if (word == "v") {
            Vec3 at;
            for (double* number : {&at.x, &at.y, &at.z}) {
                const std::optional<double> value = number_in(lines.word());
                if (!value) return refuse("E0643", "has no three numbers behind `v`.");
                *number = *value;
            }
            if (!is_finite(at)) return refuse("E0645", "has a coordinate that is no finite number.");
            if (file.mesh.vertices.size() == 3 * most_faces)
                return refuse("E0642", "is one vertex too many: 150 million at most.");
            file.mesh.vertices.push_back(at);
        } else if (word == "f") {
            corners.clear();
            for (std::string_view corner = lines.word(); !corner.empty(); corner = lines.word()) {
                const std::optional<long long> index = index_in(corner);
                if (!index) return refuse("E0643", "names a vertex by something that is no whole number.");
                const auto count = static_cast<long long>(file.mesh.vertices.size());
                const long long at = *index > 0 ? *index - 1 : count + *index;  // −1 is the last one so far
                if (*index == 0 || at < 0 || at >= count)
                    return refuse("E0646", "names vertex " + std::to_string(*index) + "; before it there are " +
                                               std::to_string(count) + ".");
                if (corners.size() == most_corners)
                    return refuse("E0643", "is a face of more than " + std::to_string(most_corners) + " corners.");
                corners.push_back(static_cast<std::uint32_t>(at));
            }
            if (corners.size() < 3) return refuse("E0643", "is a face of fewer than three corners.");
            if (file.mesh.triangles.size() + corners.size() > most_faces)
                return refuse("E0642", "is one face too many: 50 million at most.");
            add_polygon(file.mesh, corners);
        }
        // All else (normals, textures, groups, materials, lines) is no surface.
    }
    if (file.mesh.triangles.empty()) {
        error = {"E0647", "the file has no face.", "Export the surface again."};
        return std::nullopt;
    }
    return file;
}

}  // namespace kerf
