// SPDX-License-Identifier: Apache-2.0
#include "wall.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "half_edges.h"
#include "refine.h"
#include "triangle_shape.h"

namespace kerf::burring::displacement {
namespace {

using Vertex = HalfEdges::VertexHandle;
using Edge = HalfEdges::EdgeHandle;

constexpr std::size_t max_faces = 200'000;
constexpr double of_35_degrees = 1.428;  // cotangent; larger angles need no improvement

/// The half-edges of a wall, and the operations that improve its triangles.
class WallEdges {
public:
    WallEdges(const Triangles& wall, const SweptBurr& burr, const Source& source, const Fineness& fineness)
        : burr_(&burr), source_(&source), fineness_(&fineness) {
        is_sound_ = load(wall, mesh_, tags_);
    }
    [[nodiscard]] bool is_sound() const noexcept { return is_sound_; }
    [[nodiscard]] Triangles triangles() const { return faces_of(mesh_, tags_); }

    /// Repairs slivers that face away from the source: flips one of their edges, or merges two of their vertices.
    void mend_slivers() {
        constexpr int max_sweeps = 4;
        bool has_mended = true;
        for (int sweep = 0; sweep < max_sweeps && has_mended; ++sweep) {
            has_mended = false;
            for (std::size_t n = 0; n < mesh_.n_faces(); ++n) {
                const auto f = mesh_.face_handle(static_cast<unsigned>(n));
                if (!mesh_.status(f).deleted() && !is_right(corners(f)) && mend(f)) has_mended = true;
            }
        }
    }

    void project() {
        for (const auto v : mesh_.vertices())
            if (is_free(v)) move(v, burr_->exit(*source_, at(v)));
    }

    [[nodiscard]] bool all_face_the_source() const {
        for (const auto f : mesh_.faces())
            if (!is_right(corners(f))) return false;
        return true;
    }

    /// Merges vertices whose distance is less than half of the wall's edge length.
    void collapse_short() {
        const double shortest = 0.45 * fineness_->edge, longest = 1.3 * fineness_->edge;
        const std::size_t count = mesh_.n_edges();
        for (std::size_t n = 0; n < count; ++n) {
            const Edge e = mesh_.edge_handle(static_cast<unsigned>(n));
            if (mesh_.status(e).deleted()) continue;
            const auto h = mesh_.halfedge_handle(e, 0);
            Vertex merged = mesh_.from_vertex_handle(h), kept = mesh_.to_vertex_handle(h);
            if (!is_free(merged)) std::swap(merged, kept);
            if (length(at(merged) - at(kept)) >= shortest || !is_good_to_join(merged, kept, longest)) continue;
            mesh_.collapse(mesh_.find_halfedge(merged, kept));
        }
    }

    void improve() {
        constexpr int rounds = 2;
        for (int round = 0; round < rounds; ++round) {
            flip();
            relax();
        }
        flip();
    }

    /// Returns a flag for each face next to an edge that bends too much or whose middle lies too deep in the burr.
    /// Edges shorter than half of the wall's edge length are left out, because the tool itself has an edge there.
    [[nodiscard]] std::vector<std::uint8_t> coarse_faces() const {
        std::vector<std::uint8_t> coarse(mesh_.n_faces(), 0);
        for (const auto e : mesh_.edges()) {
            if (mesh_.is_boundary(e)) continue;
            const auto h = mesh_.halfedge_handle(e, 0), other = mesh_.halfedge_handle(e, 1);
            const Vec3 a = at(mesh_.from_vertex_handle(h)), b = at(mesh_.to_vertex_handle(h));
            if (length(b - a) < 0.5 * fineness_->edge) continue;
            const Corners one = corners(mesh_.face_handle(h)), two = corners(mesh_.face_handle(other));
            const double bend = dot(normal_of(one), normal_of(two));
            // A bend that is off the burr by less than the tolerance comes from a sliver.
            const double off = std::min(height_of(one), height_of(two)) * std::sqrt(std::max(0.0, 1.0 - bend * bend));
            if ((bend >= fineness_->bend_cosine || (bend > 0.0 && off < fineness_->tolerance)) &&
                burr_->outside(0.5 * (a + b)) >= -fineness_->tolerance)
                continue;
            for (const auto side : {h, other}) coarse[static_cast<std::size_t>(mesh_.face_handle(side).idx())] = 1;
        }
        // In the order of the remaining faces, as in triangles().
        std::vector<std::uint8_t> of_left;
        for (const auto f : mesh_.faces()) of_left.push_back(coarse[static_cast<std::size_t>(f.idx())]);
        return of_left;
    }

private:
    [[nodiscard]] Vec3 at(Vertex v) const { return position(mesh_, v); }
    void move(Vertex v, Vec3 to) { mesh_.set_point(v, point_of(to)); }
    [[nodiscard]] bool is_free(Vertex v) const {
        return !mesh_.status(v).deleted() && !mesh_.is_isolated(v) && !mesh_.is_boundary(v);
    }
    [[nodiscard]] Corners corners(HalfEdges::FaceHandle f) const { return corners_of(mesh_, f); }
    [[nodiscard]] bool is_right(const Corners& c) const { return faces(*source_, c[0], c[1], c[2]); }

