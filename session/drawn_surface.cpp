// SPDX-License-Identifier: Apache-2.0
#include "session/drawn_surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kerf::session {
namespace {

using Bytes = std::vector<unsigned char>;

/// Appends the low `size` bytes, least significant first.
void put(Bytes& bytes, std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i) bytes.push_back(static_cast<unsigned char>(value >> (8 * i)));
}

std::vector<Vec3> normals_of(const Mesh& mesh) {
    if (mesh.normals.size() == mesh.vertices.size()) return mesh.normals;
    std::vector<Vec3> normals(mesh.vertices.size(), Vec3{0, 0, 0});
    for (const auto& [a, b, c] : mesh.triangles) {
        if (std::max({a, b, c}) >= mesh.vertices.size()) continue;
        const Vec3 twice_area = cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
        for (const std::uint32_t corner : {a, b, c}) normals[corner] = normals[corner] + twice_area;
    }
    for (Vec3& normal : normals) normal = normalized(normal);
    return normals;
}

}  // namespace

DrawnSurface drawn_surface(const Mesh& mesh) {
    DrawnSurface drawn;
    if (mesh.vertices.empty() || mesh.triangles.empty()) return drawn;

    Vec3 low = mesh.vertices.front(), high = low;
    for (const Vec3 v : mesh.vertices) {
        low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
        high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
    const Vec3 centre = 0.5 * (low + high), half = 0.5 * (high - low);
    drawn.half_size = half;
    drawn.centre = centre;
    drawn.step = std::max({half.x, half.y, half.z, 1e-9}) / 32767.0;

    const auto whole = [](double value) { return static_cast<std::uint32_t>(std::lround(value)); };
    for (const Vec3 v : mesh.vertices)
        for (const double offset : {v.x - centre.x, v.y - centre.y, v.z - centre.z, 0.0})
            put(drawn.positions, whole(offset / drawn.step), 2);
    for (const Vec3 n : normals_of(mesh))
        for (const double part : {n.x, n.y, n.z, 0.0})
            put(drawn.normals, whole(127.0 * std::clamp(part, -1.0, 1.0)), 1);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        drawn.tissues.push_back(i < mesh.tissue.size() ? mesh.tissue[i] : 0);
    for (const auto& [a, b, c] : mesh.triangles) {
        if (std::max({a, b, c}) >= mesh.vertices.size()) continue;
        for (const std::uint32_t corner : {a, b, c}) put(drawn.triangles, corner, drawn.is_short() ? 2 : 4);
    }
    return drawn.is_empty() ? DrawnSurface{} : drawn;
}

Mesh unpacked(const DrawnSurface& surface) {
    const std::size_t vertices = surface.tissues.size(), width = surface.is_short() ? 2 : 4;
    const auto number = [](const Bytes& bytes, std::size_t at, std::size_t size) {
        std::uint32_t value = 0;
        for (std::size_t i = size; i-- > 0;) value = (value << 8) | bytes[at + i];
        return value;
    };
    const auto step = [&](std::size_t at) {
        return surface.step * static_cast<std::int16_t>(number(surface.positions, at, 2));
    };
    const auto part = [&](std::size_t at) { return static_cast<std::int8_t>(surface.normals[at]) / 127.0; };
    Mesh mesh;
    mesh.tissue = surface.tissues;
    for (std::size_t v = 0; v < vertices; ++v) {
        mesh.vertices.push_back(surface.centre + Vec3{step(8 * v), step(8 * v + 2), step(8 * v + 4)});
        mesh.normals.push_back(normalized(Vec3{part(4 * v), part(4 * v + 1), part(4 * v + 2)}));
    }
    for (std::size_t at = 0; at < surface.triangles.size(); at += 3 * width)
        mesh.triangles.push_back({number(surface.triangles, at, width), number(surface.triangles, at + width, width),
                                  number(surface.triangles, at + 2 * width, width)});
    return mesh;
}

bool is_sound(const DrawnSurface& surface) {
    const std::size_t vertices = surface.tissues.size(), width = surface.is_short() ? 2 : 4;
    if (surface.positions.size() != 8 * vertices || surface.normals.size() != 4 * vertices ||
        surface.triangles.size() % (3 * width) != 0)
        return false;
    if (surface.is_empty()) return vertices == 0;
    const Vec3 half = surface.half_size;
    if (!(surface.step > 0.0) || !is_finite(Vec3{surface.step, 0, 0}) || !is_finite(half) || !is_finite(surface.centre))
        return false;
    for (std::size_t at = 0; at < surface.triangles.size(); at += width) {
        std::size_t vertex = 0;
        for (std::size_t i = width; i-- > 0;) vertex = (vertex << 8) | surface.triangles[at + i];
        if (vertex >= vertices) return false;
    }
    return true;
}

}  // namespace kerf::session
