// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "kerf/math.hpp"
#include "kerf/remesh.h"

/// Reads meshes from arenas and writes them, for both sides of the remeshing boundary. A draft, as remesh.h.
namespace kerf::remeshing {

/// How a cut of a mesh ended; `RemeshAnswer::of` returns the answer for it.
enum class Outcome { cut, unchanged, declined, refused, cancelled };
/// A function that returns whether the host has stopped waiting for the answer. A cut calls it between its steps.
using Cancelled = std::function<bool()>;

/// Triangles with tags, in the form that crosses the boundary.
struct Triangles {
    std::vector<Vec3> vertices;            ///< [m]
    std::vector<std::uint32_t> triangles;  ///< three corners of each, anticlockwise seen from outside
    std::vector<std::uint8_t> tags;        ///< of each triangle: KERF_FACE_…
};

/// Returns a view of an array in an arena. Pre: it lies in the arena, as all arrays that the host packs.   [any]
template <class T>
[[nodiscard]] std::span<const T> array(const kerf_arena& arena, kerf_offset at, std::size_t count) {
    return {reinterpret_cast<const T*>(arena.base + at), count};
}

/// Appends values to an arena. Returns their offset; 0 if the arena is too small or `count` is 0.   [any]
template <class T>
[[nodiscard]] kerf_offset append(kerf_arena& arena, const T* values, std::size_t count) {
    constexpr std::uint64_t alignment = 8;
    const kerf_offset at = (std::max<std::uint64_t>(arena.used, 1) + alignment - 1) / alignment * alignment;
    if (count == 0 || at > arena.capacity || count > (arena.capacity - at) / sizeof(T)) return 0;
    std::memcpy(arena.base + at, values, count * sizeof(T));
    arena.used = at + count * sizeof(T);
    return at;
}

[[nodiscard]] inline Triangles read(const kerf_patch& patch, const kerf_arena& arena) {
    const auto copied = [](const auto& values, auto& to) { to.assign(values.begin(), values.end()); };
    Triangles mesh;
    copied(array<Vec3>(arena, patch.vertices, patch.vertex_count), mesh.vertices);
    copied(array<std::uint32_t>(arena, patch.triangles, 3 * std::size_t{patch.triangle_count}), mesh.triangles);
    copied(array<std::uint8_t>(arena, patch.tags, patch.triangle_count), mesh.tags);
    return mesh;
}

/// Writes a mesh into an arena. Returns false if the arena is too small.
[[nodiscard]] inline bool write(const Triangles& mesh, kerf_arena& arena, kerf_patch& patch) {
    patch.vertex_count = static_cast<std::uint32_t>(mesh.vertices.size());
    patch.triangle_count = static_cast<std::uint32_t>(mesh.tags.size());
    patch.vertices = append(arena, mesh.vertices.data(), mesh.vertices.size());
    patch.triangles = append(arena, mesh.triangles.data(), mesh.triangles.size());
    patch.tags = append(arena, mesh.tags.data(), mesh.tags.size());
    patch.locked = 0;
    return mesh.tags.empty() || (patch.vertices != 0 && patch.triangles != 0 && patch.tags != 0);
}

/// Writes the reason of a status, for people, and returns the status.
[[nodiscard]] inline kerf_status refuse(kerf_status status, kerf_remesh_out& out, const std::string& why) {
    std::snprintf(out.message, sizeof out.message, "%s", why.c_str());
    return status;
}

}  // namespace kerf::remeshing
