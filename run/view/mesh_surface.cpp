// SPDX-License-Identifier: Apache-2.0
#include "run/view/mesh_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "core/field/grid/box.h"

namespace kerf::run {

namespace {

using Triangle = std::array<std::uint32_t, 3>;

std::array<double, 3> parts_of(Vec3 v) noexcept { return {v.x, v.y, v.z}; }

Box box_of(const Mesh& mesh) {
    Box box = empty_box;
    for (const Vec3 v : mesh.vertices) box = joined(box, v);
    return box;
}

double largest_side(const Box& box) noexcept {
    const Vec3 size = box.high - box.low;
    return std::max({size.x, size.y, size.z});
}

/// Returns twice the area of a triangle [m²].
double twice_area(const Mesh& mesh, const Triangle& t) noexcept {
    const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    return length(cross(b - a, c - a));
}

bool is_drawn(const Mesh& mesh, const Triangle& t) noexcept {
    return std::max({t[0], t[1], t[2]}) < mesh.vertices.size() && twice_area(mesh, t) > 0.0;
}

/// Vertices with the same key become one.
struct Key {
    std::array<std::int32_t, 3> cell{};
    std::uint8_t tissue = 0, direction = 0;
    friend auto operator<=>(const Key&, const Key&) = default;
};

/// Main direction of a normal, 0 … 5.
std::uint8_t direction_of(Vec3 normal) noexcept {
    const std::array<double, 3> parts = parts_of(normal);
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(parts[i]) > std::abs(parts[axis])) axis = i;
    return static_cast<std::uint8_t>(2 * axis + (parts[axis] < 0.0 ? 1 : 0));
}

Mesh merged(const Mesh& mesh, Vec3 low, double cell) {
    std::vector<std::pair<Key, std::uint32_t>> keys;
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
        Key key{.tissue = mesh.tissue[v], .direction = direction_of(mesh.normals[v])};
        const std::array<double, 3> at = parts_of(mesh.vertices[v] - low);
        for (std::size_t i = 0; i < 3; ++i) key.cell[i] = static_cast<std::int32_t>(at[i] / cell);
        keys.emplace_back(key, v);
    }
    std::sort(keys.begin(), keys.end());
    Mesh out;
    std::vector<std::uint32_t> number(mesh.vertices.size());
    for (std::size_t from = 0, to = 0; from < keys.size(); from = to) {
        Vec3 position{}, normal{};
        for (; to < keys.size() && keys[to].first == keys[from].first; ++to) {
            number[keys[to].second] = static_cast<std::uint32_t>(out.vertices.size());
            position = position + mesh.vertices[keys[to].second];
            normal = normal + mesh.normals[keys[to].second];
        }
        out.vertices.push_back((1.0 / static_cast<double>(to - from)) * position);
        out.normals.push_back(normalized(normal));
        out.tissue.push_back(keys[from].first.tissue);
    }
    for (const Triangle& t : mesh.triangles) {
        const Triangle one{number[t[0]], number[t[1]], number[t[2]]};
        if (is_drawn(out, one)) out.triangles.push_back(one);
    }
    return out;
}

// ---- bricks -------------------------------------------------------------------------------------------------------

std::int8_t in_127ths(double part) {
    return static_cast<std::int8_t>(std::lround(127.0 * std::clamp(part, -1.0, 1.0)));
}

ViewedVertex viewed_vertex(const Mesh& mesh, std::uint32_t v) {
    ViewedVertex vertex{};
    const std::array<double, 3> position = parts_of(mesh.vertices[v]), normal = parts_of(mesh.normals[v]);
    for (std::size_t i = 0; i < 3; ++i) {
        vertex.position[i] = static_cast<float>(position[i]);
        vertex.normal[i] = in_127ths(normal[i]);
    }
    vertex.tissue = mesh.tissue[v];
    vertex.light = std::numeric_limits<std::uint8_t>::max();
    return vertex;
}

