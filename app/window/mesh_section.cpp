// SPDX-License-Identifier: Apache-2.0
#include "app/window/mesh_section.h"

#include <cstddef>

namespace kerf::window {

std::vector<SectionLine> section_of(const run::ViewedMesh& mesh, const Pose& plane_from_mesh) {
    std::vector<Vec3> points;
    points.reserve(mesh.positions.size());
    for (const auto& p : mesh.positions)
        points.push_back(plane_from_mesh *
                         Vec3{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
    std::vector<SectionLine> lines;
    for (const auto& triangle : mesh.triangles) {
        SectionLine line{};
        std::size_t ends = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 &a = points[triangle[i]], &b = points[triangle[(i + 1) % 3]];
            if ((a.z < 0.0) == (b.z < 0.0)) continue;
            const double fraction = a.z / (a.z - b.z);
            line[ends++] = {a.x + fraction * (b.x - a.x), a.y + fraction * (b.y - a.y)};
        }
        if (ends == 2) lines.push_back(line);
    }
    return lines;
}

}  // namespace kerf::window
