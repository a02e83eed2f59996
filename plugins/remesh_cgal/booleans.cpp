// SPDX-License-Identifier: GPL-3.0-or-later
// The only unit that includes CGAL.
#include "booleans.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/assertions_behaviour.h>
#include <CGAL/convex_hull_3.h>

#include <array>
#include <cfenv>
#include <cmath>
#include <cstddef>
#include <exception>
#include <map>
#include <type_traits>
#include <utility>

namespace kerf::remesh_cgal {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using ExactMesh = CGAL::Surface_mesh<CGAL::Exact_predicates_exact_constructions_kernel::Point_3>;
using RoundedMesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

template <class Mesh>
using Face = typename Mesh::Face_index;
template <class Mesh>
using Tags = typename Mesh::template Property_map<typename Mesh::Face_index, std::uint8_t>;

constexpr const char* tags_of_faces = "f:tag";

/// Copies tags to new faces. Faces of the tool that remain are walls.
template <class Mesh>
struct TagVisitor : pmp::Corefinement::Default_visitor<Mesh> {
    using Face = typename Mesh::Face_index;
    const Mesh* bone = nullptr;
    Tags<Mesh> bone_tags, result_tags;
    std::uint8_t split = 0;

    void before_subface_creations(Face face, const Mesh& mesh) {
        if (&mesh == bone) split = bone_tags[face];
    }
    void after_subface_created(Face face, const Mesh& mesh) {
        if (&mesh == bone) bone_tags[face] = split;
    }
    void after_face_copy(Face from, const Mesh& mesh, Face to, const Mesh& /*result*/) {
        result_tags[to] = &mesh == bone ? bone_tags[from] : std::uint8_t{KERF_FACE_WALL};
    }
};

/// Sets rounding to nearest, which CGAL needs, and restores the previous mode. CGAL leaves another mode when it throws.
class Rounding {
public:
    Rounding() : before_(std::fegetround()) { std::fesetround(FE_TONEAREST); }
    ~Rounding() { std::fesetround(before_); }
    Rounding(const Rounding&) = delete;
    Rounding& operator=(const Rounding&) = delete;

private:
    int before_;
};

template <class Mesh>
bool read(const Triangles& triangles, Mesh& mesh, bool must_be_closed, std::string& why) {
    using Vertex = typename Mesh::Vertex_index;
    Tags<Mesh> tags = mesh.template add_property_map<Face<Mesh>, std::uint8_t>(tags_of_faces, KERF_FACE_SURFACE).first;
    for (const Vec3 v : triangles.vertices) mesh.add_vertex(typename Mesh::Point(v.x, v.y, v.z));
    const auto& t = triangles.triangles;
    for (std::size_t f = 0; 3 * f + 2 < t.size(); ++f) {
        const Face<Mesh> face = mesh.add_face(Vertex(t[3 * f]), Vertex(t[3 * f + 1]), Vertex(t[3 * f + 2]));
        if (face == Mesh::null_face()) {
            why = "face " + std::to_string(f) + " meets an edge that has two faces already";
            return false;
        }
        tags[face] = triangles.tags[f];
    }
    if (must_be_closed && !CGAL::is_closed(mesh)) {
        why = "the mesh is open";
        return false;
    }
    return true;
}

double rounded(double x) { return x; }
double rounded(const CGAL::Exact_predicates_exact_constructions_kernel::FT& x) {
    // An interval is wider than one rounding until the exact number is evaluated.
    if (const auto [low, high] = CGAL::to_interval(x); low == high) return low;
    return CGAL::to_double(x.exact());
}

/// Collects faces of meshes. Points that round to one point become one vertex. A face that loses a side is dropped.
class Writer {
public:
    template <class Mesh>
    void add(const Mesh& mesh, Face<Mesh> face, bool is_reversed, std::uint8_t tag) {
        std::array<std::uint32_t, 3> corners{};
        std::size_t n = 0;
        for (const auto v : vertices_around_face(mesh.halfedge(face), mesh)) corners[n++] = number_of(mesh.point(v));
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return;
        if (is_reversed) std::swap(corners[1], corners[2]);
        triangles_.triangles.insert(triangles_.triangles.end(), corners.begin(), corners.end());
        triangles_.tags.push_back(tag);
    }
    /// Returns the mesh without slivers narrower than `width` [m].
    [[nodiscard]] Triangles take(double width) {
        remove_slivers(triangles_, width);
        return std::move(triangles_);
    }

private:
    template <class Point>
    std::uint32_t number_of(const Point& p) {
        const std::array<double, 3> at{rounded(p.x()), rounded(p.y()), rounded(p.z())};
        const auto [entry, is_new] = known_.try_emplace(at, static_cast<std::uint32_t>(known_.size()));
        if (is_new) triangles_.vertices.push_back({at[0], at[1], at[2]});
        return entry->second;
    }
    Triangles triangles_;
    std::map<std::array<double, 3>, std::uint32_t> known_;
};

/// Smallest width of a face [m]. Rounding moves points along lines between nearly parallel faces by far more than a
/// double's last bit, and makes narrower faces cross their neighbours.
template <class Mesh>
constexpr double narrowest = std::is_same_v<Mesh, ExactMesh> ? 1e-12 : 1e-9;

template <class Mesh>
Triangles written(const Mesh& mesh) {
    const Tags<Mesh> tags = mesh.template property_map<Face<Mesh>, std::uint8_t>(tags_of_faces).first;
    Writer writer;
    for (const Face<Mesh> f : mesh.faces()) writer.add(mesh, f, false, tags[f]);
    return writer.take(narrowest<Mesh>);
}

template <class Mesh>
Mesh hull_of(const ConvexPart& part) {
    std::vector<typename Mesh::Point> corners;
    for (const Vec3 p : part) corners.emplace_back(p.x, p.y, p.z);
    Mesh hull;
    CGAL::convex_hull_3(corners.begin(), corners.end(), hull);
    return hull;
}

template <class Mesh>
bool has_volume(const Mesh& hull) {
    return hull.number_of_faces() >= 4 && CGAL::is_closed(hull);
}
constexpr const char* no_volume = "a part of the tool's sweep has no volume";

/// Joins parts in pairs: neighbours in time overlap. Parts that cannot be joined stay apart.
std::vector<ExactMesh> joined(std::vector<ExactMesh> parts, const Cancelled& cancelled) {
    for (bool has_joined = true; has_joined && parts.size() > 1;) {
        has_joined = false;
        std::vector<ExactMesh> fewer;
        for (std::size_t i = 0; i < parts.size(); i += 2) {
            if (cancelled()) return parts;
            if (i + 1 == parts.size()) {
                fewer.push_back(std::move(parts[i]));
                continue;
            }
            // A copy, because corefinement changes its input even if it fails.
            ExactMesh one = parts[i], other = parts[i + 1], both;
            if (pmp::corefine_and_compute_union(one, other, both)) {
                fewer.push_back(std::move(both));
                has_joined = true;
            } else {
                fewer.push_back(std::move(parts[i]));
                fewer.push_back(std::move(parts[i + 1]));
            }
        }
        parts = std::move(fewer);
    }
    return parts;
}

/// Subtracts closed tools from a closed mesh, one after the other.
template <class Mesh>
Outcome subtract(Triangles& triangles, std::vector<Mesh> tools, const Cancelled& cancelled, std::string& why) {
    Mesh bone;
    if (!read(triangles, bone, true, why)) return Outcome::refused;
    bool has_changed = false;
    for (Mesh& tool : tools) {
        if (cancelled()) return Outcome::cancelled;
        Mesh left;
        TagVisitor<Mesh> visitor;
        visitor.bone = &bone;
        visitor.bone_tags = bone.template property_map<Face<Mesh>, std::uint8_t>(tags_of_faces).first;
        visitor.result_tags =
            left.template add_property_map<Face<Mesh>, std::uint8_t>(tags_of_faces, KERF_FACE_SURFACE).first;
        const std::size_t faces = bone.number_of_faces();
        if (!pmp::corefine_and_compute_difference(bone, tool, left, CGAL::parameters::visitor(visitor))) {
            why = "the cut surface would touch itself along an edge";
            return Outcome::refused;
        }
        has_changed = has_changed || left.number_of_faces() != faces;
        bone = std::move(left);
    }
    if (!has_changed) return Outcome::unchanged;
    triangles = written(bone);
    return Outcome::cut;
}

template <class Mesh>
bool make_hulls(const std::vector<ConvexPart>& parts, std::vector<Mesh>& hulls, std::string& why) {
    for (const ConvexPart& part : parts) {
        hulls.push_back(hull_of<Mesh>(part));
        if (has_volume(hulls.back())) continue;
        why = no_volume;
        return false;
    }
    return true;
}

// ---- a patch with a border ------------------------------------------------------------------------------------------

template <class Mesh>
using Halfedge = typename Mesh::Halfedge_index;
template <class Mesh>
using CutEdges = typename Mesh::template Property_map<typename Mesh::Edge_index, bool>;

/// Returns the vertex of a halfedge's face that is not on the halfedge.
template <class Mesh>
const typename Mesh::Point& apex(const Mesh& mesh, Halfedge<Mesh> h) {
    return mesh.point(mesh.target(mesh.next(h)));
}

/// Returns on which side of a surface a point near one of its edges lies: 1 in the solid, −1 outside, 0 if it is in the
/// plane of one of the edge's two faces or the edge is on the border.
template <class Mesh>
int side_at_edge(const Mesh& mesh, Halfedge<Mesh> h, const typename Mesh::Point& point) {
    const Halfedge<Mesh> other = mesh.opposite(h);
    if (mesh.is_border(h) || mesh.is_border(other)) return 0;
    const typename Mesh::Point &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h));
    const typename Mesh::Point &one = apex(mesh, h), &two = apex(mesh, other);
    const int under_one = -CGAL::orientation(p, q, one, point), under_two = -CGAL::orientation(q, p, two, point);
    const int bend = -CGAL::orientation(p, q, one, two);  // 1: the solid is convex at the edge
    if (under_one == 0 || under_two == 0) {
        // The point is in the plane of one face. If it is beyond the edge, the other face decides.
        if (bend > 0 && (under_one < 0 || under_two < 0)) return -1;
        if (bend < 0 && (under_one > 0 || under_two > 0)) return 1;
        return 0;
    }
    if (bend > 0) return under_one > 0 && under_two > 0 ? 1 : -1;
    if (bend < 0) return under_one > 0 || under_two > 0 ? 1 : -1;
    return under_one;
}

