// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "kerf/remesh_mesh.hpp"

namespace kerf::remeshing {

namespace detail {

using Edge = std::pair<std::uint32_t, std::uint32_t>;  ///< two vertices, the smaller number first

struct EdgeSplit {
    double length = 0.0;  ///< [m]
    bool is_wanted = false, is_locked = false;
    std::uint32_t middle = 0;
};

/// The edges of one pass of split_long_edges.
class EdgesToSplit {
public:
    EdgesToSplit(const Triangles& mesh, std::span<const std::uint8_t> locked) : mesh_(&mesh) {
        const auto is_locked = [&](std::uint32_t v) { return v < locked.size() && locked[v] != 0; };
        for (std::size_t f = 0; f < mesh.tags.size(); ++f) {
            std::array<EdgeSplit*, 3>& sides = faces_.emplace_back();
            for (std::size_t side = 0; side < 3; ++side) {
                const std::uint32_t a = mesh.triangles[3 * f + side], b = mesh.triangles[3 * f + (side + 1) % 3];
                const auto [found, is_new] = all_.try_emplace({std::min(a, b), std::max(a, b)});
                if (is_new) {
                    found->second.length =
                        length(mesh.vertices[found->first.second] - mesh.vertices[found->first.first]);
                    found->second.is_locked = is_locked(a) && is_locked(b);
                }
                sides[side] = &found->second;
            }
        }
    }

    /// Chooses the edges to split: those for which `is_long(middle, length)`. For each face with a chosen edge it also
    /// chooses the face's longest edge, and so on in the neighbour at that edge. So the angles of faces stay bounded,
    /// and splitting terminates. A face whose longest edge is locked is not split. Returns whether any edge is chosen.
    template <class IsLong>
    bool choose(const IsLong& is_long) {
        for (auto& [edge, split] : all_)
            split.is_wanted = is_long(0.5 * (mesh_->vertices[edge.first] + mesh_->vertices[edge.second]), split.length);
        propagate([](EdgeSplit& longest, const std::array<EdgeSplit*, 3>&) { return longest.is_wanted = true; });
        for (auto& [edge, split] : all_) split.is_wanted = split.is_wanted && !split.is_locked;
        propagate([](EdgeSplit&, const std::array<EdgeSplit*, 3>& sides) {
            for (EdgeSplit* side : sides) side->is_wanted = false;
            return true;
        });
        return std::any_of(all_.begin(), all_.end(), [](const auto& one) { return one.second.is_wanted; });
    }
    /// Adds the midpoints of the chosen edges to the vertices of a mesh.
    void add_middles(std::vector<Vec3>& vertices) {
        for (auto& [edge, split] : all_) {
            if (!split.is_wanted) continue;
            split.middle = static_cast<std::uint32_t>(vertices.size());
            vertices.push_back(0.5 * (vertices[edge.first] + vertices[edge.second]));
        }
    }
    [[nodiscard]] const std::array<EdgeSplit*, 3>& of_face(std::size_t face) const { return faces_[face]; }

    /// Returns the longest side of a face; the first of equal ones.
    [[nodiscard]] static std::size_t longest_of(const std::array<EdgeSplit*, 3>& sides) {
        std::size_t longest = 0;
        for (std::size_t side = 1; side < 3; ++side)
            if (sides[side]->length > sides[longest]->length) longest = side;
        return longest;
    }

private:
    /// Calls `change(longest, sides)` for each face with a chosen edge whose longest edge is not chosen, until there is
    /// no such face.
    template <class Change>
    void propagate(const Change& change) {
        for (bool has_changed = true; has_changed;) {
            has_changed = false;
            for (std::array<EdgeSplit*, 3>& sides : faces_) {
                EdgeSplit& longest = *sides[longest_of(sides)];
                const bool is_any = sides[0]->is_wanted || sides[1]->is_wanted || sides[2]->is_wanted;
                if (is_any && !longest.is_wanted) has_changed = change(longest, sides);
            }
        }
    }

    const Triangles* mesh_;
    std::map<Edge, EdgeSplit> all_;
    std::vector<std::array<EdgeSplit*, 3>> faces_;
};

}  // namespace detail

/// Splits edges longer than `longest` [m] for which `is_near(middle, length)` is true, at their midpoints, until no
/// such edge can be split. A face with such an edge is also split at its longest edge. New faces get the tag of the
/// face that they came from; vertices keep their index. Edges between two locked vertices are never split. If one is
/// the longest of its face, that face is not split either.   [any]
/// @param locked   one value per vertex: 1 for locked; may be empty
template <class IsNear>
void split_long_edges(Triangles& mesh, std::span<const std::uint8_t> locked, double longest, const IsNear& is_near) {
    for (;;) {
        detail::EdgesToSplit edges(mesh, locked);
        if (!edges.choose([&](Vec3 middle, double span) { return span > longest && is_near(middle, span); })) return;
        edges.add_middles(mesh.vertices);
        Triangles next;
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint8_t tag) {
            next.triangles.insert(next.triangles.end(), {a, b, c});
            next.tags.push_back(tag);
        };
        for (std::size_t f = 0; f < mesh.tags.size(); ++f) {
            const auto& sides = edges.of_face(f);
            const std::uint8_t tag = mesh.tags[f];
            // Begins at the longest side: it is split if any side is.
            const std::size_t first = detail::EdgesToSplit::longest_of(sides);
            const std::uint32_t a = mesh.triangles[3 * f + first], b = mesh.triangles[3 * f + (first + 1) % 3],
                                c = mesh.triangles[3 * f + (first + 2) % 3];
            const detail::EdgeSplit &ab = *sides[first], &bc = *sides[(first + 1) % 3], &ca = *sides[(first + 2) % 3];
            if (!ab.is_wanted) {
                add(a, b, c, tag);
                continue;
            }
            if (bc.is_wanted) {
                add(ab.middle, b, bc.middle, tag);
                add(ab.middle, bc.middle, c, tag);
            } else {
                add(ab.middle, b, c, tag);
            }
            if (ca.is_wanted) {
                add(a, ab.middle, ca.middle, tag);
                add(ab.middle, c, ca.middle, tag);
            } else {
                add(a, ab.middle, c, tag);
            }
        }
        mesh.triangles = std::move(next.triangles);
        mesh.tags = std::move(next.tags);
    }
}

}  // namespace kerf::remeshing
