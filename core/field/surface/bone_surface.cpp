// SPDX-License-Identifier: Apache-2.0
#include "core/field/surface/bone_surface.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/field/surface/brick_mesher.h"
#include "core/field/surface/isosurface.h"
#include "core/field/surface/patch_weld.h"

namespace kerf {

namespace {

Mesh every_sample(const Body& body, const CutField& cut) {
    const auto mesher = std::make_unique<BrickMesher>(body);
    std::vector<std::size_t> bricks;
    for (std::size_t brick = 0; brick < body.grid().brick_count(); ++brick)
        if (mesher->may_cross(cut, brick)) bricks.push_back(brick);
    // For each brick slightly more than the vertices and triangles of a flat wall through its middle.
    PatchWeld weld(body.grid(), 128 * bricks.size(), 256 * bricks.size());
    for (std::size_t n = 0; n < bricks.size(); ++n) {
        if (n + 1 < bricks.size()) mesher->prefetch(cut, bricks[n + 1]);
        weld.add(bricks[n], mesher->mesh(cut, bricks[n]));
    }
    return std::move(weld).mesh();
}

/// Returns the largest distance of a point beyond any face of the region [m]; negative inside.
double beyond_faces(const Region& region, Vec3 p) noexcept {
    return std::max({region.low.x - p.x, p.x - region.high.x, region.low.y - p.y, p.y - region.high.y,
                     region.low.z - p.z, p.z - region.high.z});
}

Mesh some_samples(const Body& body, const CutField& cut, int stride) {
    const Grid& g = body.grid();
    SampleGrid samples;
    samples.size = {g.samples(0) / stride, g.samples(1) / stride, g.samples(2) / stride};
    samples.spacing = g.spacing * stride;
    samples.origin = g.origin;
    const double voxels = g.quantum() / g.spacing;
    const bool has_faces = body.region.is_bounded();
    samples.value = [&body, &cut, &g, stride, voxels, has_faces](int i, int j, int k) {
        const int bone = body.surface.sample(i * stride, j * stride, k * stride);
        const double left = voxels * std::max(bone, int{cut.sample(i * stride, j * stride, k * stride)});
        if (!has_faces) return static_cast<float>(left);
        const Vec3 p = g.sample_position(i * stride, j * stride, k * stride);
        return static_cast<float>(std::max(left, beyond_faces(body.region, p) / g.spacing));
    };
    Mesh mesh = isosurface(samples);

    mesh.tissue.resize(mesh.vertices.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        // Sample half a voxel inwards: on the surface, the border of the outermost material would decide.
        double weight[KERF_MAX_TISSUES];
        const Vec3 inside = mesh.vertices[v] - 0.5 * g.spacing * mesh.normals[v];
        material_weights(body, locate(g, inside), weight);
        mesh.tissue[v] = static_cast<std::uint8_t>(std::max_element(weight, weight + body.materials.size()) - weight);
    }
    return mesh;
}

}  // namespace

Mesh bone_surface(const Body& body, const CutField& cut, int stride) {
    return stride == 1 ? every_sample(body, cut) : some_samples(body, cut, stride);
}

}  // namespace kerf
