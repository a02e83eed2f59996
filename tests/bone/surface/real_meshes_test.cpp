// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bone/import/make_body.h"
#include "bone/import/mesh_body.h"
#include "bone/surface/diagnose.h"
#include "bone/surface/repair.h"
#include "bone/surface/signed_distance.h"
#include "documents/read_anatomy.h"
#include "kerf/units.hpp"

/// Surfaces of real bones, read where KERF_DATA says. Volumes and landmarks: the data's own README.
namespace kerf::bone {
namespace {

using namespace literals;

struct RealMesh {
    const char* name;
    std::size_t faces;
    double volume;  ///< [cm³]
};
void PrintTo(const RealMesh& mesh, std::ostream* out) { *out << mesh.name; }

std::string data_file(const std::string& name) {
    const char* folder = std::getenv("KERF_DATA");
    const std::string file = std::string(folder ? folder : "") + "/" + name;
    return folder && std::filesystem::exists(file) ? file : "";
}

class RealMeshes : public testing::TestWithParam<RealMesh> {};

TEST_P(RealMeshes, AreSoundAndHaveTheirVolume) {
    const std::string file = data_file(std::string("meshes/") + GetParam().name);
    if (file.empty()) GTEST_SKIP() << "KERF_DATA names no folder with meshes/, so no real surface was read.";
    text::Diagnostics diagnostics;
    auto surface = read_surface(file).take(diagnostics);
    ASSERT_TRUE(surface) << to_text(diagnostics);
    EXPECT_EQ(surface->mesh.triangles.size(), GetParam().faces);

    for (Vec3& v : surface->mesh.vertices) v = 1e-3 * v;
    if (!surface->has_topology) weld(surface->mesh);
    const SurfaceDiagnosis found = diagnose(surface->mesh, 1e-3);
    std::vector<std::string> notes;
    const auto error = repair(surface->mesh, {}, notes);

    ASSERT_FALSE(error) << error->message << error->advice;
    EXPECT_TRUE(found.is_closed());
    EXPECT_EQ(found.likely_unit, "");
    EXPECT_NEAR(signed_volume_of(surface->mesh) * 1e6, GetParam().volume, 0.01 * GetParam().volume);
}
INSTANTIATE_TEST_SUITE_P(, RealMeshes,
                         testing::Values(RealMesh{"femur_left_vsd_z013.stl", 28'324, 378.0},
                                         RealMesh{"hip_bone_left_vsd_z013.ply", 30'166, 252.0},
                                         RealMesh{"femur_proximal_telfer.stl", 66'798, 209.0},
                                         RealMesh{"tibia_right_vhp_female_du.stl", 60'362, 255.0},
                                         RealMesh{"mandible_harvard02_isosurface.obj", 82'626, 36.0},
                                         RealMesh{"vertebra_l3_tptbox.ply", 74'688, 59.0}));

// ---- landmarks
// --------------------------------------------------------------------------------------------------------

struct Landmarks {
    const char* mesh;
    const char* listed_under;             ///< in landmarks.json
    double tolerance;                     ///< [mm] from the surface; 0: as far as one rater differs from another
    std::vector<const char*> on_surface;  ///< by name; empty: all of `landmarks`
    std::vector<const char*> in_bone;
};
void PrintTo(const Landmarks& landmarks, std::ostream* out) { *out << landmarks.mesh; }

Vec3 point_in(const nlohmann::json& numbers) { return 1e-3 * Vec3{numbers.at(0), numbers.at(1), numbers.at(2)}; }

class RealLandmarks : public testing::TestWithParam<Landmarks> {};

TEST_P(RealLandmarks, LieOnTheBoneTheyName) {
    const std::string file = data_file(std::string("meshes/") + GetParam().mesh), list = data_file("landmarks.json");
    if (file.empty() || list.empty()) GTEST_SKIP() << "KERF_DATA names no folder with meshes/ and landmarks.json.";
    text::Diagnostics diagnostics;
    auto surface = read_surface(file).take(diagnostics);
    ASSERT_TRUE(surface) << to_text(diagnostics);
    for (Vec3& v : surface->mesh.vertices) v = 1e-3 * v;
    const TriangleTree tree(surface->mesh);
    SignedDistance distance(tree);
    std::ifstream in(list);
    const nlohmann::json about = nlohmann::json::parse(in).at(GetParam().listed_under);

    if (GetParam().on_surface.empty()) {
        for (const auto& [name, landmark] : about.at("landmarks").items()) {
            const double from_bone = std::abs(distance(point_in(landmark.at("lps_mm"))));
            EXPECT_LE(from_bone, 1e-3 * landmark.at("rater_sd_mm").get<double>()) << name;
        }
    }
    for (const char* name : GetParam().on_surface)
        EXPECT_LE(std::abs(distance(point_in(about.at(name)))), 1e-3 * GetParam().tolerance) << name;
    for (const char* name : GetParam().in_bone) EXPECT_LT(distance(point_in(about.at(name))), 0.0) << name;
}
INSTANTIATE_TEST_SUITE_P(
    , RealLandmarks,
    testing::Values(
        Landmarks{"femur_left_vsd_z013.stl", "meshes/femur_left_vsd_z013.stl", 0.0, {}, {"head_centre", "neck_centre"}},
        Landmarks{"hip_bone_left_vsd_z013.ply", "meshes/hip_bone_left_vsd_z013.ply", 0.0, {}, {}},
        Landmarks{"femur_proximal_telfer.stl",
                  "meshes/femur_proximal_telfer.stl",
                  0.6,
                  {"LESSER_TROCH", "SUP_GREAT_TROCH", "LAT_GREAT_TROCH"},
                  {"head_centre", "neck_centre"}},
        Landmarks{"mandible_harvard02_isosurface.obj",
                  "volumes/mandible_head_harvard02.nrrd",
                  2.0,
                  {"condylion_right", "condylion_left", "coronoid_right", "coronoid_left", "gonion_right_bone",
                   "gonion_left_bone"},
                  {}}));

// ---- a bone to work on
// ------------------------------------------------------------------------------------------------

TEST(RealFemur, GivesTheNeckOfTheFemurWithItsCortex) {
    text::Diagnostics diagnostics;
    const auto anatomy =
        documents::read_anatomy(std::string(KERF_SOURCE_DIR) + "/tests/real-data/femur-z013.yaml").take(diagnostics);
    ASSERT_TRUE(anatomy) << to_text(diagnostics);
    if (data_file(anatomy->mesh->file).empty()) GTEST_SKIP() << "KERF_DATA names no folder with the femur.";
    ImportReport report;
    const auto body = make_body(*anatomy, 1.0_mm, &report).take(diagnostics);
    ASSERT_TRUE(body) << to_text(diagnostics);
    EXPECT_TRUE(diagnostics.empty()) << to_text(diagnostics);
    EXPECT_EQ(report.file_hashes.size(), 1u);

    // The axis was begun 15 mm beside the cortex and goes through the neck into the head
    const AxisInBone neck = axis_in_bone(*body, anatomy->axes.at(0));
    EXPECT_NEAR(neck.entry, 15.0_mm, anatomy->axes[0].tolerance);
    EXPECT_GT(neck.share, 0.99);
    const auto tissue_at = [&](Vec3 p) {
        double weight[KERF_MAX_TISSUES];
        material_weights(*body, locate(*body, p), weight);
        return weight[0];
    };
    const Vec3 along = normalized(anatomy->axes[0].to - anatomy->axes[0].from);
    EXPECT_EQ(tissue_at(anatomy->axes[0].from + (neck.entry + 2.0_mm) * along), 1.0) << "the cortex";
    EXPECT_EQ(tissue_at(anatomy->points.at(1).at), 0.0) << "the middle of the neck";
    EXPECT_LT(body->surface.at(locate(*body, anatomy->points.at(0).at)), -3.0_mm) << "the middle of the head";
}

}  // namespace
}  // namespace kerf::bone
