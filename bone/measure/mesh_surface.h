// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bone/measure/surface.h"
#include "bone/surface/surface_mesh.h"
#include "bone/surface/triangle_tree.h"

namespace kerf::bone {

/// A closed surface of triangles. Triangles are exact, so the only uncertainty is the caller's.
class MeshSurface final : public MeasuredSurface {
public:
    /// Pre: the mesh outlives it; metres, LPS, faces anticlockwise seen from outside.   [worker]
    /// @param uncertainty  [m] standard uncertainty of the surface along its normal, such as that of its scan
    explicit MeshSurface(const SurfaceMesh& mesh, double uncertainty = 0.0)
        : mesh_(&mesh), tree_(mesh), uncertainty_(uncertainty) {}

    /// Samples each triangle in steps of half a millimetre, its edges and corners included.
    [[nodiscard]] std::vector<Vec3> points_in(const Path& region) const override;
    [[nodiscard]] std::vector<Stretch> stretches_on(const Line& line, double low, double high) const override;
    [[nodiscard]] std::optional<double> distance_to(Vec3 p) const override;
    [[nodiscard]] double wall_uncertainty() const noexcept override { return uncertainty_; }
    [[nodiscard]] double contact_uncertainty() const noexcept override { return uncertainty_; }

private:
    const SurfaceMesh* mesh_;
    TriangleTree tree_;
    double uncertainty_;
};

}  // namespace kerf::bone
