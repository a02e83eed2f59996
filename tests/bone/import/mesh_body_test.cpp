// SPDX-License-Identifier: Apache-2.0
#include "bone/import/mesh_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bone/import/fields_memory.h"
#include "bone/import/make_body.h"
#include "core/field/fnv1a.h"
#include "documents/read_anatomy.h"
#include "kerf/units.hpp"
#include "tests/bone/surface/shapes.h"
#include "tests/support/temporary_folder.h"

namespace kerf::bone {
namespace {

using namespace literals;
using test::cube, test::sphere, test::together, test::turned;

/// A folder with a surface, in its file's own unit, and an anatomy that names it.
class MeshAnatomy {
public:
    explicit MeshAnatomy(const SurfaceMesh& surface) {
        std::ofstream(folder_ / "bone.stl", std::ios::binary) << test::binary_stl(surface);
        anatomy.file = folder_ / "bone.yaml";
        anatomy.id = "bone";
        anatomy.mesh.emplace().file = "bone.stl";
        anatomy.tissues = {{"cortical", 1850.0, 2.0_mm, ""}, {"cancellous", 250.0, 0.0, ""}};
    }
    std::optional<Body> body(double spacing) { return make_body(anatomy, spacing, &report).take(diagnostics); }
    void add_canal(const SurfaceMesh& canal) {
        std::ofstream(folder_ / "canal.stl", std::ios::binary) << test::binary_stl(canal);
        anatomy.mesh->canal_file = "canal.stl";
    }
    void write(const std::string& name, const std::string& bytes) {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
    }
    void link(const std::string& name, const std::string& to) { std::filesystem::create_symlink(to, folder_ / name); }
    [[nodiscard]] bool says(const std::string& words) const {
        return std::any_of(report.notes.begin(), report.notes.end(),
                           [&](const std::string& note) { return note.find(words) != std::string::npos; });
    }

