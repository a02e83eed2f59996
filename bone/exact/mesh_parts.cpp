// SPDX-License-Identifier: Apache-2.0
#include "bone/exact/mesh_parts.h"

#include <algorithm>
#include <cmath>

#include "bone/surface/edges.h"
#include "kerf/remesh.h"

namespace kerf::bone {
namespace {

/// Samples of a grid within one spacing of a coordinate: two, or three if it lies on a layer of samples.
struct Layers {
    int first, last;
    explicit Layers(double at) noexcept
        : first(static_cast<int>(std::ceil(at - 1.0 - on_layer))),
          last(static_cast<int>(std::floor(at + 1.0 + on_layer))) {}
    static constexpr double on_layer = 1e-6;  ///< [–] of the spacing
};

/// Returns whether a sample within one spacing of a point on each axis has bone of a body.
bool touches(const Body& bone, const CutField& cut, Vec3 point) {
    const Grid& grid = bone.grid();
    const Vec3 at = (1.0 / grid.spacing) * (point - grid.origin);
    const Layers x(at.x), y(at.y), z(at.z);
    for (int k = z.first; k <= z.last; ++k)
        for (int j = y.first; j <= y.last; ++j)
            for (int i = x.first; i <= x.last; ++i) {
                const LocatedPoint place = locate(grid, grid.sample_position(i, j, k) + Vec3{1e-9, 1e-9, 1e-9});
                if (place.is_inside && std::max(uncut_distance(bone, place), cut.at(place)) < 0.0) return true;
            }
    return false;
}

}  // namespace

std::vector<MeshPart> parts_of(const TaggedMesh& whole) {
    const Pieces pieces = pieces_of(whole.mesh, half_edges_of(whole.mesh));
    std::vector<MeshPart> parts(pieces.count);
    std::vector<std::uint32_t> numbers(whole.mesh.vertices.size(), 0);
    // A vertex belongs to one part. Parts with a common vertex would be pinched, and no accepted mesh is.
    std::vector<bool> is_taken(whole.mesh.vertices.size(), false);
    for (std::size_t f = 0; f < whole.mesh.triangles.size(); ++f) {
        TaggedMesh& part = parts[pieces.of_face[f]].mesh;
        Triangle t = whole.mesh.triangles[f];
        for (std::uint32_t& corner : t) {
            if (!is_taken[corner]) {
                is_taken[corner] = true;
                numbers[corner] = static_cast<std::uint32_t>(part.mesh.vertices.size());
                part.mesh.vertices.push_back(whole.mesh.vertices[corner]);
            }
            corner = numbers[corner];
        }
        part.mesh.triangles.push_back(t);
        part.tags.push_back(whole.tags[f]);
    }
    for (MeshPart& part : parts) part.volume = signed_volume_of(part.mesh.mesh);
    return parts;
}

void append(const TaggedMesh& more, TaggedMesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.mesh.vertices.size());
    mesh.mesh.vertices.insert(mesh.mesh.vertices.end(), more.mesh.vertices.begin(), more.mesh.vertices.end());
    for (const Triangle& t : more.mesh.triangles)
        mesh.mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    mesh.tags.insert(mesh.tags.end(), more.tags.begin(), more.tags.end());
}

std::optional<double> fraction_on(const MeshPart& part, const Body& bone, const std::vector<const CutField*>& bodies) {
    const SurfaceMesh& mesh = part.mesh.mesh;
    std::vector<double> areas(mesh.vertices.size(), 0.0);  // three times a vertex's part of the surface
    for (const Triangle& t : mesh.triangles) {
        const auto [a, b, c] = mesh.corners(t);
        for (const std::uint32_t corner : t) areas[corner] += 0.5 * length(cross(b - a, c - a));
    }
    double on = 0.0, all = 0.0;
    for (std::size_t v = 0; v < areas.size(); ++v) {
        const Vec3 at = mesh.vertices[v];
        if (!locate(bone.grid(), at).is_inside || !bone.region.contains(at)) continue;
        all += areas[v];
        if (std::any_of(bodies.begin(), bodies.end(), [&](const CutField* cut) { return touches(bone, *cut, at); }))
            on += areas[v];
    }
    if (all == 0.0) return std::nullopt;
    return on / all;
}

std::vector<double> wall_areas_of(const TaggedMesh& mesh, const Body& bone) {
    constexpr double max_rows = 64.0;
    std::vector<double> areas(bone.materials.size(), 0.0);
    for (std::size_t f = 0; f < mesh.tags.size(); ++f) {
        if (mesh.tags[f] == KERF_FACE_SURFACE) continue;
        const auto [a, b, c] = mesh.mesh.corners(mesh.mesh.triangles[f]);
        const Vec3 ab = b - a, ac = c - a;
        // A wall's face may cross all tissues. So it is divided into small faces, in rows no wider than a voxel.
        const double longest = std::max({length(ab), length(ac), length(c - b)});
        const int rows = static_cast<int>(std::clamp(std::ceil(longest / bone.grid().spacing), 1.0, max_rows));
        const double area = 0.5 * length(cross(ab, ac)) / (static_cast<double>(rows) * rows);
        const auto add = [&, a = a](double row, double column) {
            double weight[KERF_MAX_TISSUES];
            material_weights(bone, locate(bone, a + (row / rows) * ab + (column / rows) * ac), weight);
            const auto tissue = std::max_element(weight, weight + bone.materials.size()) - weight;
            areas[static_cast<std::size_t>(tissue)] += area;
        };
        for (int i = 0; i < rows; ++i)
            for (int j = 0; j < rows - i; ++j) {
                add(i + 1.0 / 3.0, j + 1.0 / 3.0);
                if (j + 1 < rows - i) add(i + 2.0 / 3.0, j + 2.0 / 3.0);
            }
    }
    return areas;
}

}  // namespace kerf::bone
