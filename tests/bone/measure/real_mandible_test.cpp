// SPDX-License-Identifier: Apache-2.0
// The gonial angles of a real mandible, which its landmarks file states: KERF_DATA/landmarks.json.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "bone/measure/mandible.h"
#include "bone/measure/mesh_surface.h"
#include "bone/surface/read_surface.h"
#include "kerf/units.hpp"

namespace kerf::bone {
namespace {

using namespace literals;

TEST(RealMandible, HasTheStatedGonialAngles) {
    const char* folder = std::getenv("KERF_DATA");
    const std::filesystem::path data = folder != nullptr ? folder : "";
    const std::filesystem::path file = data / "meshes/mandible_harvard02_isosurface.obj";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "KERF_DATA names no folder with meshes/.";
    text::Diagnostics diagnostics;
    auto read = read_surface(file.string()).take(diagnostics);
    ASSERT_TRUE(read) << to_text(diagnostics);
    for (Vec3& v : read->mesh.vertices) v = 1e-3 * v;
    constexpr double half_voxel = 0.25_mm;
    const MeshSurface surface(read->mesh, half_voxel);

    const auto stated =
        nlohmann::json::parse(std::ifstream(data / "landmarks.json"))["volumes/mandible_head_harvard02.nrrd"];
    const double tolerance = stated["tolerance_mm"].get<double>() * 1e-3;
    const auto point = [&](const std::string& id) {
        const auto at = stated[id].get<std::array<double, 3>>();
        return KnownPoint{1e-3 * Vec3{at[0], at[1], at[2]}, tolerance};
    };
    for (const std::string side : {"right", "left"}) {
        const auto angle = gonial_angle(surface, {.condylion = point("condylion_" + side),
                                                  .gonion = point("gonion_" + side + "_bone"),
                                                  .menton = point("menton"),
                                                  .within = 20.0_mm});
        ASSERT_TRUE(angle) << side;
        const double expected = stated["gonial_angle_" + side + "_deg"].get<double>() * 1.0_deg;
        EXPECT_NEAR(angle->value, expected, 3.0_deg /* another construction; its gonion is known to 2 mm of 60 mm */)
            << side;
        EXPECT_GT(angle->uncertainty, 0.0);
        RecordProperty(side + "_deg", std::to_string(angle->value / 1.0_deg));
        RecordProperty(side + "_uncertainty_deg", std::to_string(angle->uncertainty / 1.0_deg));
    }
}

}  // namespace
}  // namespace kerf::bone