/// Returns triangles by brick: those whose middle lies in it.
std::map<std::size_t, std::vector<Triangle>> by_brick(const Mesh& mesh, const ViewedBodySurface& surface) {
    const double edge = 8.0 * surface.spacing;
    std::map<std::size_t, std::vector<Triangle>> bricks;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 middle = (1.0 / 3.0) * (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]);
        const std::array<double, 3> at = parts_of(middle - surface.origin);
        std::array<int, 3> index{};
        for (std::size_t i = 0; i < 3; ++i)
            index[i] = std::clamp(static_cast<int>(at[i] / edge), 0, surface.bricks[i] - 1);
        bricks[static_cast<std::size_t>((index[2] * surface.bricks[1] + index[1]) * surface.bricks[0] + index[0])]
            .push_back(t);
    }
    return bricks;
}

ViewedPatch patch_of(const Mesh& mesh, const std::vector<Triangle>& triangles, std::vector<std::uint32_t>& number) {
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    ViewedPatch patch;
    for (const Triangle& t : triangles) {
        std::array<std::uint16_t, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            if (number[t[i]] == none) {
                number[t[i]] = static_cast<std::uint32_t>(patch.vertices.size());
                patch.vertices.push_back(viewed_vertex(mesh, t[i]));
            }
            corners[i] = static_cast<std::uint16_t>(number[t[i]]);
        }
        patch.triangles.push_back(corners);
    }
    for (const Triangle& t : triangles)
        for (const std::uint32_t v : t) number[v] = none;
    return patch;
}

}  // namespace

Mesh thinned(const Mesh& mesh, std::size_t max_triangles) {
    Mesh all{mesh.vertices, mesh.normals, mesh.tissue, {}};
    double area = 0.0;
    for (const Triangle& t : mesh.triangles)
        if (is_drawn(mesh, t)) {
            all.triangles.push_back(t);
            area += 0.5 * twice_area(mesh, t);
        }
    if (all.triangles.size() <= max_triangles) return all;
    constexpr double coarser = 1.2, finest = 1e-6;  // [–], of the largest side
    const Box box = box_of(mesh);
    // A closed surface has about two triangles for each face of a cell that it passes.
    double cell = std::max(finest * largest_side(box), std::sqrt(2.0 * area / static_cast<double>(max_triangles)));
    while (true) {
        Mesh fewer = merged(all, box.low, cell);
        if (fewer.triangles.size() <= max_triangles) return fewer;
        cell *= coarser;
    }
}

std::optional<ViewedBodySurface> viewed_surface(const Mesh& mesh) {
    if (mesh.triangles.empty()) return std::nullopt;
    constexpr double triangles_of_brick = 128.0, faces = 6.0;
    constexpr int max_bricks = 128;             // along an axis
    constexpr std::size_t max_of_brick = 2700;  // triangles: so a block of eight bricks has fewer than 65 536 vertices
    const Box box = box_of(mesh);
    const Vec3 size = box.high - box.low;
    const double count = static_cast<double>(mesh.triangles.size());
    std::vector<std::uint32_t> number(mesh.vertices.size(), std::numeric_limits<std::uint32_t>::max());
    for (int along = std::clamp(static_cast<int>(std::sqrt(count / (faces * triangles_of_brick))), 1, max_bricks);
         along <= max_bricks; along *= 2) {
        ViewedBodySurface surface{.spacing = std::max(largest_side(box), 1e-6) / along / 8.0, .origin = box.low};
        const std::array<double, 3> sides = parts_of(size);
        for (std::size_t i = 0; i < 3; ++i)
            surface.bricks[i] = std::clamp(static_cast<int>(std::ceil(sides[i] / (8.0 * surface.spacing))), 1, along);
        const auto bricks = by_brick(mesh, surface);
        if (std::ranges::any_of(bricks, [](const auto& one) { return one.second.size() > max_of_brick; })) continue;
        surface.patches = PagedTable<ViewedPatch>(static_cast<std::size_t>(surface.bricks[0]) *
                                                  static_cast<std::size_t>(surface.bricks[1]) *
                                                  static_cast<std::size_t>(surface.bricks[2]));
        std::vector<PatchChange<ViewedPatch>> patches;
        for (const auto& [brick, triangles] : bricks)
            patches.push_back({brick, std::make_shared<const ViewedPatch>(patch_of(mesh, triangles, number))});
        surface.patches = surface.patches.with(patches);
        return surface;
    }
    return std::nullopt;
}

}  // namespace kerf::run
