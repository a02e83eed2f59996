// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bone/surface/surface_mesh.h"

/// Surfaces whose every figure is known, and the files that hold them.
namespace kerf::test {

/// A cube around `centre`; faces look outwards. Its eight vertices are numbered like three bits, x the lowest.
inline bone::SurfaceMesh cube(double edge, Vec3 centre = {}) {
    bone::SurfaceMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.vertices.push_back(centre + 0.5 * edge * Vec3{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

/// A sphere: an octahedron whose faces were split into four `splits` times, 8·4ⁿ faces with their corners on the
/// sphere.
inline bone::SurfaceMesh sphere(double radius, int splits, Vec3 centre = {}) {
    bone::SurfaceMesh mesh;
    mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int split = 0; split < splits; ++split) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [at, is_new] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size()));
            if (is_new) mesh.vertices.push_back(normalized(mesh.vertices[a] + mesh.vertices[b]));
            return at->second;
        };
        std::vector<bone::Triangle> finer;
        for (const auto& [a, b, c] : mesh.triangles) {
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {bone::Triangle{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        mesh.triangles = std::move(finer);
    }
    for (Vec3& v : mesh.vertices) v = centre + radius * v;
    return mesh;
}

/// All faces the other way round.
inline bone::SurfaceMesh turned(bone::SurfaceMesh mesh) {
    for (bone::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

/// Both in one, joined nowhere.
inline bone::SurfaceMesh together(bone::SurfaceMesh a, const bone::SurfaceMesh& b) {
    const auto first = static_cast<std::uint32_t>(a.vertices.size());
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (const bone::Triangle& t : b.triangles) a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return a;
}

/// Every face with three vertices of its own, as in STL.
inline bone::SurfaceMesh soup_of(const bone::SurfaceMesh& mesh) {
    bone::SurfaceMesh soup;
    for (const bone::Triangle& t : mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(soup.vertices.size());
        for (const Vec3 corner : mesh.corners(t)) soup.vertices.push_back(corner);
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    return soup;
}

/// The bytes of a number, the smallest first.
template <class Number>
std::string little_endian(Number value) {
    std::string bytes(sizeof value, '\0');
    std::uint64_t bits = 0;
    if constexpr (std::is_same_v<Number, float>)
        bits = std::bit_cast<std::uint32_t>(value);
    else if constexpr (std::is_same_v<Number, double>)
        bits = std::bit_cast<std::uint64_t>(value);
    else
        bits = static_cast<std::uint64_t>(value);
    for (char& byte : bytes) {
        byte = static_cast<char>(bits & 0xff);
        bits >>= 8;
    }
    return bytes;
}
template <class Number>
std::string big_endian(Number value) {
    const std::string bytes = little_endian(value);
    return {bytes.rbegin(), bytes.rend()};
}

inline std::string binary_stl(const bone::SurfaceMesh& mesh, std::string header = "surface") {
    header.resize(80, ' ');
    std::string bytes = header + little_endian(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const bone::Triangle& t : mesh.triangles) {
        bytes += std::string(12, '\0');
        for (const Vec3 p : mesh.corners(t))
            for (const double x : {p.x, p.y, p.z}) bytes += little_endian(static_cast<float>(x));
        bytes += std::string(2, '\0');
    }
    return bytes;
}

}  // namespace kerf::test
