// SPDX-License-Identifier: Apache-2.0
#include "tidy.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "half_edges.h"
#include "triangle_shape.h"

namespace kerf::burring::displacement {
namespace {

using Vertex = HalfEdges::VertexHandle;
using Edge = HalfEdges::EdgeHandle;
using Face = HalfEdges::FaceHandle;

constexpr double of_12_degrees = 4.705;  // cotangent of the largest angle of a sliver

class Tidying {
public:
    Tidying(Triangles& mesh, const std::vector<std::uint8_t>& stays, const std::vector<std::uint8_t>& is_new,
            const TidyLimits& limits)
        : stays_(&stays), is_new_(&is_new), limits_(&limits) {
        is_sound_ = load(mesh, mesh_, tags_);
    }

    /// Returns whether anything changed.
    bool run() {
        if (!is_sound_) return false;
        constexpr int max_sweeps = 6;
        bool has_changed = true, has_ever = false;
        for (int sweep = 0; sweep < max_sweeps && has_changed; ++sweep) {
            has_changed = false;
            for (std::size_t n = 0; n < mesh_.n_faces(); ++n) {
                const auto f = mesh_.face_handle(static_cast<unsigned>(n));
                if (!mesh_.status(f).deleted() && is_sliver(f) && mend(f)) has_changed = has_ever = true;
            }
        }
        return has_ever;
    }
    [[nodiscard]] Triangles triangles() const { return faces_of(mesh_, tags_); }

private:
    [[nodiscard]] Vec3 at(Vertex v) const { return position(mesh_, v); }
    [[nodiscard]] Corners corners(Face f) const { return corners_of(mesh_, f); }
    [[nodiscard]] bool is_wall(Face f) const { return mesh_.property(tags_, f) != KERF_FACE_SURFACE; }
    [[nodiscard]] bool is_sliver(Face f) const {
        if (worst_cotangent(corners(f)) < of_12_degrees) return false;
        for (const auto v : mesh_.fv_range(f))
            if ((*is_new_)[static_cast<std::size_t>(v.idx())] != 0) return true;
        return false;
    }

    bool mend(Face f) {
        std::vector<HalfEdges::HalfedgeHandle> sides;
        for (const HalfEdges::HalfedgeHandle h : mesh_.fh_range(f)) sides.push_back(h);
        std::stable_sort(sides.begin(), sides.end(), [&](auto a, auto b) { return squared(a) < squared(b); });
        for (const auto side : sides)
            for (const HalfEdges::HalfedgeHandle h : {side, mesh_.opposite_halfedge_handle(side)})
                if (is_good_to_join(h)) {
                    mesh_.collapse(h);
                    return true;
                }
        for (std::size_t i = 3; i-- > 0;) {
            const Edge e = mesh_.edge_handle(sides[i]);
            if (!is_good_to_turn(e)) continue;
            mesh_.flip(e);
            return true;
        }
        return false;
    }
    [[nodiscard]] double squared(HalfEdges::HalfedgeHandle h) const {
        const Vec3 edge_vector = at(mesh_.to_vertex_handle(h)) - at(mesh_.from_vertex_handle(h));
        return dot(edge_vector, edge_vector);
    }