    /// Visits the faces around a vertex as they would be with that vertex at `to`.
    template <class Visit>
    void for_each_moved(Vertex v, Vec3 to, const Visit& visit) const {
        for (const auto f : mesh_.vf_range(v)) {
            Corners c{};
            std::size_t n = 0;
            for (const auto corner : mesh_.fv_range(f)) c[n++] = corner == v ? to : at(corner);
            visit(f, c);
        }
    }

    /// Returns whether a vertex may be merged into a neighbour: the surface stays 2-manifold and all faces face the
    /// source.
    [[nodiscard]] bool may_join(Vertex merged, Vertex kept) {
        if (!is_free(merged) || !mesh_.is_collapse_ok(mesh_.find_halfedge(merged, kept))) return false;
        for (const auto v : mesh_.vv_range(merged))
            // The surface beyond the border may have that edge already.
            if (v != kept && mesh_.is_boundary(v) && mesh_.is_boundary(kept) &&
                !mesh_.find_halfedge(v, kept).is_valid())
                return false;
        bool is_good = true;
        for_each_left(merged, kept, [&](const auto, const Corners& c) { is_good = is_good && is_right(c); });
        return is_good;
    }
    /// Visits the faces that remain when a vertex is merged into a neighbour.
    template <class Visit>
    void for_each_left(Vertex merged, Vertex kept, const Visit& visit) const {
        for_each_moved(merged, at(kept), [&](const auto f, const Corners& c) {
            for (const auto v : mesh_.fv_range(f))
                if (v == kept) return;
            visit(f, c);
        });
    }
    [[nodiscard]] bool is_good_to_join(Vertex merged, Vertex kept, double longest) {
        if (!may_join(merged, kept)) return false;
        for (const auto v : mesh_.vv_range(merged))
            if (v != kept && length(at(v) - at(kept)) > longest) return false;
        double before = 0.0, after = 0.0;
        for (const auto f : mesh_.vf_range(merged)) before = std::max(before, worst_cotangent(corners(f)));
        for_each_left(merged, kept, [&](const auto, const Corners& c) { after = std::max(after, worst_cotangent(c)); });
        constexpr double of_20_degrees = 2.747;
        return after <= std::max(before, of_20_degrees);
    }

    bool mend(HalfEdges::FaceHandle f) {
        for (const auto e : mesh_.fe_range(f))
            if (may_flip(e) && both_right(e)) {
                mesh_.flip(e);
                return true;
            }
        for (const HalfEdges::HalfedgeHandle h : mesh_.fh_range(f))
            for (const HalfEdges::HalfedgeHandle side : {h, mesh_.opposite_halfedge_handle(h)})
                if (may_join(mesh_.from_vertex_handle(side), mesh_.to_vertex_handle(side))) {
                    mesh_.collapse(side);
                    return true;
                }
        return false;
    }

