// SPDX-License-Identifier: Apache-2.0
#include "bone/surface/diagnose.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>

#include "bone/report/import_report.h"
#include "bone/surface/crossings.h"
#include "bone/surface/orient3d.h"

namespace kerf::bone {
namespace {

constexpr double smallest_bone = 5e-3, largest_bone = 0.7;  // [m] along the longest side of its box

void count(Flaw& flaw, Vec3 at) {
    if (flaw.count++ == 0) flaw.at = at;
}

/// Returns the vertices in the order of their positions; equal positions by number.
std::vector<std::uint32_t> vertices_by_position(const SurfaceMesh& mesh) {
    std::vector<std::uint32_t> order(mesh.vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const Vec3 p = mesh.vertices[a], q = mesh.vertices[b];
        if (p.x != q.x) return p.x < q.x;
        if (p.y != q.y) return p.y < q.y;
        if (p.z != q.z) return p.z < q.z;
        return a < b;
    });
    return order;
}

void count_duplicates(const SurfaceMesh& mesh, SurfaceDiagnosis& found) {
    const std::vector<std::uint32_t> order = vertices_by_position(mesh);
    for (std::size_t i = 1; i < order.size(); ++i)
        if (mesh.vertices[order[i]] == mesh.vertices[order[i - 1]])
            count(found.duplicate_vertices, mesh.vertices[order[i]]);

    std::vector<Triangle> sorted = mesh.triangles;
    for (Triangle& t : sorted) std::sort(t.begin(), t.end());
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (sorted[i] == sorted[i - 1]) count(found.duplicate_faces, mesh.vertices[sorted[i][0]]);
}

/// Returns the pieces in the order of their numbers.
std::vector<SurfacePiece> pieces_in(const SurfaceMesh& mesh, const Pieces& pieces) {
    std::vector<SurfaceMesh> parts(pieces.count);
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        SurfaceMesh& part = parts[pieces.of_face[f]];
        const auto first = static_cast<std::uint32_t>(part.vertices.size());
        for (const Vec3 corner : mesh.corners(mesh.triangles[f])) part.vertices.push_back(corner);
        part.triangles.push_back({first, first + 1, first + 2});
    }
    std::vector<SurfacePiece> found;
    for (const SurfaceMesh& part : parts)
        found.push_back({part.triangles.size(), signed_volume_of(part), bounds_of(part)});
    return found;
}

/// Returns the position of each piece when the largest comes first.
std::vector<std::size_t> ranks_by_size(const std::vector<SurfacePiece>& pieces) {
    std::vector<std::size_t> order(pieces.size()), rank(pieces.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::abs(pieces[a].volume) > std::abs(pieces[b].volume);
    });
    for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = i;
    return rank;
}

/// Whether two faces lie in one plane and have opposite normals.
bool are_back_to_back(const SurfaceMesh& mesh, const Crossing& pair) noexcept {
    const auto [a, b, c] = mesh.corners(mesh.triangles[pair[0]]);
    const auto [d, e, f] = mesh.corners(mesh.triangles[pair[1]]);
    return orient3d(a, b, c, d) == 0 && orient3d(a, b, c, e) == 0 && orient3d(a, b, c, f) == 0 &&
           dot(cross(b - a, c - a), cross(e - d, f - d)) < 0.0;
}

/// Returns pairs of faces with corners at the same positions and opposite normals.
std::vector<Crossing> twins_in(const SurfaceMesh& mesh) {
    const std::vector<std::uint32_t> order = vertices_by_position(mesh);
    std::vector<std::uint32_t> first_at(order.size());  // the first vertex at the position of each
    for (std::size_t i = 0; i < order.size(); ++i)
        first_at[order[i]] =
            i > 0 && mesh.vertices[order[i]] == mesh.vertices[order[i - 1]] ? first_at[order[i - 1]] : order[i];
    std::vector<std::pair<Triangle, std::uint32_t>> faces;
    for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
        Triangle corners = mesh.triangles[f];
        for (std::uint32_t& corner : corners) corner = first_at[corner];
        std::sort(corners.begin(), corners.end());
        faces.emplace_back(corners, f);
    }
    std::sort(faces.begin(), faces.end());
    std::vector<Crossing> found;
    for (std::size_t i = 1; i < faces.size(); ++i)
        if (const Crossing pair{faces[i - 1].second, faces[i].second};
            faces[i - 1].first == faces[i].first && are_back_to_back(mesh, pair))
            found.push_back(pair);
    return found;
}

