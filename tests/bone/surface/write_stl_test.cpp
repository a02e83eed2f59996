// SPDX-License-Identifier: Apache-2.0
#include "bone/surface/write_stl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

namespace kerf::bone {
namespace {

/// One triangle with legs of 1 mm in the plane z = 0, seen from above.
Mesh one_triangle() {
    Mesh mesh;
    mesh.vertices = {{0, 0, 0}, {1e-3, 0, 0}, {0, 1e-3, 0}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

float float_at(const std::vector<unsigned char>& bytes, std::size_t offset) {
    float value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

TEST(Stl, HasEightyBytesOfHeaderFourOfCountAndFiftyForEachTriangle) {
    const auto bytes = stl_bytes(one_triangle());
    EXPECT_EQ(bytes.size(), 134u);
    EXPECT_EQ(bytes[80], 1u);
}

TEST(Stl, SaysInItsHeaderThatItIsNotForDiagnosis) {
    const auto bytes = stl_bytes(one_triangle());
    const std::string header(bytes.begin(), bytes.begin() + 80);
    EXPECT_NE(header.find("not for diagnosis"), std::string::npos);
    EXPECT_NE(header.substr(0, 5), "solid");
}

TEST(Stl, IsInMillimetresWithTheNormalOutwards) {
    const auto bytes = stl_bytes(one_triangle());
    EXPECT_EQ(float_at(bytes, 84 + 8), 1.0f) << "normal z";
    EXPECT_EQ(float_at(bytes, 84 + 24), 1.0f) << "x of the second corner";
}

TEST(Stl, LeavesOutTrianglesThatNameNoVertex) {
    Mesh mesh = one_triangle();
    mesh.triangles.push_back({0, 1, 7});
    mesh.triangles.push_back({1, 1, 2});
    EXPECT_EQ(stl_bytes(mesh), stl_bytes(one_triangle()));
}

TEST(Stl, LossIsTheDistanceToWhatIsWritten) {
    Mesh mesh;
    mesh.vertices = {{10000.0001, 0, 0}, {10000.0203, 0, -5000.00013}, {10000.0001, 0.0201, 0}};
    mesh.triangles = {{0, 1, 2}};
    const auto bytes = stl_bytes(mesh);
    double largest = 0.0;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const auto at = [&](std::size_t axis) { return 1e-3 * float_at(bytes, 84 + 12 + 12 * corner + 4 * axis); };
        largest = std::max(largest, length(Vec3{at(0), at(1), at(2)} - mesh.vertices[corner]));
    }
    EXPECT_NEAR(stl_loss(mesh).displacement, largest, 1e-11);  // rounding of a double at 10 km
    EXPECT_GT(largest, 1e-4);
    EXPECT_EQ(stl_loss(mesh).flattened, 0u);
}

TEST(Stl, CountsFacesThatLoseTheirArea) {
    Mesh mesh = one_triangle();
    for (Vec3& vertex : mesh.vertices) vertex.x += 1e5;
    EXPECT_EQ(stl_loss(mesh).flattened, 1u);
    EXPECT_EQ(stl_loss(one_triangle()).flattened, 0u);
    EXPECT_EQ(stl_loss(one_triangle()).displacement, 0.0);
}

}  // namespace
}  // namespace kerf::bone