    documents::Anatomy anatomy;
    text::Diagnostics diagnostics;
    ImportReport report;

private:
    test::TemporaryFolder folder_;
};

double distance_at(const Body& body, Vec3 p) { return body.surface.at(locate(body, p)); }

/// Volume by counting samples; those at the border by their share.
double volume_of(const Body& body) {
    const Grid& g = body.grid();
    double sum = 0.0;
    for (int k = 0; k < g.samples(2); ++k)
        for (int j = 0; j < g.samples(1); ++j)
            for (int i = 0; i < g.samples(0); ++i)
                sum += std::clamp(0.5 - body.surface.sample(i, j, k) * g.quantum() / g.spacing, 0.0, 1.0);
    return sum * g.spacing * g.spacing * g.spacing;
}

std::uint64_t bits_of(const Body& body) {
    Fnv1a sum;
    const auto add = [&](const auto& level_set) {
        for (std::size_t b = 0; b < body.grid().brick_count(); ++b) {
            const std::int16_t* stored = level_set.stored(b);
            const std::int16_t uniform = level_set.uniform_value(b);
            sum.add({reinterpret_cast<const char*>(stored ? stored : &uniform),
                     sizeof(std::int16_t) * (stored ? stored_samples : 1u)});
        }
    };
    add(body.surface);
    if (!body.hollow.is_empty()) add(body.hollow);
    for (const auto& material : body.materials)
        if (&material != &body.materials.back()) add(material.border);
    return sum.value();
}

TEST(MeshBody, IsTheSurfaceAndItsShell) {
    MeshAnatomy bone(sphere(12.0, 5));
    const auto body = bone.body(0.5_mm);
    ASSERT_TRUE(body) << to_text(bone.diagnostics);
    EXPECT_TRUE(bone.diagnostics.empty()) << to_text(bone.diagnostics);
    EXPECT_TRUE(body->region.is_everywhere());
    EXPECT_EQ(bone.report.file_hashes.size(), 1u);

    for (const Vec3 out : {Vec3{1, 0, 0}, normalized(Vec3{1, 2, 3}), normalized(Vec3{-3, 1, -2})}) {
        EXPECT_NEAR(distance_at(*body, 12.0_mm * out), 0.0, 0.02_mm);
        EXPECT_NEAR(distance_at(*body, 11.0_mm * out), -1.0_mm, 0.02_mm);
        EXPECT_NEAR(distance_at(*body, 13.0_mm * out), 1.0_mm, 0.02_mm);
        double weight[KERF_MAX_TISSUES];
        material_weights(*body, locate(*body, 11.0_mm * out), weight);
        EXPECT_EQ(weight[0], 1.0) << "1 mm deep it is cortical";
        material_weights(*body, locate(*body, 9.0_mm * out), weight);
        EXPECT_EQ(weight[1], 1.0) << "3 mm deep it is not";
    }
}

TEST(MeshBody, HasTheSurfacesVolumeToSecondOrder) {
    // A quantity of second order falls to a quarter with half the spacing
    const SurfaceMesh surface = together(sphere(10.0, 5), turned(sphere(5.0, 4, {1, 0, 0})));
    const double volume = 1e-9 * signed_volume_of(surface);
    MeshAnatomy coarse(surface), fine(surface);
    const auto coarse_body = coarse.body(1.0_mm), fine_body = fine.body(0.5_mm);
    ASSERT_TRUE(coarse_body && fine_body) << to_text(coarse.diagnostics);
    EXPECT_NEAR(volume_of(*coarse_body), volume, 0.004 * volume);
    EXPECT_NEAR(volume_of(*fine_body), volume, 0.001 * volume);
}

TEST(MeshBody, IsTheSameBitsEveryTime) {
    MeshAnatomy one(together(sphere(8.0, 4), turned(cube(7.0, {6, 1, 2})))),
        two(together(sphere(8.0, 4), turned(cube(7.0, {6, 1, 2}))));
    const auto first = one.body(0.5_mm), second = two.body(0.5_mm);
    ASSERT_TRUE(first && second);
    EXPECT_EQ(bits_of(*first), bits_of(*second));
    EXPECT_EQ(one.report.notes, two.report.notes);
}

TEST(MeshBody, TurnsRasToLpsAndSaysWhichFrameItTook) {
    MeshAnatomy lps(cube(20.0, {30, 0, 0})), ras(cube(20.0, {30, 0, 0}));
    ras.anatomy.mesh->is_ras = ras.anatomy.mesh->names_frame = true;
    const auto as_lps = lps.body(1.0_mm), as_ras = ras.body(1.0_mm);
    ASSERT_TRUE(as_lps && as_ras);
    EXPECT_LT(distance_at(*as_lps, {30.0_mm, 0, 0}), 0.0);
    EXPECT_LT(distance_at(*as_ras, {-(30.0_mm), 0, 0}), 0.0);
    EXPECT_TRUE(lps.says("LPS, supposed"));
    EXPECT_TRUE(ras.says("RAS, turned to LPS"));
}

TEST(MeshBody, BelievesTheFramesOfItsFiles) {
    MeshAnatomy bone(cube(20.0, {30, 0, 0}));
    bone.write("bone.stl", test::binary_stl(cube(20.0, {30, 0, 0}), "3D Slicer output. SPACE=RAS"));
    bone.write("canal.stl", test::binary_stl(cube(8.0, {30, 0, 0})));
    bone.anatomy.mesh->canal_file = "canal.stl";  // says nothing: it is in the bone's frame
    const auto body = bone.body(1.0_mm);
    ASSERT_TRUE(body) << to_text(bone.diagnostics);
    EXPECT_LT(distance_at(*body, {-(38.0_mm), 0, 0}), 0.0);
    EXPECT_GT(distance_at(*body, {-(30.0_mm), 0, 0}), 0.0);
    EXPECT_TRUE(bone.says("RAS, turned to LPS, as the file's header says"));

    bone.write("canal.stl", test::binary_stl(cube(8.0, {-30, 0, 0}), "SPACE=LPS"));
    const auto mixed = bone.body(1.0_mm);
    ASSERT_TRUE(mixed) << to_text(bone.diagnostics);
    EXPECT_GT(distance_at(*mixed, {-(30.0_mm), 0, 0}), 0.0);
}

TEST(MeshBody, RefusesAFileThatContradictsTheDocument) {
    struct Case {
        const char* header;
        bool names_frame, is_ras;
        double unit;
        const char* words;  ///< of the refusal; empty: none
    };
    for (const Case& one : {Case{"SPACE=LPS", true, true, 1e-3, "SPACE=LPS, `frame` says RAS"},
                            {"SPACE=RAS", true, false, 1e-3, "SPACE=RAS, `frame` says LPS"},
                            {"SPACE=RAS", true, true, 1e-3, ""},
                            {"UNITS=cm", false, false, 1e-3, "UNITS=cm, `unit` is mm"},
                            {"UNITS=cm", false, false, 1e-2, ""}}) {
        SCOPED_TRACE(one.header);
        MeshAnatomy bone(cube(2.0));
        bone.write("bone.stl", test::binary_stl(cube(one.unit == 1e-3 ? 20.0 : 2.0), one.header));
        bone.anatomy.mesh->names_frame = one.names_frame;
        bone.anatomy.mesh->is_ras = one.is_ras;
        bone.anatomy.mesh->unit = one.unit;
        const bool is_made = make_mesh_bone(bone.anatomy).take(bone.diagnostics).has_value();
        EXPECT_EQ(is_made, one.words[0] == '\0') << to_text(bone.diagnostics);
        if (is_made) continue;
        ASSERT_EQ(bone.diagnostics.size(), 1u);
        EXPECT_EQ(bone.diagnostics[0].code, "E0654");
        EXPECT_NE(bone.diagnostics[0].message.find(one.words), std::string::npos) << to_text(bone.diagnostics);
    }
}

TEST(MeshBody, NeverFollowsALinkOutOfTheFolder) {
    MeshAnatomy bone(cube(20.0)), other(cube(20.0));
    bone.link("link.stl", other.anatomy.file.substr(0, other.anatomy.file.rfind('/')) + "/bone.stl");
    bone.anatomy.mesh->file = "link.stl";
    EXPECT_FALSE(make_mesh_bone(bone.anatomy).take(bone.diagnostics));
    ASSERT_EQ(bone.diagnostics.size(), 1u);
    EXPECT_EQ(bone.diagnostics[0].code, "E0619") << to_text(bone.diagnostics);
}

TEST(MeshBody, CountsInTheUnitThatWasSaid) {
    MeshAnatomy bone(cube(2.0));
    bone.anatomy.mesh->unit = 1e-2;
    const auto body = bone.body(1.0_mm);
    ASSERT_TRUE(body) << to_text(bone.diagnostics);
    EXPECT_NEAR(distance_at(*body, {9.0_mm, 0, 0}), -1.0_mm, 0.01_mm);
}

TEST(MeshBody, SuspectsAnotherUnitAndSaysWhatToWrite) {
    MeshAnatomy bone(cube(0.2));  // a bone of 20 cm in metres, taken for millimetres
    EXPECT_TRUE(bone.body(0.05_mm));
    ASSERT_FALSE(bone.diagnostics.empty());
    EXPECT_EQ(bone.diagnostics[0].code, "W0648");
    EXPECT_NE(bone.diagnostics[0].message.find("`unit: m`"), std::string::npos) << bone.diagnostics[0].message;
    EXPECT_FALSE(text::has_error(bone.diagnostics));
}

TEST(MeshBody, SaysThatABoneWithoutShellIsAllOneTissue) {
    MeshAnatomy bone(cube(20.0));
    bone.anatomy.tissues = {{"cortical", 1850.0, 0.0, ""}};
    EXPECT_TRUE(bone.body(1.0_mm));
    EXPECT_TRUE(bone.says("all of the bone is cortical"));
}

TEST(MeshBody, TakesOnlyTheSurroundingsOfTheAxes) {
    MeshAnatomy bone(cube(100.0));
    bone.anatomy.axes = {{"axis", {60.0_mm, 0, 0}, {40.0_mm, 0, 0}, 0.0}};
    const auto body = bone.body(1.0_mm);
    ASSERT_TRUE(body) << to_text(bone.diagnostics);

    // 15 mm around the axis, in x as far as the bone goes and a little air
    EXPECT_NEAR(body->region.low.x, 25.0_mm, 1.0_mm);
    EXPECT_NEAR(body->region.high.x, 51.0_mm, 1.0_mm);
    EXPECT_NEAR(body->region.high.y, 15.0_mm, 1.0_mm);
    EXPECT_TRUE(bone.says("Beyond, bone goes on and cannot be cut"));
    EXPECT_LT(distance_at(*body, {0, 0, 0}), 0.0) << "beyond a face there is bone as at the face";
    EXPECT_GT(distance_at(*body, {55.0_mm, 0, 0}), 0.0);
    EXPECT_TRUE(axis_in_bone(*body, bone.anatomy.axes[0]).share == 1.0);
}

TEST(MeshBody, RefusesAxesBesideTheSurface) {
    MeshAnatomy bone(cube(20.0, {-50, 0, 0}));
    bone.anatomy.axes = {{"axis", {60.0_mm, 0, 0}, {40.0_mm, 0, 0}, 0.0}};
    EXPECT_FALSE(bone.body(1.0_mm));
    EXPECT_EQ(bone.diagnostics.back().code, "E0652");
}

TEST(MeshBody, RefusesAnOpenSurfaceUntilItIsToldToCloseIt) {
    SurfaceMesh open = sphere(10.0, 4);
    open.triangles.erase(open.triangles.begin() + 40);
    MeshAnatomy bone(open);
    EXPECT_FALSE(bone.body(1.0_mm));
    ASSERT_EQ(bone.diagnostics.size(), 1u);
    EXPECT_EQ(bone.diagnostics[0].code, "E0649");

    MeshAnatomy told(open);
    told.anatomy.mesh->holes_up_to = 3.0_mm;
    EXPECT_TRUE(told.body(1.0_mm)) << to_text(told.diagnostics);
    EXPECT_TRUE(told.says("Closed 1 hole"));
}

TEST(MeshBody, TooMuchIsRefusedBeforeItIsTakenAndTheSpacingThatFitsIsNamed) {
    // Given a cube whose border has more bricks than memory may hold, and one that has more bone than can be cut
    for (const double size : {400.0, 290.0}) {
        MeshAnatomy bone(cube(size));
        EXPECT_FALSE(bone.body(size == 400.0 ? 0.1_mm : 0.2_mm));
        ASSERT_EQ(bone.diagnostics.size(), 1u);
        const text::Diagnostic& refusal = bone.diagnostics[0];
        EXPECT_EQ(refusal.code, "E0602");
        ASSERT_TRUE(refusal.write.starts_with("accuracy: {spacing: ")) << refusal.write;
        double fits = 0.0;
        std::from_chars(refusal.write.data() + 20, refusal.write.data() + refusal.write.size(),
                        fits);  // whatever the locale
        fits *= 1e-3;

        // Then what is named fits, and is no more than a third coarser than what just would
        const double half = 0.5e-3 * size;
        const auto distance = [&](Vec3 p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) - half; };
        const std::vector<std::function<double(Vec3)>> borders{distance, [&](Vec3 p) { return -distance(p) - 1e-3; }};
        const Box bounds{{-half, -half, -half}, {half, half, half}};
        EXPECT_LE(excess_of(fields_memory(bounds, fits, borders, false)), 0.95) << fits;
        EXPECT_GT(excess_of(fields_memory(bounds, fits / 1.33, borders, false)), 0.9) << fits;
    }
}

TEST(MeshBody, RefusesAPlateThatIsTooThinAndNamesTheSpacingThatCarriesIt) {
    // A plate with air on both sides
    SurfaceMesh plate = cube(20.0);
    for (Vec3& v : plate.vertices) v.z *= 0.05;
    MeshAnatomy coarse(plate), fine(plate);
    EXPECT_FALSE(coarse.body(0.5_mm));
    ASSERT_EQ(coarse.diagnostics.size(), 1u);
    EXPECT_EQ(coarse.diagnostics[0].code, "E0655");
    EXPECT_EQ(coarse.diagnostics[0].level, text::Diagnostic::Level::error);
    EXPECT_NE(coarse.diagnostics[0].message.find("only 1.00 mm thick"), std::string::npos)
        << coarse.diagnostics[0].message;
    EXPECT_EQ(coarse.diagnostics[0].write, "accuracy: {spacing: 0.33 mm}");
    EXPECT_TRUE(fine.body(0.33_mm));
    EXPECT_TRUE(fine.diagnostics.empty()) << to_text(fine.diagnostics);
}

TEST(MeshBody, CarriesASheetAroundACavityThinnerThanAVoxel) {
    // A shell of 0.4 mm, and one of 5 mm, at a spacing of 0.5 mm
    MeshAnatomy thin(together(cube(20.0), turned(cube(19.2)))), thick(together(cube(20.0), turned(cube(10.0))));
    const auto sheet = thin.body(0.5_mm), wall = thick.body(0.5_mm);
    ASSERT_TRUE(sheet && wall);
    EXPECT_TRUE(thin.diagnostics.empty()) << to_text(thin.diagnostics);
    EXPECT_TRUE(thin.says("each side has a field of its own"));
    EXPECT_FALSE(sheet->hollow.is_empty());
    double bone = 0.0;
    for (double x = 8.0_mm; x < 11.0_mm; x += 0.001_mm)
        bone += uncut_distance(*sheet, locate(*sheet, {x, 0.3_mm, 0.2_mm})) < 0.0 ? 0.001_mm : 0.0;
    EXPECT_NEAR(bone, 0.4_mm, 0.005_mm);
    EXPECT_TRUE(wall->hollow.is_empty()) << "one field is enough for it";
    EXPECT_FALSE(thick.says("field of its own"));
}

TEST(MeshBone, KeepsItsCavitiesAsRoomsAndGivesThemBackWithTheWhole) {
    SurfaceFile file;
    file.mesh = together(cube(20.0), turned(cube(10.0)));
    file.has_topology = true;
    documents::Anatomy anatomy;
    anatomy.mesh.emplace();
    text::Diagnostics diagnostics;
    const auto bone = make_mesh_bone(anatomy, file, nullptr).take(diagnostics);
    ASSERT_TRUE(bone) << to_text(diagnostics);
    EXPECT_NEAR(signed_volume_of(bone->surface), 8e-6, 1e-15);
    ASSERT_EQ(bone->inner_surfaces.size(), 1u);
    EXPECT_NEAR(signed_volume_of(bone->inner_surfaces[0]), 1e-6, 1e-15) << "a room looks out of itself";
    EXPECT_NEAR(signed_volume_of(whole_surface_of(*bone)), 7e-6, 1e-15);
}

TEST(MeshBody, WarnsOfFacesThatCutThroughOneAnother) {
    MeshAnatomy bone(together(cube(20.0), turned(cube(20.0, {7, 6, 5}))));
    EXPECT_TRUE(bone.body(1.0_mm)) << "a cavity that breaks through its bone";
    EXPECT_TRUE(
        std::any_of(bone.diagnostics.begin(), bone.diagnostics.end(), [](const auto& d) { return d.code == "W0656"; }));
}

TEST(MeshBody, RefusesSolidsThatCrossOrTouch) {
    const auto refuses = [](const SurfaceMesh& mesh, const std::string& words) {
        MeshAnatomy bone(mesh);
        EXPECT_FALSE(bone.body(1.0_mm)) << words;
        ASSERT_EQ(bone.diagnostics.size(), 1u) << to_text(bone.diagnostics);
        EXPECT_EQ(bone.diagnostics[0].code, "E0659");
        EXPECT_NE(bone.diagnostics[0].message.find(words), std::string::npos) << bone.diagnostics[0].message;
    };
    refuses(together(cube(20.0), cube(20.0, {19.9, 0, 0})), "of 8.00 cm3 and 8.00 cm3, cross near");
    refuses(together(cube(20.0), cube(20.0, {18.0, 0, 0})), "of 8.00 cm3 and 8.00 cm3, cross near");
    refuses(together(cube(20.0), cube(20.0, {20.0, 1.0, 2.0})), "of 8.00 cm3 and 8.00 cm3, cross near");
    refuses(together(cube(20.0), cube(20.0, {20.0, 0, 0})), "two parts of the surface touch near");
    MeshAnatomy apart(together(cube(20.0), cube(20.0, {20.5, 0, 0})));
    EXPECT_TRUE(apart.body(0.25_mm)) << to_text(apart.diagnostics);
}

TEST(MeshBody, HasNoBoneInItsCanal) {
    for (const bool is_file : {true, false}) {
        MeshAnatomy bone(cube(40.0));
        if (is_file)
            bone.add_canal(cube(10.0));
        else
            bone.anatomy.mesh->canal = documents::TubeSolid{{0, 0, -(5.0_mm)}, {0, 0, 5.0_mm}, 5.0_mm};
        const auto body = bone.body(0.5_mm);
        ASSERT_TRUE(body) << to_text(bone.diagnostics);
        EXPECT_NEAR(distance_at(*body, {4.0_mm, 0, 0}), 1.0_mm, 0.05_mm) << "1 mm before the canal's wall";
        EXPECT_NEAR(distance_at(*body, {6.0_mm, 0, 0}), -1.0_mm, 0.05_mm);
        EXPECT_NEAR(distance_at(*body, {19.0_mm, 0, 0}), -1.0_mm, 0.05_mm);
        double weight[KERF_MAX_TISSUES];
        material_weights(*body, locate(*body, {6.0_mm, 0, 0}), weight);
        EXPECT_EQ(weight[1], 1.0) << "the shell is under the outer surface only";
    }
}

TEST(MeshBody, APhantomsThinWallHasTwoFieldsToo) {
    const auto bone = [](double room) {
        documents::Anatomy anatomy;
        anatomy.tissues = {{"cortical", 1850.0, 0.0, ""}};
        anatomy.phantom.parts = {{"body", documents::BoxSolid{{}, {20.0_mm, 20.0_mm, 20.0_mm}}, false, ""},
                                 {"room", documents::BoxSolid{{}, {room, room, room}}, true, ""}};
        text::Diagnostics diagnostics;
        return make_body(anatomy, 0.5_mm).take(diagnostics);
    };
    const auto sheet = bone(19.4_mm), wall = bone(10.0_mm);
    ASSERT_TRUE(sheet && wall);
    EXPECT_FALSE(sheet->hollow.is_empty());
    EXPECT_TRUE(wall->hollow.is_empty());
    EXPECT_NEAR(uncut_distance(*sheet, locate(*sheet, {9.85_mm, 0, 0})), -0.15_mm, 0.01_mm);
}

TEST(MeshBody, WritesNothingOfTheFilesName) {
    MeshAnatomy bone(together(cube(20.0), turned(cube(20.0, {7, 6, 5}))));
    EXPECT_TRUE(bone.body(1.0_mm));
    EXPECT_FALSE(bone.says("bone.stl"));
    EXPECT_FALSE(bone.says("/tmp"));
}

}  // namespace
}  // namespace kerf::bone
