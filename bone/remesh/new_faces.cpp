// SPDX-License-Identifier: Apache-2.0
#include "bone/remesh/new_faces.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>

namespace kerf::bone {
namespace {

bool less(Vec3 a, Vec3 b) noexcept { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

}  // namespace

std::vector<std::uint8_t> new_faces_of(const SurfaceMesh& mesh, const SurfaceMesh& before) {
    using Corners = std::array<Vec3, 3>;
    const auto corners_less = [](const Corners& a, const Corners& b) {
        for (std::size_t i = 0; i < 3; ++i)
            if (a[i] != b[i]) return less(a[i], b[i]);
        return false;
    };
    const auto sorted = [](Corners corners) {
        std::sort(corners.begin(), corners.end(), less);
        return corners;
    };
    std::vector<Corners> known;
    for (const Triangle& t : before.triangles) known.push_back(sorted(before.corners(t)));
    std::sort(known.begin(), known.end(), corners_less);
    std::vector<std::uint8_t> is_new;
    for (const Triangle& t : mesh.triangles)
        is_new.push_back(!std::binary_search(known.begin(), known.end(), sorted(mesh.corners(t)), corners_less));
    return is_new;
}

}  // namespace kerf::bone