template <class Mesh>
using EdgeKey = std::pair<typename Mesh::Point, typename Mesh::Point>;

/// Returns the halfedges on the lines of intersection, keyed by their ends.
template <class Mesh>
std::map<EdgeKey<Mesh>, Halfedge<Mesh>> halfedges_of(const Mesh& mesh, const CutEdges<Mesh>& cut) {
    std::map<EdgeKey<Mesh>, Halfedge<Mesh>> found;
    for (const auto e : mesh.edges()) {
        if (!cut[e]) continue;
        for (const Halfedge<Mesh> h : {mesh.halfedge(e), mesh.opposite(mesh.halfedge(e))})
            found.emplace(EdgeKey<Mesh>{mesh.point(mesh.source(h)), mesh.point(mesh.target(h))}, h);
    }
    return found;
}

/// The stretches of a surface between lines of intersection, with a vote on whether each lies in the solid that the
/// other surface bounds. Long edges count more, because rounding shifts the ends of short edges by as much.
struct Stretches {
    std::vector<std::size_t> of_face;
    std::vector<double> votes;  ///< > 0 inside; 0: no edge on a line of intersection
};

template <class Mesh>
Stretches votes_of(const Mesh& mesh, const CutEdges<Mesh>& cut, const Mesh& other,
                   const std::map<EdgeKey<Mesh>, Halfedge<Mesh>>& of_other) {
    Stretches found;
    found.of_face.assign(mesh.number_of_faces() + mesh.number_of_removed_faces(), ~std::size_t{0});
    std::vector<Face<Mesh>> open;
    for (const auto first : mesh.faces()) {
        if (found.of_face[first] != ~std::size_t{0}) continue;
        const std::size_t number = found.votes.size();
        double votes = 0.0;
        found.of_face[first] = number;
        open.push_back(first);
        while (!open.empty()) {
            const auto face = open.back();
            open.pop_back();
            for (const Halfedge<Mesh> h : halfedges_around_face(mesh.halfedge(face), mesh)) {
                if (cut[mesh.edge(h)]) {
                    const typename Mesh::Point &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h));
                    if (const auto there = of_other.find({p, q}); there != of_other.end())
                        votes += std::sqrt(CGAL::to_double(CGAL::squared_distance(p, q))) *
                                 side_at_edge(other, there->second, apex(mesh, h));
                    continue;
                }
                const auto next = mesh.face(mesh.opposite(h));
                if (next == Mesh::null_face() || found.of_face[next] != ~std::size_t{0}) continue;
                found.of_face[next] = number;
                open.push_back(next);
            }
        }
        found.votes.push_back(votes);
    }
    return found;
}