double longest_side(const Box& box) noexcept {
    const Vec3 extent = box.high - box.low;
    return std::max({extent.x, extent.y, extent.z});
}

std::string likely_unit(double size, double unit) {
    const auto is_bone = [](double metres) { return metres >= smallest_bone && metres <= largest_bone; };
    if (is_bone(size)) return "";
    const double number = size / unit;
    for (const auto& [name, metres] : {std::pair{"mm", 1e-3}, {"m", 1.0}, {"um", 1e-6}, {"cm", 1e-2}})
        if (is_bone(number * metres)) return name;
    return "";
}

std::string counted(std::size_t n, const char* one, const char* many) {
    return std::to_string(n) + " " + (n == 1 ? one : many);
}

}  // namespace

Opening opening_of(const SurfaceMesh& mesh, const BorderLoop& loop) {
    const std::vector<std::uint32_t>& border = loop.vertices;
    Opening opening;
    Box box{mesh.vertices[border[0]], mesh.vertices[border[0]]};
    for (std::size_t i = 0; i < border.size(); ++i) {
        const Vec3 p = mesh.vertices[border[i]];
        if (loop.is_closed || i + 1 < border.size())
            opening.length += length(mesh.vertices[border[(i + 1) % border.size()]] - p);
        box = joined(box, p);
    }
    opening.at = 0.5 * (box.low + box.high);
    opening.width = length(box.high - box.low);
    return opening;
}

SurfaceDiagnosis diagnose(const SurfaceMesh& mesh, double unit) {
    SurfaceDiagnosis found;
    found.vertices = mesh.vertices.size();
    found.faces = mesh.triangles.size();
    found.bounds = bounds_of(mesh);
    found.area = area_of(mesh);
    found.volume = signed_volume_of(mesh);
    if (mesh.triangles.empty()) return found;

    count_duplicates(mesh, found);
    for (const Triangle& t : mesh.triangles) {
        const auto [a, b, c] = mesh.corners(t);
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
            count(found.collapsed_faces, a);
        else if (is_flat(a, b, c))
            count(found.flat_faces, a);
    }
    const std::vector<HalfEdge> edges = half_edges_of(mesh);
    for_each_edge(edges, [&](const HalfEdge* first, const HalfEdge* last) {
        const Vec3 at = 0.5 * (mesh.vertices[first->low] + mesh.vertices[first->high]);
        if (last - first == 1)
            count(found.open_edges, at);
        else if (last - first > 2)
            count(found.nonmanifold_edges, at);
        else if (balance_of(first, last) != 0)
            count(found.inconsistent_edges, at);
    });
    for (const BorderLoop& loop : border_loops_of(edges)) found.openings.push_back(opening_of(mesh, loop));
    std::stable_sort(found.openings.begin(), found.openings.end(),
                     [](const Opening& a, const Opening& b) { return a.width > b.width; });
    for (const std::uint32_t v : pinched_vertices_of(mesh, edges)) count(found.pinched_vertices, mesh.vertices[v]);
    const Pieces pieces = pieces_of(mesh, edges);
    const std::vector<SurfacePiece> by_number = pieces_in(mesh, pieces);
    const std::vector<std::size_t> rank = ranks_by_size(by_number);
    found.pieces.resize(by_number.size());
    for (std::size_t i = 0; i < by_number.size(); ++i) found.pieces[rank[i]] = by_number[i];
    found.is_inside_out = found.is_closed() && found.inconsistent_edges.count == 0 && found.volume < 0.0;

    for (const Crossing& pair : crossings_of(mesh, TriangleTree(mesh))) {
        const Vec3 at = mesh.vertices[mesh.triangles[pair[0]][0]];
        found.crossing.push_back({at, {rank[pieces.of_face[pair[0]]], rank[pieces.of_face[pair[1]]]}});
        count(found.crossings, at);
        if (are_back_to_back(mesh, pair)) found.touching.push_back(found.crossing.back());
    }
    for (const Crossing& pair : twins_in(mesh))
        found.touching.push_back({mesh.vertices[mesh.triangles[pair[0]][0]],
                                  {rank[pieces.of_face[pair[0]]], rank[pieces.of_face[pair[1]]]}});

    const auto farthest = [](Vec3 p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); };
    const double far = std::max(farthest(found.bounds.low), farthest(found.bounds.high)) / unit;
    const auto as_float = static_cast<float>(far);
    found.float_step = unit * static_cast<double>(std::nextafter(as_float, HUGE_VALF) - as_float);
    found.likely_unit = likely_unit(longest_side(found.bounds), unit);
    return found;
}

