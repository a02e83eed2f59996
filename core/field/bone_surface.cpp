// SPDX-License-Identifier: Apache-2.0
#include "core/field/bone_surface.h"

#include <algorithm>

#include "core/field/isosurface.h"

namespace kerf {

namespace {
/// How far beyond the nearest face of the region [m]; negative within.
double beyond_faces(const Region& region, Vec3 p) noexcept {
    return std::max({region.low.x - p.x, p.x - region.high.x, region.low.y - p.y, p.y - region.high.y,
                     region.low.z - p.z, p.z - region.high.z});
}
}  // namespace

Mesh bone_surface(const Body& body, const CutField& cut, int stride) {
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
    if (stride == 1)
        samples.may_cross = [&body, &cut, &g, has_faces](int i, int j, int k) {
            if (has_faces) {
                const Vec3 low = g.sample_position(i * brick_edge, j * brick_edge, k * brick_edge);
                const double half = 0.5 * brick_edge * g.spacing;
                const double at_centre = beyond_faces(body.region, low + Vec3{half, half, half});
                if (at_centre > half + g.spacing) return false;
                if (at_centre > -half - g.spacing) return true;
            }
            // A block of cells also reads the first samples of its upper neighbours: look at all eight.
            bool has_solid = false, has_air = false;
            for (int c = 0; c < 8; ++c) {
                const int bi = i + (c & 1), bj = j + ((c >> 1) & 1), bk = k + (c >> 2);
                if (bi >= g.bricks[0] || bj >= g.bricks[1] || bk >= g.bricks[2]) {
                    has_air = true;
                    continue;
                }
                const std::size_t b = g.brick_index(bi, bj, bk);
                if (body.surface.has_border(b)) return true;
                const bool is_air = body.surface.is_all_air(b);
                if (!is_air && cut.stored(b) != nullptr) return true;
                (is_air ? has_air : has_solid) = true;
            }
            return has_solid && has_air;
        };
    Mesh mesh = isosurface(samples);

    mesh.tissue.resize(mesh.vertices.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        // A step inwards, so that the shell's own border does not decide.
        double weight[KERF_MAX_TISSUES];
        const Vec3 inside = mesh.vertices[v] - 0.5 * g.spacing * mesh.normals[v];
        material_weights(body, locate(g, inside), weight);
        mesh.tissue[v] = static_cast<std::uint8_t>(std::max_element(weight, weight + body.materials.size()) - weight);
    }
    return mesh;
}

}  // namespace kerf
