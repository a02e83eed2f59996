// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bone/surface/header_claims.h"
#include "bone/surface/read_surface.h"
#include "bone/surface/text_lines.h"

namespace kerf::bone {
namespace {

constexpr std::size_t header_size = 84, face_size = 50;

std::uint32_t uint32_at(std::string_view bytes, std::size_t at) noexcept {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
    return value;
}

bool is_word(std::string_view word, std::string_view lower) {
    return std::equal(word.begin(), word.end(), lower.begin(), lower.end(),
                      [](char got, char want) { return want == (got >= 'A' && got <= 'Z' ? got - 'A' + 'a' : got); });
}

/// Adds three new vertices and a face.
void add_face(SurfaceMesh& mesh, const std::array<Vec3, 3>& corners) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
}

SurfaceError not_finite(std::size_t face) {
    return {"E0645", "face " + std::to_string(face + 1) + " has a coordinate that is no finite number.",
            "Export the surface again."};
}

std::optional<SurfaceFile> read_binary(std::string_view bytes, std::size_t count, SurfaceError& error) {
    SurfaceFile file;
    if (!read_claims(bytes.substr(0, 80), file, error)) return std::nullopt;
    file.has_floats = true;
    file.mesh.vertices.reserve(3 * count);
    file.mesh.triangles.reserve(count);
    for (std::size_t f = 0; f < count; ++f) {
        std::array<Vec3, 3> corners;
        std::size_t at = header_size + f * face_size + 12;  // skips the normal, which is not needed and often wrong
        for (Vec3& corner : corners)
            for (double* number : {&corner.x, &corner.y, &corner.z}) {
                *number = static_cast<double>(std::bit_cast<float>(uint32_at(bytes, at)));
                at += 4;
            }
        if (!std::all_of(corners.begin(), corners.end(), [](Vec3 p) { return is_finite(p); })) {
            error = not_finite(f);
            return std::nullopt;
        }
        add_face(file.mesh, corners);
    }
    return file;
}

std::optional<SurfaceFile> read_text(std::string_view bytes, SurfaceError& error) {
    SurfaceFile file;
    std::array<Vec3, 3> corners;
    std::size_t known = 0;  // corners read of the present face
    bool is_ended = false;
    TextLines lines(bytes);
    const auto malformed = [&](const std::string& what) {
        error = {"E0643", "line " + std::to_string(lines.number()) + " " + what,
                 "Export the surface again, as binary STL."};
        return std::nullopt;
    };
    while (lines.next()) {
        const std::string_view word = lines.word();
        if (is_word(word, "vertex")) {
            Vec3 at;
            for (double* number : {&at.x, &at.y, &at.z}) {
                const std::optional<double> value = number_in(lines.word());
                if (!value) return malformed("has no three numbers behind `vertex`.");
                *number = *value;
            }
            if (known == 3) return malformed("is a fourth corner of a face; three are needed.");
            if (!is_finite(at)) {
                error = not_finite(file.mesh.triangles.size());
                return std::nullopt;
            }
            corners[known++] = at;
        } else if (is_word(word, "endloop")) {
            if (known != 3)
                return malformed("ends a face with " + std::to_string(known) + " corners; three are needed.");
            known = 0;
            if (file.mesh.triangles.size() == max_faces) {
                error = {"E0642", "the file has more than 50 million faces.", "Export the surface with fewer faces."};
                return std::nullopt;
            }
            add_face(file.mesh, corners);
        } else if (is_word(word, "endsolid")) {
            is_ended = true;
        } else if (is_word(word, "solid")) {
            if (!read_claims(lines.whole_line(), file, error)) return std::nullopt;
            is_ended = false;
        } else if (is_word(word, "facet")) {
            is_ended = false;
        } else if (!word.empty() && !is_word(word, "outer") && !is_word(word, "endfacet")) {
            return malformed("begins with none of STL's words.");
        }
    }
    if (!is_ended) {
        error = {"E0644",
                 "the file ends in the middle, after " + std::to_string(file.mesh.triangles.size()) + " faces.",
                 "Copy or export it again."};
        return std::nullopt;
    }
    return file;
}

}  // namespace

std::optional<SurfaceFile> read_stl(std::string_view bytes, SurfaceError& error) {
    // Many binary files also begin with "solid". So the count decides first, then the word.
    const std::size_t count = bytes.size() >= header_size ? uint32_at(bytes, 80) : 0;
    const std::size_t promised = header_size + count * face_size;
    const bool is_binary = bytes.size() >= header_size && bytes.size() == promised;
    if (!is_binary) {
        const auto text = utf8_of(bytes, error);
        if (!text) return std::nullopt;
        bytes = *text;
    }
    const std::string_view start = bytes.substr(0, 2000);
    const bool is_text = !is_binary && start.find_first_not_of(" \t\r\n") != std::string_view::npos &&
                         is_word(start.substr(start.find_first_not_of(" \t\r\n"), 5), "solid") &&
                         start.find('\0') == std::string_view::npos;
    std::optional<SurfaceFile> file;
    if (is_text) {
        file = read_text(bytes, error);
    } else if (bytes.size() < header_size) {
        error = {"E0644", "the file has " + std::to_string(bytes.size()) + " bytes, an STL file at least 84.",
                 "Copy or export it again."};
    } else if (bytes.size() < promised) {
        error = {"E0644",
                 "the file promises " + std::to_string(count) + " faces and holds " +
                     std::to_string((bytes.size() - header_size) / face_size) + ".",
                 "Copy or export it again."};
    } else if (bytes.size() - promised >= face_size) {
        error = {"E0643", "the file holds more faces than the " + std::to_string(count) + " it promises.",
                 "Export the surface again."};
    } else if (count > max_faces) {
        error = {"E0642", "the file has more than 50 million faces.", "Export the surface with fewer faces."};
    } else {
        file = read_binary(bytes, count, error);
    }
    if (file && file->mesh.triangles.empty()) {
        error = {"E0647", "the file has no face.", "Export the surface again."};
        return std::nullopt;
    }
    return file;
}

}  // namespace kerf::bone
