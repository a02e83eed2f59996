// SPDX-License-Identifier: Apache-2.0
#include "bone/exact/mesh_parts.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

#include "tests/support/block.h"

namespace kerf::bone {
namespace {

using namespace literals;

/// Returns the surface of a box with `rows` by `rows` squares on its face +z, and one on each other face.
MeshPart box(Vec3 low, Vec3 high, std::uint32_t rows) {
    MeshPart part;
    SurfaceMesh& mesh = part.mesh.mesh;
    const auto add = [&](Vec3 a, Vec3 along, Vec3 up) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (const Vec3& v : {a, a + along, a + along + up, a + up}) mesh.vertices.push_back(v);
        mesh.triangles.push_back({first, first + 1, first + 2});
        mesh.triangles.push_back({first, first + 2, first + 3});
    };
    const Vec3 size = high - low, x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
    add(low, y, x);
    add(low, x, z);
    add(low, z, y);
    add(low + y, z, x);
    add(low + x, y, z);
    const double n = rows;
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::uint32_t j = 0; j < rows; ++j) add(low + z + (i / n) * x + (j / n) * y, (1 / n) * x, (1 / n) * y);
    part.mesh.tags.assign(mesh.triangles.size(), 0);
    return part;
}

/// Returns the fraction of a box's surface that lies on a block of bone.
double on_block(const MeshPart& part, const Body& body) {
    const CutField uncut{body, 64};
    return fraction_on(part, body, {&uncut}).value_or(-1.0);
}

TEST(FractionOn, IsWholeForTheSurfaceOfTheBoneItselfOnLayersOfSamplesAndBetween) {
    for (const double spacing : {0.5_mm, 0.4_mm, 0.37_mm})
        for (const Vec3 offset : {Vec3{0, 0, 0}, Vec3{0.3, 0.1, 0.7}})
            for (const double shift : {0.0, 1e-12, -1e-12}) {
                const Vec3 by{shift, shift, shift}, low{-5.0_mm, -5.0_mm, -5.0_mm}, high{5.0_mm, 5.0_mm, 5.0_mm};
                EXPECT_EQ(on_block(box(low + by, high + by, 9), test::block(low, high, spacing, offset)), 1.0)
                    << spacing << " " << offset.x << " " << shift;
            }
}

TEST(FractionOn, CountsAreaAndNotVertices) {
    const Body body = test::block({-5.0_mm, -5.0_mm, -5.0_mm}, {5.0_mm, 5.0_mm, 5.0_mm}, 0.5_mm, {0.3, 0.1, 0.7});
    // The face +z, 100 mm² of 720, lies 3 mm above the bone; of the four faces next to it one half of each counts.
    const double coarse = on_block(box({-5.0_mm, -5.0_mm, -5.0_mm}, {5.0_mm, 5.0_mm, 8.0_mm}, 1), body);
    const double fine = on_block(box({-5.0_mm, -5.0_mm, -5.0_mm}, {5.0_mm, 5.0_mm, 8.0_mm}, 20), body);
    EXPECT_NEAR(fine, coarse, 1e-12);
    EXPECT_NEAR(coarse, (100.0 + 4.0 * 65.0) / 720.0, 1e-12);
}

}  // namespace
}  // namespace kerf::bone
