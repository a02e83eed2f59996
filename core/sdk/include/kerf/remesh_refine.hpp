// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>

#include "kerf/remesh_mesh.hpp"

namespace kerf::remeshing {

/// Splits edges longer than `longest` [m] in their middle, until there is none for which `is_near(middle, length)`. Of
/// a face with three such edges it makes four, with two three, with one two; new faces keep their tag. Vertices keep
/// their numbers. Edges between two locked vertices stay whole, so that a locked border comes back.   [any]
/// @param locked   of each vertex: 1 for locked; may be empty
template <class IsNear>
void split_long_edges(Triangles& mesh, std::span<const std::uint8_t> locked, double longest, const IsNear& is_near) {
    constexpr std::uint32_t whole = 0xffffffffu;
    const auto is_locked = [&](std::uint32_t v) { return v < locked.size() && locked[v] != 0; };
    for (bool has_split = true; has_split;) {
        has_split = false;
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle_of = [&](std::uint32_t a, std::uint32_t b) {
            const auto [found, is_first] = middles.try_emplace({std::min(a, b), std::max(a, b)}, whole);
            if (!is_first || (is_locked(a) && is_locked(b))) return found->second;
            const Vec3 from = mesh.vertices[found->first.first], to = mesh.vertices[found->first.second];
            const double span = length(to - from);
            if (!(span > longest) || !is_near(0.5 * (from + to), span)) return whole;
            mesh.vertices.push_back(0.5 * (from + to));
            return found->second = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
        };
        Triangles next;
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint8_t tag) {
            next.triangles.insert(next.triangles.end(), {a, b, c});
            next.tags.push_back(tag);
        };
        for (std::size_t f = 0; f < mesh.tags.size(); ++f) {
            std::array<std::uint32_t, 3> v{mesh.triangles[3 * f], mesh.triangles[3 * f + 1], mesh.triangles[3 * f + 2]};
            std::array<std::uint32_t, 3> m{middle_of(v[0], v[1]), middle_of(v[1], v[2]), middle_of(v[2], v[0])};
            const int count = (m[0] != whole) + (m[1] != whole) + (m[2] != whole);
            has_split = has_split || count > 0;
            // One split edge first, the whole one last.
            for (int turn = 0; turn < 2 && (count == 1 ? m[0] == whole : count == 2 && m[2] != whole); ++turn) {
                v = {v[1], v[2], v[0]};
                m = {m[1], m[2], m[0]};
            }
            const std::uint8_t tag = mesh.tags[f];
            if (count == 0) {
                add(v[0], v[1], v[2], tag);
            } else if (count == 1) {
                add(v[0], m[0], v[2], tag);
                add(m[0], v[1], v[2], tag);
            } else if (count == 2) {
                add(v[0], m[0], v[2], tag);
                add(m[0], m[1], v[2], tag);
                add(m[0], v[1], m[1], tag);
            } else {
                add(v[0], m[0], m[2], tag);
                add(m[0], v[1], m[1], tag);
                add(m[2], m[1], v[2], tag);
                add(m[0], m[1], m[2], tag);
            }
        }
        mesh.triangles = std::move(next.triangles);
        mesh.tags = std::move(next.tags);
    }
}

}  // namespace kerf::remeshing