    void flip() {
        constexpr int max_sweeps = 6;
        for (int sweep = 0; sweep < max_sweeps; ++sweep) {
            bool has_flipped = false;
            for (const auto e : mesh_.edges())
                if (flip(e)) has_flipped = true;
            if (!has_flipped) return;
        }
    }
    /// The corners of the two faces of an edge, as they would be after a flip.
    struct Turned {
        Vec3 a, b, c, d;  ///< the edge from a to b, left of it c, right of it d
        [[nodiscard]] Corners one() const { return {a, d, c}; }
        [[nodiscard]] Corners two() const { return {d, b, c}; }
    };
    [[nodiscard]] Turned turned(Edge e) const {
        const auto h = mesh_.halfedge_handle(e, 0), other = mesh_.halfedge_handle(e, 1);
        return {at(mesh_.from_vertex_handle(h)), at(mesh_.to_vertex_handle(h)),
                at(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h))),
                at(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(other)))};
    }
    [[nodiscard]] bool may_flip(Edge e) const {
        if (mesh_.is_boundary(e) || !mesh_.is_flip_ok(e)) return false;
        const auto apex = [&](unsigned side) {
            return mesh_.to_vertex_handle(mesh_.next_halfedge_handle(mesh_.halfedge_handle(e, side)));
        };
        // The surface beyond the border may have that edge already.
        return !mesh_.is_boundary(apex(0)) || !mesh_.is_boundary(apex(1));
    }
    [[nodiscard]] bool both_right(Edge e) const {
        const Turned t = turned(e);
        return is_right(t.one()) && is_right(t.two());
    }
    /// Flips an edge if that increases the smallest angle of its two faces.
    bool flip(Edge e) {
        if (mesh_.is_boundary(e)) return false;
        const Turned t = turned(e);
        const double before = std::max(worst_cotangent({t.a, t.b, t.c}), worst_cotangent({t.b, t.a, t.d}));
        const double after = std::max(worst_cotangent(t.one()), worst_cotangent(t.two()));
        if (before < of_35_degrees || !(after < before - 1e-9) || !may_flip(e) || !both_right(e)) return false;
        // Does not flip across an edge of the tool.
        if (burr_->outside(0.5 * (t.c + t.d)) < std::min(-fineness_->tolerance, burr_->outside(0.5 * (t.a + t.b))))
            return false;
        mesh_.flip(e);
        return true;
    }

    /// Moves vertices to the middle of the faces around them, and back onto the burr.
    void relax() {
        for (const auto v : mesh_.vertices()) {
            if (!is_free(v)) continue;
            Vec3 sum{};
            double area = 0.0, before = 0.0;
            for (const auto f : mesh_.vf_range(v)) {
                const Corners c = corners(f);
                const double size = length(cross(c[1] - c[0], c[2] - c[0]));
                sum = sum + size * ((c[0] + c[1] + c[2]) / 3.0);
                area += size;
                before = std::max(before, worst_cotangent(c));
            }
            if (before < of_35_degrees) continue;
            const Vec3 to = burr_->exit(*source_, sum / area);
            double after = 0.0;
            bool is_good = is_finite(to);
            for_each_moved(v, to, [&](const auto, const Corners& c) {
                after = std::max(after, worst_cotangent(c));
                is_good = is_good && is_right(c);
            });
            if (is_good && after < before) move(v, to);
        }
    }

    HalfEdges mesh_;
    FaceTags tags_;
    const SweptBurr* burr_;
    const Source* source_;
    const Fineness* fineness_;
    bool is_sound_ = false;
};

}  // namespace

Fineness Fineness::of(double tolerance, double radius) noexcept {
    Fineness fine;
    fine.tolerance = tolerance;
    fine.edge = std::min(std::sqrt(6.0 * radius * tolerance), 0.5 * radius);
    fine.bend_cosine = 1.0 - fine.edge * fine.edge / (6.0 * radius * radius);
    return fine;
}

bool faces(const Source& source, Vec3 a, Vec3 b, Vec3 c) noexcept {
    const Vec3 normal = cross(b - a, c - a), middle = (a + b + c) / 3.0;
    return dot(normal, source.nearest(middle) - middle) > 0.0;
}

Outcome move_onto_burr(Triangles& wall, const SweptBurr& burr, const Source& source, const Fineness& fineness,
                       const Cancelled& cancelled, std::string& why) {
    constexpr int max_passes = 12;
    for (int pass = 0;; ++pass) {
        if (cancelled()) return Outcome::cancelled;
        WallEdges edges(wall, burr, source, fineness);
        if (!edges.is_sound()) {
            why = "the surface inside the swept burr is not 2-manifold";
            return Outcome::refused;
        }
        edges.mend_slivers();
        if (pass == 0 && edges.all_face_the_source()) edges.project();
        if (!edges.all_face_the_source()) {
            why = "a face of the wall would turn over";
            return Outcome::declined;
        }
        if (pass == 0) edges.collapse_short();
        edges.improve();
        const std::vector<std::uint8_t> coarse = edges.coarse_faces();
        wall = edges.triangles();
        if (pass == max_passes || std::find(coarse.begin(), coarse.end(), 1) == coarse.end()) return Outcome::cut;
        const auto wants = [&](const Triangles&, std::uint32_t f, double) {
            return f < coarse.size() && coarse[f] != 0;
        };
        const auto middle = [&](Vec3 a, Vec3 b) { return burr.exit(source, 0.5 * (a + b)); };
        if (!refine(wall, wants, middle, max_faces)) {
            why = "the wall would have more than " + std::to_string(max_faces) + " faces";
            return Outcome::declined;
        }
    }
}

}  // namespace kerf::burring::displacement