std::string position_text(Vec3 at) {
    return "(" + rounded(at.x * 1e3, 1) + ", " + rounded(at.y * 1e3, 1) + ", " + rounded(at.z * 1e3, 1) + ") mm";
}

std::vector<std::string> to_notes(const SurfaceDiagnosis& d) {
    std::vector<std::string> notes;
    const Vec3 extent = d.bounds.high - d.bounds.low;
    notes.push_back("Surface: " + std::to_string(d.faces) + " faces, " + rounded(extent.x * 1e3, 1) + " × " +
                    rounded(extent.y * 1e3, 1) + " × " + rounded(extent.z * 1e3, 1) + " mm, area " +
                    rounded(d.area * 1e4, 1) + " cm2, volume " + rounded(std::abs(d.volume) * 1e6, 1) + " cm3" +
                    (d.is_closed() ? "." : " as far as an open surface has one."));
    const auto say = [&](const Flaw& flaw, const char* one, const char* many) {
        if (flaw.count > 0)
            notes.push_back("Found " + counted(flaw.count, one, many) + ", the first at " + position_text(flaw.at) +
                            ".");
    };
    say(d.duplicate_vertices, "vertex at the place of another", "vertices at the place of another");
    say(d.collapsed_faces, "face with the same corner twice", "faces with the same corner twice");
    say(d.duplicate_faces, "face that is there twice", "faces that are there twice");
    say(d.flat_faces, "face without area", "faces without area");
    say(d.nonmanifold_edges, "edge of more than two faces", "edges of more than two faces");
    say(d.pinched_vertices, "vertex where the surface touches itself", "vertices where the surface touches itself");
    say(d.inconsistent_edges, "edge between faces that look to different sides",
        "edges between faces that look to different sides");
    say(d.crossings, "pair of faces that cut through one another", "pairs of faces that cut through one another");
    if (d.open_edges.count > 0) {
        std::string note = "Found " + counted(d.open_edges.count, "edge", "edges") + " with a face on one side only";
        if (!d.openings.empty())
            note += ", in " + counted(d.openings.size(), "loop", "loops") + "; the widest is " +
                    rounded(d.openings[0].width * 1e3, 1) + " mm across, " + rounded(d.openings[0].length * 1e3, 1) +
                    " mm around, at " + position_text(d.openings[0].at);
        notes.push_back(note + ".");
    }
    if (d.is_inside_out) notes.push_back("Found the surface inside out: its faces look inwards.");
    if (d.pieces.size() > 1) {
        std::string note = "Found " + std::to_string(d.pieces.size()) + " pieces, of";
        constexpr std::size_t max_named = 5;
        for (std::size_t i = 0; i < d.pieces.size() && i < max_named; ++i)
            note += (i == 0 ? " " : ", ") + rounded(d.pieces[i].volume * 1e9, 1);
        notes.push_back(note + (d.pieces.size() > max_named ? " … mm3." : " mm3."));
    }
    return notes;
}

}  // namespace kerf::bone
