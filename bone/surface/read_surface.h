// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "bone/surface/surface_mesh.h"
#include "text/source.h"

/// STL, OBJ and PLY as triangles. Every count is held against the bytes that are there before anything gets memory.
///
///     E0640  the file is missing, no regular file, or cannot be read
///     E0641  the name ends in none of the known endings
///     E0642  over 1 GB, or over 50 million faces
///     E0643  malformed, or a part of the format that is not read
///     E0644  less than its header or its structure promises
///     E0645  a coordinate that is no finite number
///     E0646  a face names a vertex that does not exist
///     E0647  no face at all, or none is left
///     E0654  what the header says of frame or unit is not understood, or contradicts itself or the document
namespace kerf {

/// What a file holds, in its own unit and frame.
struct SurfaceFile {
    SurfaceMesh mesh;
    bool holds_floats = false;   ///< coordinates were stored with 24 bits
    std::optional<bool> is_ras;  ///< by the header's `SPACE=`: RAS, else LPS; none: it does not say
    std::optional<double> unit;  ///< [m] by the header's `UNITS=`; none: it does not say
    bool has_topology = false;   ///< faces share vertices by number; STL repeats them
};

struct SurfaceError {
    const char* code = nullptr;
    std::string message;  ///< what we got and what is needed
    std::string advice;
};

/// From bytes that are in memory. Never throws, but for want of memory.   [any] pure.
/// Error: E0642 … E0647; nothing is left half-read.
[[nodiscard]] std::optional<SurfaceFile> read_stl(std::string_view bytes, SurfaceError& error);
[[nodiscard]] std::optional<SurfaceFile> read_obj(std::string_view bytes, SurfaceError& error);
[[nodiscard]] std::optional<SurfaceFile> read_ply(std::string_view bytes, SurfaceError& error);

/// By the ending of the file's name, in either case. Never throws.   [main]
[[nodiscard]] std::optional<SurfaceFile> read_surface(const std::string& file, Diagnostics& diagnostics);

inline constexpr std::size_t most_faces = 50'000'000;

}  // namespace kerf
