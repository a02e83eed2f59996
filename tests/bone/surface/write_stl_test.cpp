// SPDX-License-Identifier: Apache-2.0
#include "bone/surface/write_stl.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace kerf::bone
