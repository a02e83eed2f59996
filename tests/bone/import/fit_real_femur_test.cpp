// SPDX-License-Identifier: Apache-2.0
// Femurs of people: what is fitted, against the points that raters set on the same surfaces.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "bone/import/fit_landmarks.h"
#include "bone/import/mesh_body.h"
#include "kerf/units.hpp"

namespace kerf::bone {
namespace {

using namespace literals;

std::string data_file(const std::string& name) {
    const char* folder = std::getenv("KERF_DATA");
    const std::string file = std::string(folder ? folder : "") + "/" + name;
    return folder && std::filesystem::exists(file) ? file : "";
}

nlohmann::json about(const std::string& mesh) {
    std::ifstream in(data_file("landmarks.json"));
    return nlohmann::json::parse(in).at(mesh);
}

Vec3 point_in(const nlohmann::json& numbers) { return 1e-3 * Vec3{numbers.at(0), numbers.at(1), numbers.at(2)}; }
Vec3 direction_in(const nlohmann::json& numbers) { return {numbers.at(0), numbers.at(1), numbers.at(2)}; }

double degrees_between(Vec3 a, Vec3 b) { return std::atan2(length(cross(a, b)), dot(a, b)) * 180.0 / std::numbers::pi; }

/// The sphere nearest to points, as a linear problem: |p|² = 2 c·p + k. Solved by steepest descent, in no hurry, so
/// that nothing of the code under test is used.
Vec3 centre_of_sphere(const std::vector<Vec3>& points) {
    Vec3 mean{};
    for (const Vec3 p : points) mean = mean + p / static_cast<double>(points.size());
    Vec3 centre{};
    double k = 0.0;
    for (int step = 0; step < 200'000; ++step) {
        Vec3 slope{};
        double slope_k = 0.0;
        for (const Vec3 world : points) {
            const Vec3 p = 1e2 * (world - mean);  // [cm], so that all unknowns are about 1
            const double off = dot(p, p) - 2.0 * dot(centre, p) - k;
            slope = slope - 2.0 * off * p;
            slope_k -= off;
        }
        centre = centre - 1e-3 * slope;
        k -= 1e-3 * slope_k;
    }
    return mean + 1e-2 * centre;
}

documents::Anatomy femur_of(const char* mesh) {
    documents::Anatomy anatomy;
    anatomy.file = "femur.yaml";
    anatomy.id = "femur";
    anatomy.mesh.emplace();
    anatomy.mesh->file = mesh;
    anatomy.mesh->names_frame = true;
    anatomy.tissues = {{"bone", 1850.0, 0.0, ""}};
    return anatomy;
}

struct Result {
    Vec3 head{};
    std::vector<documents::LandmarkAxis> axes;
    std::string notes;
};

std::optional<Result> fit(documents::Anatomy anatomy) {
    text::Diagnostics diagnostics;
    const auto bone = make_mesh_bone(anatomy).take(diagnostics);
    EXPECT_TRUE(bone) << to_text(diagnostics);
    if (!bone) return std::nullopt;
    use_fits(anatomy, bone->report);
    Result result{anatomy.points.at(0).at, anatomy.axes, {}};
    for (const std::string& note : bone->report.notes)
        if (note.find("fitted") != std::string::npos) result.notes += note + "\n";
    return result;
}

/// Guesses as one who looks at the surface would give them: whole centimetres.
documents::Anatomy guessed_z013() {
    documents::Anatomy anatomy = femur_of("meshes/femur_left_vsd_z013.stl");
    anatomy.points = {{"head",
                       {-(220.0_mm), 290.0_mm, -(590.0_mm)},
                       2.0_mm,
                       {},
                       documents::LandmarkFit{.radius = 22.0_mm, .within = 15.0_mm}}};
    anatomy.axes = {{"shaft",
                     {-(190.0_mm), 290.0_mm, -(680.0_mm)},
                     {-(210.0_mm), 290.0_mm, -(840.0_mm)},
                     3.0_mm,
                     documents::LandmarkFit{.shape = documents::LandmarkFit::Shape::tube, .radius = 14.0_mm}},
                    {"neck",
                     {-(180.0_mm), 300.0_mm, -(640.0_mm)},
                     {-(240.0_mm), 280.0_mm, -(590.0_mm)},
                     2.0_mm,
                     documents::LandmarkFit{.shape = documents::LandmarkFit::Shape::neck, .reference = "head"}},
                    {"condyles",
                     {-(250.0_mm), 340.0_mm, -(970.0_mm)},
                     {-(210.0_mm), 340.0_mm, -(970.0_mm)},
                     2.0_mm,
                     documents::LandmarkFit{.shape = documents::LandmarkFit::Shape::condyles, .reference = "shaft"}}};
    return anatomy;
}

class FitRealFemur : public testing::Test {
protected:
    void SetUp() override {
        if (data_file("meshes/femur_left_vsd_z013.stl").empty() || data_file("landmarks.json").empty())
            GTEST_SKIP() << "KERF_DATA names no folder with meshes/ and landmarks.json.";
        raters = about("meshes/femur_left_vsd_z013.stl");
    }
    [[nodiscard]] Vec3 rated(const char* name) const { return point_in(raters.at("landmarks").at(name).at("lps_mm")); }
    [[nodiscard]] Vec3 rated_head() const {
        return centre_of_sphere({rated("Superior Femoral Head (SFH)"), rated("Anterior Femoral Head (AFH)"),
                                 rated("Lateral Femoral Head (LFH)"), rated("Posterior Femoral Head (PFH)"),
                                 rated("Medial Femoral Head (MFH)"), rated("Inferior Femoral Head (IFH)")});
    }
    [[nodiscard]] Vec3 rated_neck() const {
        return 0.25 * (rated("Superior Neck Isthmus (SNI)") + rated("Anterior Neck Isthmus (ANI)") +
                       rated("Inferior Neck Isthmus (INI)") + rated("Posterior Neck Isthmus (PNI)"));
    }
    nlohmann::json raters;
};

TEST_F(FitRealFemur, HasItsHeadWhereRatersPutIt) {
    const auto found = fit(guessed_z013());
    ASSERT_TRUE(found);
    RecordProperty("notes", found->notes);
    EXPECT_LT(length(found->head - rated_head()), 1.0_mm) << found->notes;
}

TEST_F(FitRealFemur, HasTheNeckShaftAngleOfTheRaters) {
    const auto found = fit(guessed_z013());
    ASSERT_TRUE(found);
    const auto &shaft = found->axes[0], &neck = found->axes[1];
    const Vec3 rated_direction = rated_head() - rated_neck(), down = -direction_in(raters.at("shaft_direction_up"));
    const double angle = degrees_between(neck.to - neck.from, shaft.to - shaft.from);
    RecordProperty("angle_deg", std::to_string(angle));
    RecordProperty("raters_deg", std::to_string(degrees_between(rated_direction, down)));
    EXPECT_NEAR(angle, degrees_between(rated_direction, down), 2.0);
    EXPECT_LT(degrees_between(neck.to - neck.from, rated_direction), 2.0);
    EXPECT_LT(degrees_between(shaft.to - shaft.from, down), 2.0);
}

TEST_F(FitRealFemur, HasItsCondylesWhereRatersPutTheirBacks) {
    const auto found = fit(guessed_z013());
    ASSERT_TRUE(found);
    const documents::LandmarkAxis& condyles = found->axes[2];
    const Vec3 line = rated("Posterior Lateral Condyle (PLC)") - rated("Posterior Medial Condyle (PMC)");
    RecordProperty("off_deg", std::to_string(degrees_between(condyles.to - condyles.from, line)));
    EXPECT_LT(degrees_between(condyles.to - condyles.from, line), 2.0);
}

TEST_F(FitRealFemur, ForgetsWhereTheGuessWas) {
    const auto wide = [](documents::Anatomy anatomy) {
        anatomy.points[0].fit->within = 25.0_mm;
        for (documents::LandmarkAxis& axis : anatomy.axes) axis.fit->within = 25.0_mm;
        return anatomy;
    };
    const auto best = fit(wide(guessed_z013()));
    ASSERT_TRUE(best);
    for (const Vec3 move : {Vec3{10.0_mm, 0, 0}, {0, -(10.0_mm), 0}}) {
        documents::Anatomy anatomy = wide(guessed_z013());
        anatomy.points[0].at = anatomy.points[0].at + move;
        for (documents::LandmarkAxis& axis : anatomy.axes) axis.from = axis.from + move, axis.to = axis.to + move;
        const auto found = fit(anatomy);
        ASSERT_TRUE(found);
        EXPECT_LT(length(found->head - best->head), 0.1_mm);
        for (std::size_t i = 0; i < found->axes.size(); ++i) {
            const double turned =
                degrees_between(found->axes[i].to - found->axes[i].from, best->axes[i].to - best->axes[i].from);
            EXPECT_LT(turned, 0.1) << found->axes[i].id;
        }
    }
}

TEST(FitTelferFemur, HasItsHeadWhereTheSurfaceIsRound) {
    const char* mesh = "meshes/femur_proximal_telfer.stl";
    if (data_file(mesh).empty() || data_file("landmarks.json").empty())
        GTEST_SKIP() << "KERF_DATA names no folder with meshes/ and landmarks.json.";
    documents::Anatomy anatomy = femur_of(mesh);
    anatomy.points = {{"head", {0, 10.0_mm, -(140.0_mm)}, 2.0_mm, {}, documents::LandmarkFit{.radius = 24.0_mm}}};
    anatomy.axes = {{"neck",
                     {-(50.0_mm), 50.0_mm, -(180.0_mm)},
                     {0, 0, -(130.0_mm)},
                     2.0_mm,
                     documents::LandmarkFit{.shape = documents::LandmarkFit::Shape::neck, .reference = "head"}}};
    const auto found = fit(anatomy);
    ASSERT_TRUE(found);
    const auto list = about(mesh);
    RecordProperty("notes", found->notes);
    EXPECT_LT(length(found->head - point_in(list.at("head_centre"))), 1.0_mm) << found->notes;
    EXPECT_LT(degrees_between(found->axes[0].to - found->axes[0].from, direction_in(list.at("neck_direction_to_head"))),
              2.0)
        << found->notes;
}

}  // namespace
}  // namespace kerf::bone
