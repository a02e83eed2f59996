// SPDX-License-Identifier: GPL-3.0-or-later
// The one unit that includes CGAL.
#include "booleans.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/assertions_behaviour.h>
#include <CGAL/convex_hull_3.h>
#include <CGAL/version.h>

#include <array>
#include <cfenv>
#include <cstddef>
#include <exception>
#include <map>
#include <utility>

namespace kerf::remesh_cgal {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Face = Mesh::Face_index;
using Tags = Mesh::Property_map<Face, std::uint8_t>;

constexpr const char* tags_of_faces = "f:tag";

/// Carries tags over: faces of the tool that stay are walls.
struct TagVisitor : pmp::Corefinement::Default_visitor<Mesh> {
    const Mesh* bone = nullptr;
    const Mesh* tool = nullptr;
    Tags bone_tags, result_tags;
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

/// CGAL needs the nearest rounding, and leaves another one behind where it throws.
class Rounding {
public:
    Rounding() : before_(std::fegetround()) { std::fesetround(FE_TONEAREST); }
    ~Rounding() { std::fesetround(before_); }
    Rounding(const Rounding&) = delete;
    Rounding& operator=(const Rounding&) = delete;

private:
    int before_;
};

bool read(const Triangles& triangles, Mesh& mesh, std::string& why) {
    Tags tags = mesh.add_property_map<Face, std::uint8_t>(tags_of_faces, KERF_FACE_SURFACE).first;
    const auto& v = triangles.vertices;
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) mesh.add_vertex(Point(v[i], v[i + 1], v[i + 2]));
    const auto& t = triangles.triangles;
    for (std::size_t f = 0; 3 * f + 2 < t.size(); ++f) {
        const Face face = mesh.add_face(Mesh::Vertex_index(t[3 * f]), Mesh::Vertex_index(t[3 * f + 1]),
                                        Mesh::Vertex_index(t[3 * f + 2]));
        if (face == Mesh::null_face()) {
            why = "face " + std::to_string(f) + " meets an edge that has two faces already";
            return false;
        }
        tags[face] = triangles.tags[f];
    }
    if (!CGAL::is_closed(mesh)) {
        why = "the mesh is open";
        return false;
    }
    return true;
}

Triangles written(const Mesh& mesh) {
    Triangles triangles;
    const Tags tags = mesh.property_map<Face, std::uint8_t>(tags_of_faces).first;
    std::vector<std::uint32_t> numbers(mesh.number_of_vertices() + mesh.number_of_removed_vertices());
    const auto rounded = [](const Kernel::FT& x) {
        // An interval is wider than one rounding until the exact number was asked for.
        if (const auto [low, high] = CGAL::to_interval(x); low == high) return low;
        return CGAL::to_double(x.exact());
    };
    // What rounds to one point is one vertex, and a face that this leaves without a side goes.
    std::map<std::array<double, 3>, std::uint32_t> known;
    for (const Mesh::Vertex_index v : mesh.vertices()) {
        const Point& p = mesh.point(v);
        const std::array<double, 3> at{rounded(p.x()), rounded(p.y()), rounded(p.z())};
        const auto [place, is_new] = known.try_emplace(at, static_cast<std::uint32_t>(triangles.vertices.size() / 3));
        if (is_new) triangles.vertices.insert(triangles.vertices.end(), at.begin(), at.end());
        numbers[v] = place->second;
    }
    for (const Face f : mesh.faces()) {
        std::array<std::uint32_t, 3> corners{};
        std::size_t n = 0;
        for (const Mesh::Vertex_index v : vertices_around_face(mesh.halfedge(f), mesh)) corners[n++] = numbers[v];
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        triangles.triangles.insert(triangles.triangles.end(), corners.begin(), corners.end());
        triangles.tags.push_back(tags[f]);
    }
    return triangles;
}

Mesh hull_of(const ConvexPart& part) {
    std::vector<Point> corners;
    for (const Vec3 p : part) corners.emplace_back(p.x, p.y, p.z);
    Mesh hull;
    CGAL::convex_hull_3(corners.begin(), corners.end(), hull);
    return hull;
}

/// Neighbours in time overlap, so they are joined first. What cannot be joined stays apart.
std::vector<Mesh> joined(std::vector<Mesh> parts, const std::function<bool()>& cancelled) {
    for (bool has_joined = true; has_joined && parts.size() > 1;) {
        has_joined = false;
        std::vector<Mesh> fewer;
        for (std::size_t i = 0; i < parts.size(); i += 2) {
            if (cancelled()) return parts;
            Mesh both;
            if (i + 1 == parts.size()) {
                fewer.push_back(std::move(parts[i]));
                continue;
            }
            // A copy: corefinement changes its input even where it fails.
            Mesh one = parts[i], other = parts[i + 1];
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

Outcome cut(Triangles& triangles, const std::vector<ConvexPart>& parts, const std::function<bool()>& cancelled,
            std::string& why) {
    Mesh bone;
    if (!read(triangles, bone, why)) return Outcome::refused;
    std::vector<Mesh> tools;
    for (const ConvexPart& part : parts) {
        tools.push_back(hull_of(part));
        if (!CGAL::is_closed(tools.back()) || tools.back().number_of_faces() < 4) {
            why = "a part of the tool's sweep has no volume";
            return Outcome::refused;
        }
    }
    bool has_changed = false;
    for (Mesh& tool : joined(std::move(tools), cancelled)) {
        if (cancelled()) return Outcome::cancelled;
        Mesh left;
        TagVisitor visitor;
        visitor.bone = &bone;
        visitor.tool = &tool;
        visitor.bone_tags = bone.property_map<Face, std::uint8_t>(tags_of_faces).first;
        visitor.result_tags = left.add_property_map<Face, std::uint8_t>(tags_of_faces, KERF_FACE_SURFACE).first;
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

void keep_quiet(const char*, const char*, const char*, int, const char*) {}

}  // namespace

Outcome cut_whole(Triangles& mesh, const std::vector<ConvexPart>& parts, const std::function<bool()>& cancelled,
                  std::string& why) {
    const Rounding rounding;
    CGAL::set_error_handler(&keep_quiet);
    CGAL::set_error_behaviour(CGAL::THROW_EXCEPTION);
    try {
        return cut(mesh, parts, cancelled, why);
    } catch (const std::exception& e) {
        why = e.what();
        for (char& c : why)
            if (c == '\n') c = ' ';
        return Outcome::refused;
    }
}

const char* kernel() noexcept { return "CGAL " CGAL_VERSION_STR " EPECK, assertions on, no fused multiply-add"; }

}  // namespace kerf::remesh_cgal
