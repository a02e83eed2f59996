// SPDX-License-Identifier: Apache-2.0
#include "run/view/body_shape.h"

#include <algorithm>
#include <cmath>

#include "core/field/cut/cut_field.h"
#include "core/field/surface/bone_surface.h"
#include "run/view/surface_shape.h"

namespace kerf::run {

ViewedMesh body_shape(const Body& body) {
    const Grid& grid = body.grid();
    if (body.surface.is_empty() || body.materials.empty()) return {};
    const CutField uncut(body, 0);
    const int max_stride = std::max(1, std::min({grid.samples(0), grid.samples(1), grid.samples(2)}) / 4);
    for (int stride = 1;;) {
        const Mesh mesh = bone_surface(body, uncut, stride);
        if (mesh.triangles.size() < max_body_triangles || stride >= max_stride) return viewed(mesh);
        const double ratio = static_cast<double>(mesh.triangles.size()) / static_cast<double>(max_body_triangles);
        stride = std::min(max_stride, std::max(stride + 1, static_cast<int>(std::ceil(stride * std::sqrt(ratio)))));
    }
}

}  // namespace kerf::run
