// SPDX-License-Identifier: Apache-2.0
#include "bone/surface/repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "bone/surface/diagnose.h"
#include "kerf/units.hpp"
#include "tests/bone/surface/shapes.h"

/// Every kind of damage, made here: what is seen of it, and what becomes of it.
namespace kerf::bone {
namespace {

using namespace literals;
using test::cube, test::soup_of, test::sphere, test::together, test::turned;

constexpr double cm3 = 1e-6;  // of a cube of 10 mm

SurfaceDiagnosis seen(const SurfaceMesh& mesh) { return diagnose(mesh, 1.0_mm); }

/// Closed, looking outwards, and of this volume.
void expect_mended(SurfaceMesh mesh, double volume, const std::string& note, const RepairRules& rules = {}) {
    std::vector<std::string> notes;
    const auto error = repair(mesh, rules, notes);
    ASSERT_FALSE(error) << error->code << ' ' << error->message;
    EXPECT_NEAR(signed_volume_of(mesh), volume, 1e-9 * volume);
    const SurfaceDiagnosis after = seen(mesh);
    EXPECT_EQ(after.open_edges.count, 0u);
    EXPECT_EQ(after.inconsistent_edges.count, 0u);
    EXPECT_EQ(after.duplicate_faces.count, 0u);
    EXPECT_EQ(after.collapsed_faces.count, 0u);
    if (note.empty()) {
        EXPECT_TRUE(notes.empty()) << notes[0];
    } else {
        EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [&](const auto& n) {
            return n.find(note) != std::string::npos;
        })) << (notes.empty() ? "nothing was said" : notes[0]);
    }

    // What was mended needs no mending
    const std::vector<Triangle> before = mesh.triangles;
    std::vector<std::string> again;
    EXPECT_FALSE(repair(mesh, {}, again));
    EXPECT_EQ(mesh.triangles, before);
}
void expect_refused(SurfaceMesh mesh, const char* code, const std::string& advice, const RepairRules& rules = {}) {
    std::vector<std::string> notes;
    const auto error = repair(mesh, rules, notes);
    ASSERT_TRUE(error);
    EXPECT_STREQ(error->code, code);
    EXPECT_NE(error->advice.find(advice), std::string::npos) << error->message << ' ' << error->advice;
}

TEST(Diagnose, GivesTheFiguresOfACube) {
    const SurfaceDiagnosis found = seen(cube(10.0_mm, {5.0_mm, 0, 0}));
    EXPECT_EQ(found.vertices, 8u);
    EXPECT_EQ(found.faces, 12u);
    EXPECT_NEAR(found.volume, cm3, 1e-18);
    EXPECT_NEAR(found.area, 600e-6, 1e-15);
    EXPECT_NEAR(found.bounds.high.x, 10.0_mm, 1e-15);
    EXPECT_TRUE(found.is_closed());
    EXPECT_FALSE(found.is_inside_out);
    ASSERT_EQ(found.pieces.size(), 1u);
    EXPECT_EQ(found.pieces[0].faces, 12u);
    for (const Flaw& flaw :
         {found.open_edges, found.nonmanifold_edges, found.pinched_vertices, found.inconsistent_edges,
          found.duplicate_faces, found.duplicate_vertices, found.collapsed_faces, found.flat_faces, found.crossings})
        EXPECT_EQ(flaw.count, 0u);
    EXPECT_EQ(to_notes(found).size(), 1u);
}
TEST(Diagnose, GivesTheVolumeOfASphere) {
    const double ball = 4.0 / 3.0 * 3.14159265358979 * 1e-6;
    EXPECT_NEAR(seen(sphere(10.0_mm, 5)).volume, ball, 0.002 * ball /* its chords cut off that much */);
}
TEST(Repair, LeavesSoundSurfacesAlone) {
    expect_mended(cube(10.0_mm), cm3, "");
    expect_mended(sphere(10.0_mm, 2), signed_volume_of(sphere(10.0_mm, 2)), "");
}

// ---- vertices and faces
// -----------------------------------------------------------------------------------------------

