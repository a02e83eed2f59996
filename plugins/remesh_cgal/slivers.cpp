// SPDX-License-Identifier: GPL-3.0-or-later
#include "slivers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace kerf::remesh_cgal {
namespace {

using Corners = std::array<std::uint32_t, 3>;

double squared(Vec3 v) noexcept { return dot(v, v); }

/// A mesh with a list of the faces at each vertex.
class Mender {
public:
    Mender(Triangles& mesh, double width) : mesh_(&mesh), width_(width) {
        const std::size_t count = mesh.tags.size();
        faces_.resize(count);
        at_.resize(mesh.vertices.size());
        is_there_.assign(count, 1);
        for (std::uint32_t f = 0; f < count; ++f) {
            faces_[f] = {mesh.triangles[3 * f], mesh.triangles[3 * f + 1], mesh.triangles[3 * f + 2]};
            for (const std::uint32_t v : faces_[f]) at_[v].push_back(f);
        }
        is_on_border_.assign(mesh.vertices.size(), 0);
        for (std::uint32_t f = 0; f < count; ++f)
            for (std::size_t side = 0; side < 3; ++side) {
                const std::uint32_t a = faces_[f][side], b = faces_[f][(side + 1) % 3];
                if (other_face(f, a, b) != none) continue;
                is_on_border_[a] = is_on_border_[b] = 1;
            }
    }

    /// Runs rounds over all faces, in order, until nothing changes. Returns whether anything changed.
    bool run() {
        constexpr int max_rounds = 20;
        for (int round = 0; round < max_rounds; ++round) {
            bool has_changed = false;
            for (std::uint32_t f = 0; f < faces_.size(); ++f)
                if (is_there_[f] != 0 && (collapse_shortest(f) || flip_longest(f))) has_changed = true;
            if (!has_changed) return round > 0;
        }
        return true;
    }

    void write() const {
        Triangles left;
        std::vector<std::uint32_t> numbers(mesh_->vertices.size(), none);
        for (std::uint32_t f = 0; f < faces_.size(); ++f) {
            if (is_there_[f] == 0) continue;
            for (const std::uint32_t v : faces_[f]) {
                if (numbers[v] == none) {
                    numbers[v] = static_cast<std::uint32_t>(left.vertices.size());
                    left.vertices.push_back(mesh_->vertices[v]);
                }
                left.triangles.push_back(numbers[v]);
            }
            left.tags.push_back(mesh_->tags[f]);
        }
        *mesh_ = std::move(left);
    }

private:
    static constexpr std::uint32_t none = 0xffffffffu;

    [[nodiscard]] Vec3 position(std::uint32_t v) const { return mesh_->vertices[v]; }
    [[nodiscard]] bool has(std::uint32_t face, std::uint32_t v) const {
        const Corners& t = faces_[face];
        return t[0] == v || t[1] == v || t[2] == v;
    }
    /// Returns the other face of an edge; `none` on the border.
    [[nodiscard]] std::uint32_t other_face(std::uint32_t face, std::uint32_t a, std::uint32_t b) const {
        for (const std::uint32_t f : at_[a])
            if (f != face && has(f, b)) return f;
        return none;
    }
    [[nodiscard]] std::vector<std::uint32_t> neighbours(std::uint32_t v) const {
        std::vector<std::uint32_t> found;
        for (const std::uint32_t f : at_[v])
            for (const std::uint32_t corner : faces_[f])
                if (corner != v) found.push_back(corner);
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        return found;
    }
    void drop(std::uint32_t face) {
        for (const std::uint32_t v : faces_[face]) at_[v].erase(std::find(at_[v].begin(), at_[v].end(), face));
        is_there_[face] = 0;
    }

