// SPDX-License-Identifier: Apache-2.0
#include "refine.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

namespace kerf::burring::displacement {
namespace {

using Corners = std::array<std::uint32_t, 3>;

constexpr std::uint32_t none = 0xffffffffu;

Edge edge_of(std::uint32_t a, std::uint32_t b) noexcept { return {std::min(a, b), std::max(a, b)}; }

class Refinement {
public:
    Refinement(Triangles& mesh, const WantsSplit& wants_split, const Middle& middle)
        : mesh_(&mesh), wants_split_(&wants_split), middle_(&middle) {
        is_whole_.assign(mesh.tags.size(), 1);
        wish_.assign(mesh.tags.size(), unknown);
        border_ = border_of(mesh);
    }

    bool run(std::size_t max_faces) {
        for (bool has_changed = true; has_changed;) {
            has_changed = false;
            for (std::uint32_t f = 0; f < mesh_->tags.size(); ++f) {
                if (is_whole_[f] == 0 || !(wants(f) || is_unbalanced(f)) || !split(f)) continue;
                has_changed = true;
                if (mesh_->tags.size() > 2 * max_faces) return false;
            }
        }
        close();
        return mesh_->tags.size() <= max_faces;
    }

private:
    enum Wish : std::uint8_t { no, yes, unknown };

    [[nodiscard]] Corners corners(std::uint32_t f) const {
        const auto& t = mesh_->triangles;
        return {t[3 * f], t[3 * f + 1], t[3 * f + 2]};
    }
    [[nodiscard]] Edge edge(std::uint32_t f, std::size_t side) const {
        const Corners c = corners(f);
        return edge_of(c[side], c[(side + 1) % 3]);
    }
    [[nodiscard]] bool is_border(Edge e) const { return std::binary_search(border_.begin(), border_.end(), e); }
    [[nodiscard]] std::uint32_t middle_of(Edge e) const {
        const auto found = middles_.find(e);
        return found == middles_.end() ? none : found->second;
    }
    [[nodiscard]] bool wants(std::uint32_t f) {
        if (wish_[f] == unknown) {
            double longest = 0.0;
            for (std::size_t side = 0; side < 3; ++side) {
                const Edge e = edge(f, side);
                if (!is_border(e))
                    longest = std::max(longest, length(mesh_->vertices[e.second] - mesh_->vertices[e.first]));
            }
            wish_[f] = (*wants_split_)(*mesh_, f, longest) ? yes : no;
        }
        return wish_[f] == yes;
    }
    /// Returns whether two sides have a vertex, or a half of a side has one.
    [[nodiscard]] bool is_unbalanced(std::uint32_t f) const {
        int count = 0;
        for (std::size_t side = 0; side < 3; ++side) {
            const Edge e = edge(f, side);
            const std::uint32_t m = middle_of(e);
            if (m == none) continue;
            ++count;
            if (middle_of(edge_of(e.first, m)) != none || middle_of(edge_of(m, e.second)) != none) return true;
        }
        return count > 1;
    }

    /// Splits a face on all sides that are not on the border. Returns false if all are.
    bool split(std::uint32_t f) {
        std::array<std::uint32_t, 3> m{};
        std::size_t count = 0;
        for (std::size_t side = 0; side < 3; ++side) {
            const Edge e = edge(f, side);
            m[side] = none;
            if (is_border(e)) continue;
            ++count;
            const auto [entry, is_new] = middles_.try_emplace(e, static_cast<std::uint32_t>(mesh_->vertices.size()));
            if (is_new) mesh_->vertices.push_back((*middle_)(mesh_->vertices[e.first], mesh_->vertices[e.second]));
            m[side] = entry->second;
        }
        if (count == 0) {
            wish_[f] = no;
            return false;
        }
        replace(f, m);
        return true;
    }

    /// Replaces one face by two, three or four; `m` has the vertices of its sides.
    void replace(std::uint32_t f, const std::array<std::uint32_t, 3>& m) {
        const Corners c = corners(f);
        const std::size_t count =
            static_cast<std::size_t>(std::count_if(m.begin(), m.end(), [](auto v) { return v != none; }));
        is_whole_[f] = 0;
        if (count == 3) {
            for (const Corners& part :
                 {Corners{c[0], m[0], m[2]}, {c[1], m[1], m[0]}, {c[2], m[2], m[1]}, {m[0], m[1], m[2]}})
                add(part, f);
            return;
        }
        // The first side is the only one that stays, or the only one that is halved.
        std::size_t first = 0;
        while ((m[first] == none) != (count == 2)) ++first;
        const std::uint32_t a = c[first], b = c[(first + 1) % 3], apex = c[(first + 2) % 3];
        if (count == 1) {
            add({a, m[first], apex}, f);
            add({m[first], b, apex}, f);
            return;
        }
        const std::uint32_t right = m[(first + 1) % 3], left = m[(first + 2) % 3];
        const auto squared = [&](std::uint32_t p, std::uint32_t q) {
            const Vec3 edge_vector = mesh_->vertices[q] - mesh_->vertices[p];
            return dot(edge_vector, edge_vector);
        };
        add({apex, left, right}, f);
        if (squared(a, right) <= squared(b, left)) {
            add({a, b, right}, f);
            add({a, right, left}, f);
        } else {
            add({a, b, left}, f);
            add({b, right, left}, f);
        }
    }
    void add(const Corners& c, std::uint32_t parent) {
        mesh_->triangles.insert(mesh_->triangles.end(), c.begin(), c.end());
        mesh_->tags.push_back(mesh_->tags[parent]);
        is_whole_.push_back(1);
        wish_.push_back(unknown);
    }

    /// Halves faces with a vertex on one side, and drops the faces that were split.
    void close() {
        const auto count = static_cast<std::uint32_t>(mesh_->tags.size());
        for (std::uint32_t f = 0; f < count; ++f) {
            if (is_whole_[f] == 0) continue;
            std::array<std::uint32_t, 3> m{};
            for (std::size_t side = 0; side < 3; ++side) m[side] = middle_of(edge(f, side));
            if (m != std::array{none, none, none}) replace(f, m);
        }
        Triangles left;
        left.vertices = std::move(mesh_->vertices);
        for (std::uint32_t f = 0; f < mesh_->tags.size(); ++f) {
            if (is_whole_[f] == 0) continue;
            const Corners c = corners(f);
            left.triangles.insert(left.triangles.end(), c.begin(), c.end());
            left.tags.push_back(mesh_->tags[f]);
        }
        *mesh_ = std::move(left);
    }

    Triangles* mesh_;
    const WantsSplit* wants_split_;
    const Middle* middle_;
    std::vector<std::uint8_t> is_whole_, wish_;
    std::vector<Edge> border_;
    std::map<Edge, std::uint32_t> middles_;
};

}  // namespace

std::vector<Edge> border_of(const Triangles& mesh) {
    std::vector<Edge> edges, border;
    const auto& t = mesh.triangles;
    for (std::size_t f = 0; f < mesh.tags.size(); ++f)
        for (std::size_t side = 0; side < 3; ++side)
            edges.push_back(edge_of(t[3 * f + side], t[3 * f + (side + 1) % 3]));
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size(); ++i)
        if ((i == 0 || edges[i - 1] != edges[i]) && (i + 1 == edges.size() || edges[i + 1] != edges[i]))
            border.push_back(edges[i]);
    return border;
}

bool refine(Triangles& mesh, const WantsSplit& wants_split, const Middle& middle, std::size_t max_faces) {
    return Refinement(mesh, wants_split, middle).run(max_faces);
}

}  // namespace kerf::burring::displacement
