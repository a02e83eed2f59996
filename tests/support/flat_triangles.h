// SPDX-License-Identifier: Apache-2.0
// A surface as remeshing modules hold it, and back.
#pragma once

#include <cstddef>

#include "bone/surface/surface_mesh.h"
#include "kerf/remesh_mesh.hpp"

namespace kerf::test {

inline remeshing::Triangles triangles_of(const bone::SurfaceMesh& mesh) {
    remeshing::Triangles all;
    all.vertices = mesh.vertices;
    for (const bone::Triangle& t : mesh.triangles) {
        all.triangles.insert(all.triangles.end(), t.begin(), t.end());
        all.tags.push_back(0);
    }
    return all;
}
inline bone::SurfaceMesh mesh_of(const remeshing::Triangles& all) {
    bone::SurfaceMesh mesh;
    mesh.vertices = all.vertices;
    for (std::size_t f = 0; f < all.tags.size(); ++f)
        mesh.triangles.push_back({all.triangles[3 * f], all.triangles[3 * f + 1], all.triangles[3 * f + 2]});
    return mesh;
}

}  // namespace kerf::test