/// Returns whether a point lies in a convex hull.
template <class Mesh>
bool is_in_hull(const Mesh& hull, const typename Mesh::Point& point) {
    for (const auto face : hull.faces()) {
        const Halfedge<Mesh> h = hull.halfedge(face);
        if (CGAL::orientation(hull.point(hull.source(h)), hull.point(hull.target(h)), apex(hull, h), point) ==
            CGAL::POSITIVE)
            return false;
    }
    return true;
}

/// Subtracts one convex part.
template <class Mesh>
Outcome cut_once(Triangles& triangles, const ConvexPart& part, std::string& why) {
    Mesh patch, tool = hull_of<Mesh>(part);
    if (!has_volume(tool)) {
        why = no_volume;
        return Outcome::refused;
    }
    if (!read(triangles, patch, false, why)) return Outcome::refused;
    const Mesh hull = tool;
    CutEdges<Mesh> cut_patch_edges =
        patch.template add_property_map<typename Mesh::Edge_index, bool>("e:cut", false).first;
    CutEdges<Mesh> cut_tool_edges =
        tool.template add_property_map<typename Mesh::Edge_index, bool>("e:cut", false).first;
    TagVisitor<Mesh> visitor;
    visitor.bone = &patch;
    visitor.bone_tags = patch.template property_map<Face<Mesh>, std::uint8_t>(tags_of_faces).first;
    pmp::corefine(patch, tool, CGAL::parameters::edge_is_constrained_map(cut_patch_edges).visitor(visitor),
                  CGAL::parameters::edge_is_constrained_map(cut_tool_edges));
    const auto of_patch = halfedges_of(patch, cut_patch_edges), of_tool = halfedges_of(tool, cut_tool_edges);

    const Stretches surface = votes_of(patch, cut_patch_edges, tool, of_tool);
    const Stretches walls = votes_of(tool, cut_tool_edges, patch, of_patch);
    std::vector<double> in_tool = surface.votes;
    bool has_changed = !of_patch.empty();
    for (const auto face : patch.faces()) {
        double& votes = in_tool[surface.of_face[face]];
        if (votes != 0.0) continue;
        const typename Mesh::Point& p = patch.point(patch.target(patch.halfedge(face)));
        votes = is_in_hull(hull, p) ? 1.0 : -1.0;
        has_changed = has_changed || votes > 0.0;
    }
    if (!has_changed) return Outcome::unchanged;
    Writer writer;
    for (const auto face : patch.faces())
        if (in_tool[surface.of_face[face]] < 0.0) writer.add(patch, face, false, visitor.bone_tags[face]);
    for (const auto face : tool.faces())
        if (walls.votes[walls.of_face[face]] > 0.0) writer.add(tool, face, true, KERF_FACE_WALL);
    triangles = writer.take(narrowest<Mesh>);
    return Outcome::cut;
}

