// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cstdint>

#include "kerf/remesh_mesh.hpp"

/// OpenMesh with Kerf's vectors: half-edges of a patch.
namespace kerf::burring::displacement {

using remeshing::Triangles;

struct HalfEdgeTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
};
using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits>;
using FaceTags = OpenMesh::FPropHandleT<std::uint8_t>;

[[nodiscard]] inline Vec3 position(const HalfEdges& mesh, HalfEdges::VertexHandle v) {
    const auto& p = mesh.point(v);
    return {p[0], p[1], p[2]};
}
[[nodiscard]] inline OpenMesh::Vec3d point_of(Vec3 v) { return {v.x, v.y, v.z}; }

/// Makes half-edges of a mesh; vertices and faces keep their numbers. Returns false where the mesh is not 2-manifold.
[[nodiscard]] bool load(const Triangles& mesh, HalfEdges& half_edges, FaceTags& tags);

/// Returns the remaining faces in the order of their numbers, and all vertices.
[[nodiscard]] Triangles faces_of(const HalfEdges& half_edges, const FaceTags& tags);

}  // namespace kerf::burring::displacement
