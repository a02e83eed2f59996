// SPDX-License-Identifier: Apache-2.0
// The first byte says of which format the others are: s, o or p.
#include <algorithm>
#include <cstdint>
#include <string_view>

#include "bone/surface/read_surface.h"
#include "tests/fuzz/fuzz_target.h"

bool kerf::fuzz::reads(std::string_view input) {
    if (input.empty()) return false;
    const std::string_view bytes = input.substr(1);
    bone::SurfaceError error;
    const auto surface = input[0] == 's'   ? bone::read_stl(bytes, error)
                         : input[0] == 'o' ? bone::read_obj(bytes, error)
                                           : bone::read_ply(bytes, error);
    require(surface.has_value() == (error.code == nullptr), "a surface comes, or else an error");
    if (!surface) return false;
    const bone::SurfaceMesh& mesh = surface->mesh;
    require(!mesh.triangles.empty(), "a surface has faces");
    require(std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](Vec3 v) { return is_finite(v); }),
            "coordinates are finite");
    for (const bone::Triangle& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle)
            require(corner < mesh.vertices.size(), "faces name vertices that exist");
    return true;
}
