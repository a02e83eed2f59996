// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "bone/surface/surface_mesh.h"
#include "text/result.h"

/// Reads STL, OBJ and PLY as triangles. Every count is checked against the size of the file before memory is allocated.
///
///     E0640  the file is missing, is not a regular file, or cannot be read
///     E0641  the name has none of the known endings
///     E0642  over 1 GB, or over 50 million faces
///     E0643  malformed, or an unsupported part of the format
///     E0644  shorter than its header or its structure needs
///     E0645  a coordinate that is not a finite number
///     E0646  a face refers to a vertex that does not exist
///     E0647  no face, or none remains
///     E0654  frame or unit in the header is unknown, or contradicts itself or the document
namespace kerf::bone {

/// The contents of a file, in its own unit and frame.
struct SurfaceFile {
    SurfaceMesh mesh;
    bool has_floats = false;                     ///< coordinates were stored as 32-bit floats, with 24 significant bits
    std::optional<bool> is_ras;                  ///< from the header's `SPACE=`: RAS, otherwise LPS; none: missing
    std::optional<double> unit;                  ///< [m] from the header's `UNITS=`; none: missing
    std::map<std::string, std::size_t> ignored;  ///< counts of what a surface does not use, such as "normals"
    bool has_topology = false;                   ///< faces refer to common vertices by number; STL repeats vertices
};

struct SurfaceError {
    const char* code = nullptr;
    std::string message;  ///< actual and expected value
    std::string advice;
};

/// Reads a surface from bytes in memory. Throws nothing except `std::bad_alloc`.   [any] pure.
/// Error: E0642 … E0647; returns nothing.
[[nodiscard]] std::optional<SurfaceFile> read_stl(std::string_view bytes, SurfaceError& error);
[[nodiscard]] std::optional<SurfaceFile> read_obj(std::string_view bytes, SurfaceError& error);
[[nodiscard]] std::optional<SurfaceFile> read_ply(std::string_view bytes, SurfaceError& error);

/// Reads a file by the ending of its name, in upper or lower case. Never throws.   [main]
[[nodiscard]] text::Result<SurfaceFile> read_surface(const std::string& file);

inline constexpr std::size_t max_faces = 50'000'000;

}  // namespace kerf::bone