    [[nodiscard]] bool is_good_to_turn(Edge e) const {
        if (mesh_.is_boundary(e) || !mesh_.is_flip_ok(e)) return false;
        const auto h = mesh_.halfedge_handle(e, 0), other = mesh_.halfedge_handle(e, 1);
        const Face one = mesh_.face_handle(h), two = mesh_.face_handle(other);
        if (is_wall(one) != is_wall(two)) return false;
        const Vertex left = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)),
                     right = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(other));
        if (mesh_.is_boundary(left) && mesh_.is_boundary(right)) return false;  // the edge may exist beyond the border
        const Vec3 a = at(mesh_.from_vertex_handle(h)), b = at(mesh_.to_vertex_handle(h)), c = at(left), d = at(right);
        const Corners first{a, d, c}, second{d, b, c};
        const double before = std::max(worst_cotangent({a, b, c}), worst_cotangent({b, a, d}));
        if (!(std::max(worst_cotangent(first), worst_cotangent(second)) < before)) return false;
        // The four corners span a tetrahedron. Its height limits how far the surface moves.
        const double largest = is_wall(one) ? limits_->wall : limits_->flat;
        const Vec3 across = cross(b - a, d - c);
        if (std::abs(dot(across, c - a)) > largest * length(across)) return false;
        const Vec3 out = normal_of({a, b, c}) + normal_of({b, a, d});
        return dot(normal_of(first), out) > 0.0 && dot(normal_of(second), out) > 0.0;
    }

    /// Returns whether the start vertex of a half-edge may be merged into its end vertex.
    [[nodiscard]] bool is_good_to_join(HalfEdges::HalfedgeHandle h) {
        const Vertex merged = mesh_.from_vertex_handle(h), kept = mesh_.to_vertex_handle(h);
        if ((*stays_)[static_cast<std::size_t>(merged.idx())] != 0 || mesh_.is_boundary(merged) ||
            !mesh_.is_collapse_ok(h))
            return false;
        for (const auto v : mesh_.vv_range(merged))
            if (v != kept && mesh_.is_boundary(v) && mesh_.is_boundary(kept) &&
                !mesh_.find_halfedge(v, kept).is_valid())
                return false;
        bool has_wall = false, has_surface = false;
        for (const Face f : mesh_.vf_range(merged)) (is_wall(f) ? has_wall : has_surface) = true;
        if (has_wall && has_surface && !keeps_the_rim(h)) return false;
        double before = 0.0, after = 0.0, wall_off = HUGE_VAL;
        const Vec3 to = at(kept), from = at(merged);
        for (const Face f : mesh_.vf_range(merged)) {
            const Corners old = corners(f);
            before = std::max(before, worst_cotangent(old));
            const Vec3 normal = normal_of(old);
            if (!is_wall(f) && !(std::abs(dot(normal, to - from)) <= limits_->flat)) return false;
            Corners c = old;
            bool collapses = false;
            std::size_t n = 0;
            for (const auto v : mesh_.fv_range(f)) {
                if (v == merged) c[n] = to;
                collapses = collapses || v == kept;
                ++n;
            }
            if (collapses) continue;
            after = std::max(after, worst_cotangent(c));
            const Vec3 turned = normal_of(c);
            // A sliver's own normal means little. Its neighbours' normals stay.
            if (dot(turned, normal) < (is_wall(f) ? 0.5 : 0.0) && worst_cotangent(old) < of_12_degrees) return false;
            if (!(length(turned) > 0.5)) return false;
            if (is_wall(f)) wall_off = std::min(wall_off, std::abs(dot(turned, from - c[0])));
        }
        if (has_wall && !has_surface && wall_off > limits_->wall) return false;
        return after < before && has_same_side(merged, kept);
    }
    /// Returns whether no remaining face would point away from the summed normal of the faces around the vertex.
    [[nodiscard]] bool has_same_side(Vertex merged, Vertex kept) const {
        for (const bool wall : {false, true}) {
            Vec3 out{};
            for (const Face f : mesh_.vf_range(merged))
                if (is_wall(f) == wall) {
                    const auto [a, b, c] = corners(f);
                    out = out + cross(b - a, c - a);
                }
            for (const Face f : mesh_.vf_range(merged)) {
                if (is_wall(f) != wall) continue;
                Corners c{};
                bool collapses = false;
                std::size_t n = 0;
                for (const auto v : mesh_.fv_range(f)) {
                    c[n++] = v == merged ? at(kept) : at(v);
                    collapses = collapses || v == kept;
                }
                if (!collapses && !(dot(normal_of(c), out) > 0.0)) return false;
            }
        }
        return true;
    }
    /// A rim vertex moves along the rim only, and only where the rim is straight.
    [[nodiscard]] bool keeps_the_rim(HalfEdges::HalfedgeHandle h) const {
        const Vertex merged = mesh_.from_vertex_handle(h);
        if (!is_rim(h)) return false;
        Vec3 next{};
        int count = 0;
        for (const HalfEdges::HalfedgeHandle side : mesh_.voh_range(merged)) {
            if (side == h || !is_rim(side)) continue;
            next = at(mesh_.to_vertex_handle(side));
            ++count;
        }
        if (count != 1) return false;
        const Vec3 begin = at(mesh_.to_vertex_handle(h)), edge_vector = next - begin, p = at(merged) - begin;
        const double along = dot(p, edge_vector) / dot(edge_vector, edge_vector);
        return along > 0.0 && along < 1.0 && length(p - along * edge_vector) <= limits_->rim;
    }
    [[nodiscard]] bool is_rim(HalfEdges::HalfedgeHandle h) const {
        return is_wall(mesh_.face_handle(h)) != is_wall(mesh_.face_handle(mesh_.opposite_halfedge_handle(h)));
    }

    HalfEdges mesh_;
    FaceTags tags_;
    const std::vector<std::uint8_t>*stays_, *is_new_;
    const TidyLimits* limits_;
    bool is_sound_ = false;
};

}  // namespace

void tidy(Triangles& mesh, const std::vector<std::uint8_t>& stays, const std::vector<std::uint8_t>& is_new,
          const TidyLimits& limits) {
    Tidying tidying(mesh, stays, is_new, limits);
    if (tidying.run()) mesh = tidying.triangles();
}

}  // namespace kerf::burring::displacement