TEST(Repair, JoinsTheVerticesOfASoup) {
    EXPECT_EQ(seen(soup_of(cube(10.0_mm))).duplicate_vertices.count, 28u);
    EXPECT_EQ(seen(soup_of(cube(10.0_mm))).open_edges.count, 36u);
    expect_mended(soup_of(cube(10.0_mm)), cm3, "Made 28 vertices one with another");
}
TEST(Repair, JoinsBordersThatAreAlmostOne) {
    SurfaceMesh soup = soup_of(cube(10.0_mm));
    for (std::size_t v = 0; v < soup.vertices.size(); ++v) soup.vertices[v].x += 1e-8 * static_cast<double>(v % 7);
    std::vector<std::string> notes;
    ASSERT_FALSE(repair(soup, {}, notes));
    EXPECT_NEAR(signed_volume_of(soup), cm3, 1e-4 * cm3);
}
TEST(Repair, LeavesOutCollapsedFaces) {
    SurfaceMesh mesh = cube(10.0_mm);
    mesh.triangles.push_back({0, 0, 1});
    EXPECT_EQ(seen(mesh).collapsed_faces.count, 1u);
    expect_mended(mesh, cm3, "Left out 1 face with the same corner twice");
}
TEST(Repair, KeepsFacesWithoutAreaThatHoldTheSurfaceTogether) {
    // An edge with a vertex in its middle on one side, and a flat face that fills the gap
    SurfaceMesh mesh = cube(10.0_mm);
    mesh.vertices.push_back(0.5 * (mesh.vertices[0] + mesh.vertices[1]));
    std::erase(mesh.triangles, Triangle{0, 1, 5});
    mesh.triangles.insert(mesh.triangles.end(), {Triangle{0, 8, 5}, {8, 1, 5}, {0, 1, 8}});
    EXPECT_EQ(seen(mesh).flat_faces.count, 1u);
    EXPECT_TRUE(seen(mesh).is_closed());
    expect_mended(mesh, cm3, "");
}
TEST(Repair, LeavesOutDuplicateFaces) {
    SurfaceMesh mesh = cube(10.0_mm);
    mesh.triangles.push_back({2, 3, 0});  // the first one, turned on
    EXPECT_EQ(seen(mesh).duplicate_faces.count, 1u);
    EXPECT_EQ(seen(mesh).nonmanifold_edges.count, 3u);
    expect_mended(mesh, cm3, "Left out 1 face that are there twice");
    expect_mended(together(cube(10.0_mm), cube(10.0_mm)), 2.0 * cm3, "");  // two bones in one place are still two
    std::vector<std::string> notes;
    SurfaceMesh twice = soup_of(together(cube(10.0_mm), cube(10.0_mm)));
    ASSERT_FALSE(repair(twice, {}, notes));
    EXPECT_NEAR(signed_volume_of(twice), cm3, 1e-9 * cm3) << "but a soup of them is one";
}
TEST(Repair, LeavesOutFacesThatLieBackToBack) {
    SurfaceMesh mesh = cube(10.0_mm);
    mesh.triangles.push_back({0, 3, 7});
    mesh.triangles.push_back({7, 3, 0});
    expect_mended(mesh, cm3, "Left out 2 faces that lie back to back");
}

// ---- holes
// ------------------------------------------------------------------------------------------------------------

SurfaceMesh open_sphere() {
    SurfaceMesh mesh = sphere(10.0_mm, 4);
    mesh.triangles.erase(mesh.triangles.begin() + 40);
    return mesh;
}