/// Runs `work` and turns exceptions of CGAL into `refused`.
template <class Work>
Outcome guarded(std::string& why, const Work& work) {
    const Rounding rounding;
    CGAL::set_error_handler([](const char*, const char*, const char*, int, const char*) {});
    CGAL::set_error_behaviour(CGAL::THROW_EXCEPTION);
    try {
        return work();
    } catch (const std::exception& e) {
        why = e.what();
        for (char& c : why)
            if (c == '\n') c = ' ';
        return Outcome::refused;
    }
}

}  // namespace

Outcome cut_whole(Triangles& mesh, const std::vector<ConvexPart>& parts, const Cancelled& cancelled, std::string& why) {
    return guarded(why, [&] {
        std::vector<ExactMesh> hulls;
        if (!make_hulls(parts, hulls, why)) return Outcome::refused;
        return subtract(mesh, joined(std::move(hulls), cancelled), cancelled, why);
    });
}

Outcome cut_whole_rounded(Triangles& mesh, const std::vector<ConvexPart>& parts, const Cancelled& cancelled,
                          std::string& why) {
    return guarded(why, [&] {
        std::vector<RoundedMesh> hulls;
        if (!make_hulls(parts, hulls, why)) return Outcome::refused;
        return subtract(mesh, std::move(hulls), cancelled, why);
    });
}

Outcome cut_patch(Triangles& patch, const std::vector<ConvexPart>& parts, bool is_exact, const Cancelled& cancelled,
                  std::string& why) {
    return guarded(why, [&] {
        Outcome all = Outcome::unchanged;
        for (const ConvexPart& part : parts) {
            if (cancelled()) return Outcome::cancelled;
            const Outcome one =
                is_exact ? cut_once<ExactMesh>(patch, part, why) : cut_once<RoundedMesh>(patch, part, why);
            if (one == Outcome::refused) return one;
            if (one == Outcome::cut) all = one;
        }
        return all;
    });
}

}  // namespace kerf::remesh_cgal