    /// Merges the ends of a face's shortest side if the side is short and the surface stays 2-manifold.
    bool collapse_shortest(std::uint32_t face) {
        const Corners t = faces_[face];
        std::size_t side = 0;
        double smallest = HUGE_VAL;
        for (std::size_t i = 0; i < 3; ++i)
            if (const double s = squared(position(t[(i + 1) % 3]) - position(t[i])); s < smallest) {
                smallest = s;
                side = i;
            }
        if (smallest >= width_ * width_) return false;
        std::uint32_t kept = t[side], merged = t[(side + 1) % 3];
        if (is_on_border_[merged] != 0) std::swap(kept, merged);
        if (is_on_border_[merged] != 0) return false;
        // The edge's two faces disappear. If the ends have any other vertex in common, the surface would fold there.
        const std::vector<std::uint32_t> one = neighbours(kept), two = neighbours(merged);
        std::vector<std::uint32_t> both;
        std::set_intersection(one.begin(), one.end(), two.begin(), two.end(), std::back_inserter(both));
        if (both.size() != 2) return false;
        const std::uint32_t second = other_face(face, kept, merged);
        if (second == none) return false;
        // An edge between two border vertices may exist already, beyond the border.
        if (is_on_border_[kept] != 0)
            for (const std::uint32_t v : two)
                if (v != kept && is_on_border_[v] != 0 && !std::binary_search(one.begin(), one.end(), v)) return false;
        // A tetrahedron would become two faces back to back.
        for (const std::uint32_t apex : both)
            if (at_[apex].size() <= 3) return false;
        drop(face);
        drop(second);
        const std::vector<std::uint32_t> moved = at_[merged];
        for (const std::uint32_t f : moved) {
            for (std::uint32_t& corner : faces_[f])
                if (corner == merged) corner = kept;
            at_[kept].push_back(f);
        }
        at_[merged].clear();
        return true;
    }

    /// If a corner lies on its opposite, longest side, flips that side: the neighbouring face is split at the corner.
    bool flip_longest(std::uint32_t face) {
        const Corners t = faces_[face];
        std::size_t side = 0;
        double largest = 0.0;
        for (std::size_t i = 0; i < 3; ++i)
            if (const double s = squared(position(t[(i + 1) % 3]) - position(t[i])); s > largest) {
                largest = s;
                side = i;
            }
        const std::uint32_t a = t[side], b = t[(side + 1) % 3], apex = t[(side + 2) % 3];
        const double area = length(cross(position(b) - position(a), position(apex) - position(a)));
        if (area >= width_ * std::sqrt(largest)) return false;
        const std::uint32_t other = other_face(face, a, b);
        if (other == none) return false;
        std::uint32_t far = none;
        for (const std::uint32_t corner : faces_[other])
            if (corner != a && corner != b) far = corner;
        if (far == none || far == apex || other_face(none, apex, far) != none) return false;  // that edge exists
        if (is_on_border_[apex] != 0 && is_on_border_[far] != 0) return false;  // it may exist beyond the border
        // A flip must improve the shape. Otherwise two needles would pass one sliver to and fro.
        const double before = height(faces_[other]);
        const Corners first{a, far, apex}, second{far, b, apex};
        if (std::min(height(first), height(second)) <= std::min(area / std::sqrt(largest), before)) return false;
        mesh_->tags[face] = mesh_->tags[other];
        drop(face);
        drop(other);
        put(face, first);
        put(other, second);
        return true;
    }
    void put(std::uint32_t face, const Corners& corners) {
        faces_[face] = corners;
        is_there_[face] = 1;
        for (const std::uint32_t v : corners) at_[v].push_back(face);
    }
    [[nodiscard]] double height(const Corners& t) const {
        const Vec3 a = position(t[0]), b = position(t[1]), c = position(t[2]);
        const double longest = std::max({length(b - a), length(c - b), length(a - c)});
        return longest > 0.0 ? length(cross(b - a, c - a)) / longest : 0.0;
    }

    Triangles* mesh_;
    double width_;
    std::vector<Corners> faces_;
    std::vector<std::uint8_t> is_there_, is_on_border_;
    std::vector<std::vector<std::uint32_t>> at_;  ///< faces at each vertex
};

}  // namespace

void remove_slivers(Triangles& mesh, double width) {
    Mender mender(mesh, width);
    if (mender.run()) mender.write();
}

}  // namespace kerf::remesh_cgal