TEST(Diagnose, MeasuresAHole) {
    SurfaceMesh mesh = cube(10.0_mm);
    mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 2);  // the lid at the bottom
    const SurfaceDiagnosis found = seen(mesh);
    EXPECT_EQ(found.open_edges.count, 4u);
    ASSERT_EQ(found.openings.size(), 1u);
    EXPECT_NEAR(found.openings[0].length, 40.0_mm, 1e-12);
    EXPECT_NEAR(found.openings[0].width, 14.142_mm, 0.001_mm);
    EXPECT_NEAR(found.openings[0].at.z, -5.0_mm, 1e-12);
    EXPECT_FALSE(found.is_closed());
}
TEST(Repair, ClosesAHoleOnlyUpToTheSizeThatWasAllowed) {
    const double width = seen(open_sphere()).openings.at(0).width;
    expect_refused(open_sphere(), "E0649", "holes_up_to: ");
    expect_refused(open_sphere(), "E0649", "holes_up_to: ", {.holes_up_to = 0.99 * width});
    expect_mended(open_sphere(), signed_volume_of(sphere(10.0_mm, 4)), "Closed 1 hole", {.holes_up_to = 1.01 * width});
}
TEST(Repair, ClosesAHoleFlatAcross) {
    SurfaceMesh mesh = cube(10.0_mm);
    mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 2);
    expect_mended(mesh, cm3, "Closed 1 hole, the widest 14.14 mm across", {.holes_up_to = 15.0_mm});
}
TEST(Repair, ProposesNoHoleThatIsAWholeSection) {
    SurfaceMesh shaft = cube(50.0_mm);
    shaft.triangles.erase(shaft.triangles.begin(), shaft.triangles.begin() + 2);
    std::vector<std::string> notes;
    const auto error = repair(shaft, {}, notes);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->advice.find("holes_up_to"), std::string::npos) << error->advice;
}
TEST(Repair, RefusesASheet) {
    SurfaceMesh sheet{{{0, 0, 0}, {0.05, 0, 0}, {0.05, 0.05, 0}, {0, 0.05, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    expect_refused(sheet, "E0649", "Close it");
    expect_refused(together(sheet, turned(sheet)), "E0647", "no bone");  // back to back
}

// ---- sides
// ------------------------------------------------------------------------------------------------------------

TEST(Repair, TurnsASurfaceThatIsInsideOut) {
    EXPECT_TRUE(seen(turned(cube(10.0_mm))).is_inside_out);
    expect_mended(turned(cube(10.0_mm)), cm3, "Turned the whole surface: it was inside out");
}
TEST(Repair, TurnsFacesLikeTheirNeighbours) {
    SurfaceMesh mesh = sphere(10.0_mm, 3);
    for (std::size_t f = 0; f < mesh.triangles.size(); f += 5) std::swap(mesh.triangles[f][0], mesh.triangles[f][1]);
    EXPECT_GT(seen(mesh).inconsistent_edges.count, 100u);
    expect_mended(mesh, signed_volume_of(sphere(10.0_mm, 3)), "to look to the same side as the neighbours");
}
TEST(Repair, RefusesAMoebiusStrip) {
    SurfaceMesh strip;
    for (int i = 0; i < 12; ++i) {
        const double turn = 2.0 * 3.14159265358979 * i / 12.0;
        const Vec3 out{std::cos(turn), std::sin(turn), 0},
            across = 0.3 * (std::cos(0.5 * turn) * out + std::sin(0.5 * turn) * Vec3{0, 0, 1});
        strip.vertices.push_back(0.03 * (out - across));
        strip.vertices.push_back(0.03 * (out + across));
    }
    for (std::uint32_t i = 0; i < 12; ++i) {
        const std::uint32_t a = 2 * i, b = a + 1, c = i == 11 ? 1 : a + 2, d = i == 11 ? 0 : a + 3;
        strip.triangles.insert(strip.triangles.end(), {Triangle{a, c, b}, {c, d, b}});
    }
    expect_refused(strip, "E0651", "Mend the surface");
}
TEST(Repair, RefusesAFinBetweenFaces) {
    SurfaceMesh mesh = cube(10.0_mm);
    mesh.vertices.push_back({0, 0, 9.0_mm});
    mesh.triangles.push_back({4, 5, 8});
    EXPECT_EQ(seen(mesh).nonmanifold_edges.count, 1u);
    expect_refused(mesh, "E0650", "Mend the surface", {.holes_up_to = 20.0_mm});
}
TEST(Repair, TakesTwoCubesThatShareAnEdgeAsTheyAre) {
    SurfaceMesh mesh = together(cube(10.0_mm), cube(10.0_mm, {10.0_mm, 10.0_mm, 0}));
    weld(mesh);
    EXPECT_EQ(mesh.vertices.size(), 14u);
    EXPECT_EQ(seen(mesh).nonmanifold_edges.count, 1u);
    expect_mended(mesh, 2.0 * cm3, "");
}
TEST(Diagnose, SeesAPinchedVertex) {
    SurfaceMesh mesh = together(cube(10.0_mm), cube(10.0_mm, {10.0_mm, 10.0_mm, 10.0_mm}));
    weld(mesh);
    EXPECT_EQ(seen(mesh).pinched_vertices.count, 1u);
    EXPECT_NEAR(seen(mesh).pinched_vertices.at.z, 5.0_mm, 1e-12);
    EXPECT_EQ(seen(mesh).nonmanifold_edges.count, 0u);
}

// ---- pieces
// -----------------------------------------------------------------------------------------------------------

TEST(Diagnose, ListsThePiecesByVolume) {
    const SurfaceDiagnosis found = seen(together(cube(1.0_mm, {20.0_mm, 0, 0}), cube(10.0_mm)));
    ASSERT_EQ(found.pieces.size(), 2u);
    EXPECT_NEAR(found.pieces[0].volume, cm3, 1e-15);
    EXPECT_NEAR(found.pieces[1].volume, 1e-9, 1e-15);
}
TEST(Repair, LeavesOutSmallPiecesOnlyWhenTold) {
    const SurfaceMesh mesh = together(cube(1.0_mm, {20.0_mm, 0, 0}), cube(10.0_mm));
    expect_mended(mesh, cm3 + 1e-9, "");
    expect_mended(mesh, cm3, "Left out 1 piece of together 1.00 mm3", {.pieces_under = 1.5e-9});
}
TEST(Repair, TurnsOnlyThePieceThatIsInsideOut) {
    expect_mended(together(cube(10.0_mm), turned(cube(10.0_mm, {20.0_mm, 0, 0}))), 2.0 * cm3,
                  "Turned 1 piece: it was inside out");
}
TEST(Repair, TakesAPieceInsideThatLooksInwardsForACavity) {
    const SurfaceMesh hollow = together(cube(10.0_mm), turned(cube(5.0_mm)));
    expect_mended(hollow, 0.875 * cm3, "1 closed cavity of together 125.0 mm3");
    expect_mended(turned(hollow), 0.875 * cm3, "Turned the whole surface");
}
TEST(Repair, AsksWhatAPieceInsideThatLooksOutwardsIs) {
    const SurfaceMesh doubtful = together(cube(10.0_mm), cube(5.0_mm));
    expect_refused(doubtful, "E0653", "repair: {inner: hollow}");
    expect_mended(doubtful, 0.875 * cm3, "made hollow", {.inner = documents::InnerPieces::hollow});
    expect_mended(doubtful, cm3, "left out", {.inner = documents::InnerPieces::solid});
}
TEST(Repair, KnowsABoneInACavityOfABone) {
    expect_mended(together(together(cube(10.0_mm), turned(cube(5.0_mm))), cube(2.0_mm)), 0.883 * cm3, "cavity");
}
TEST(Diagnose, CountsPiecesThatRunIntoOneAnother) {
    const SurfaceDiagnosis found = seen(together(cube(10.0_mm), cube(10.0_mm, {4.0_mm, 3.0_mm, 2.0_mm})));
    EXPECT_GT(found.crossings.count, 10u);
    EXPECT_EQ(found.crossings.count, found.crossing.size());
}

TEST(Repair, MakesAnySoupClosedOrRefusesIt) {
    // Few vertices, so that faces meet in all ways there are
    std::mt19937 random(3);
    int mended = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        SurfaceMesh soup = trial % 2 == 0 ? cube(10.0_mm) : SurfaceMesh{cube(10.0_mm).vertices, {}};
        for (auto n = random() % 6; n > 0; --n)
            soup.triangles.push_back({static_cast<std::uint32_t>(random() % 8),
                                      static_cast<std::uint32_t>(random() % 8),
                                      static_cast<std::uint32_t>(random() % 8)});
        for (auto n = random() % 4; n > 0 && !soup.triangles.empty(); --n)
            std::swap(soup.triangles[random() % soup.triangles.size()][0],
                      soup.triangles[random() % soup.triangles.size()][1]);
        (void)seen(soup);
        std::vector<std::string> notes;
        const RepairRules rules{trial % 3 == 0 ? 20.0_mm : 0.0, 0.0, documents::InnerPieces::hollow};
        if (const auto error = repair(soup, rules, notes)) {
            ASSERT_FALSE(error->message.empty());
            continue;
        }
        ++mended;
        for_each_edge(half_edges_of(soup),
                      [](const HalfEdge* first, const HalfEdge* last) { ASSERT_EQ(balance_of(first, last), 0); });
    }
    EXPECT_GT(mended, 50);
}

// ---- size and place
// ---------------------------------------------------------------------------------------------------

TEST(Diagnose, SuspectsTheUnitOfWhatIsNoBone) {
    // A femur of 418 mm whose file counts in something else than was said
    const auto suspected = [](double metres) { return diagnose(cube(metres), 1.0_mm).likely_unit; };
    EXPECT_EQ(suspected(418.0_mm), "");
    EXPECT_EQ(suspected(0.418_mm), "m");
    EXPECT_EQ(suspected(418.0), "um");
    EXPECT_EQ(diagnose(cube(418.0), 1.0).likely_unit, "mm");
}
TEST(Diagnose, SaysHowMuchIsLostFarFromTheOrigin) {
    EXPECT_LT(seen(cube(10.0_mm)).float_step, 1e-9);
    EXPECT_DOUBLE_EQ(seen(cube(10.0_mm, {5000.0, 0, 0})).float_step,
                     0.5_mm);  // floats between 2²² and 2²³ mm are halves
}

}  // namespace
}  // namespace kerf::bone
