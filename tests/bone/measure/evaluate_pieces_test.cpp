// SPDX-License-Identifier: Apache-2.0
// Measures between a bone and its turned fragment, and their uncertainties against numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "bone/measure/evaluate.h"
#include "bone/measure/mesh_surface.h"
#include "tests/bone/measure/wedge.h"

namespace kerf::bone {
namespace {

using namespace literals;
using Kind = documents::Measure::Kind;
using Made = documents::Construction::Kind;

const Pose whole_moved{{0.1, -0.2, 0.3}, quat_from_rotation_vector({0.4, -0.9, 0.5})};
const Quat turned_20_deg = quat_from_rotation_vector({20.0_deg, 0, 0});

/// A wedge of bone. What lies above z = 50 mm belongs to a fragment.
struct Pieces {
    SurfaceMesh mesh = test::wedge_mesh();
    MeshSurface surface{mesh, 0.1_mm};
    documents::Anatomy anatomy;
    std::vector<documents::Construction> constructions;
    std::vector<Pose> poses;

    Pieces() { anatomy.fracture = documents::Fracture{.at = {0, 0, 50.0_mm}, .normal = {0, 0, 1}}; }
    /// The fragment lies at `rest_from_fragment`, wherever the rest is.
    void place(const Pose& rest_from_fragment) { poses = {whole_moved, whole_moved * rest_from_fragment}; }
    documents::MeasureReading read(Kind kind, const std::string& of, const std::string& to) const {
        return evaluate({.id = "m", .kind = kind, .of = of, .to = to}, {.constructions = constructions,
                                                                        .measures = {},
                                                                        .anatomy = &anatomy,
                                                                        .world_from_body = poses,
                                                                        .surface = &surface});
    }
    double value(Kind kind, const std::string& of, const std::string& to) const {
        const documents::MeasureReading reading = read(kind, of, to);
        EXPECT_TRUE(reading.value) << reading.why_not;
        return reading.value.value_or(-1.0);
    }
    double uncertainty(Kind kind, const std::string& of, const std::string& to) const {
        return read(kind, of, to).uncertainty;
    }
};

TEST(Evaluate, APlaneTurnsWithItsFragment) {
    Pieces pieces;
    pieces.anatomy.planes = {{.id = "level", .at = {0, 0, 10.0_mm}, .normal = {0, 0, 1}},
                             {.id = "upper", .at = {0, 0, 60.0_mm}, .normal = {0, 0, 1}}};
    pieces.anatomy.points = {{.id = "origin", .at = {}}};
    pieces.place({{}, turned_20_deg});
    EXPECT_NEAR(pieces.value(Kind::angle, "level", "upper"), 20.0_deg, 1e-12);
    EXPECT_NEAR(pieces.value(Kind::distance, "origin", "upper"), 60.0_mm, 1e-12);
}

TEST(Evaluate, AnAxisTurnsWithThePieceOfItsMiddle) {
    // Given axes across the fracture, the middle of one in the fragment and that of the other in the rest
    Pieces pieces;
    pieces.anatomy.axes = {{.id = "upright", .from = {0, 0, 0}, .to = {0, 0, 10.0_mm}},
                           {.id = "upper", .from = {0, 0, 40.0_mm}, .to = {0, 0, 80.0_mm}},
                           {.id = "lower", .from = {0, 0, 60.0_mm}, .to = {0, 0, 20.0_mm}}};
    pieces.place({{}, turned_20_deg});
    EXPECT_NEAR(pieces.value(Kind::angle, "upright", "upper"), 20.0_deg, 1e-12);
    EXPECT_NEAR(pieces.value(Kind::angle, "upright", "lower"), 180.0_deg, 1e-12);
}

TEST(Evaluate, AFragmentIsWhereItLiesInTheRest) {
    Pieces pieces;
    pieces.anatomy.points = {{.id = "below", .at = {1.0_mm, 2.0_mm, 3.0_mm}}, {.id = "above", .at = {0, 0, 60.0_mm}}};
    pieces.place({{5.0_mm, 0, 0}, quat_from_rotation_vector({0, 90.0_deg, 0})});  // to {65 mm, 0, 0}
    EXPECT_NEAR(pieces.value(Kind::distance, "below", "above"), std::sqrt(64.0 * 64.0 + 4.0 + 9.0) * 1.0_mm, 1e-12);
}

// ---- uncertainties -------------------------------------------------------------------------------------------------

TEST(Evaluate, BothEndsOfAnAxisAreUncertainAlone) {
    Pieces pieces;
    pieces.anatomy.axes = {{.id = "axis", .from = {}, .to = {20.0_mm, 0, 0}, .tolerance = 1.0_mm},
                           {.id = "across", .from = {}, .to = {0, 10.0_mm, 0}}};
    pieces.anatomy.points = {{.id = "beside", .at = {10.0_mm, 8.0_mm, 0}},
                             {.id = "at_end", .at = {20.0_mm, 8.0_mm, 0}}};
    const double u = 1.0_mm / std::sqrt(3.0);
    EXPECT_NEAR(pieces.uncertainty(Kind::distance, "beside", "axis"), u / std::sqrt(2.0), 1e-6);
    EXPECT_NEAR(pieces.uncertainty(Kind::distance, "at_end", "axis"), u, 2e-6 /* it turns by 41 mrad */);
    EXPECT_NEAR(pieces.uncertainty(Kind::angle, "axis", "across"), std::sqrt(2.0) * u / 20.0_mm, 3e-5);
}

TEST(Evaluate, APlaneIsUncertainAlongItsNormal) {
    Pieces pieces;
    pieces.anatomy.planes = {{.id = "slanted", .at = {}, .normal = {0.6, 0, 0.8}, .tolerance = 1.0_mm}};
    pieces.anatomy.points = {{.id = "off", .at = {0, 0, 10.0_mm}}};
    EXPECT_NEAR(pieces.value(Kind::distance, "off", "slanted"), 8.0_mm, 1e-12);
    EXPECT_NEAR(pieces.uncertainty(Kind::distance, "off", "slanted"), 1.0_mm / std::sqrt(3.0), 1e-12);
}

/// Corners of a square of 20 mm, by turns 0.1 mm up and 0.1 mm down: the residual of their plane is 0.2 mm.
void add_uneven_square(Pieces& pieces) {
    pieces.anatomy.points = {{.id = "a", .at = {10.0_mm, 10.0_mm, 0.1_mm}},
                             {.id = "b", .at = {-10.0_mm, 10.0_mm, -0.1_mm}},
                             {.id = "c", .at = {-10.0_mm, -10.0_mm, 0.1_mm}},
                             {.id = "d", .at = {10.0_mm, -10.0_mm, -0.1_mm}},
                             {.id = "over", .at = {0, 0, 30.0_mm}}};
}

TEST(Evaluate, AFittedPlaneIsAsUncertainAsItsResidual) {
    Pieces pieces;
    add_uneven_square(pieces);
    pieces.constructions = {{.id = "plane", .kind = Made::plane, .of = {"a", "b", "c", "d"}}};
    EXPECT_NEAR(pieces.value(Kind::distance, "over", "plane"), 30.0_mm, 1e-12);
    EXPECT_NEAR(pieces.uncertainty(Kind::distance, "over", "plane"), 0.2_mm / std::sqrt(4.0), 0.001_mm);
}

TEST(Evaluate, AFittedLineIsAsUncertainAsItsResidual) {
    // Four points of a line along x, 1 mm off it by turns: the residual is 1 mm
    Pieces pieces;
    pieces.anatomy.points = {{.id = "a", .at = {-15.0_mm, 1.0_mm, 0}},
                             {.id = "b", .at = {-5.0_mm, -1.0_mm, 0}},
                             {.id = "c", .at = {5.0_mm, -1.0_mm, 0}},
                             {.id = "d", .at = {15.0_mm, 1.0_mm, 0}},
                             {.id = "over", .at = {0, 0, 30.0_mm}}};
    pieces.constructions = {{.id = "line", .kind = Made::line, .of = {"a", "b", "c", "d"}}};
    EXPECT_NEAR(pieces.value(Kind::distance, "over", "line"), 30.0_mm, 1e-12);
    EXPECT_NEAR(pieces.uncertainty(Kind::distance, "over", "line"), 1.0_mm / std::sqrt(4.0), 0.01_mm);
}

TEST(Evaluate, BothSidesOfAMirrorAreUncertainAlone) {
    // Two pairs 20 mm wide whose middles lie 1 mm to either side: the residual is √2 mm
    Pieces pieces;
    pieces.anatomy.points = {{.id = "l1", .at = {11.0_mm, 0, -15.0_mm}},
                             {.id = "r1", .at = {-9.0_mm, 0, -15.0_mm}},
                             {.id = "l2", .at = {9.0_mm, 0, 15.0_mm}},
                             {.id = "r2", .at = {-11.0_mm, 0, 15.0_mm}},
                             {.id = "beside", .at = {30.0_mm, 0, 0}}};
    pieces.constructions = {{.id = "middle", .kind = Made::mirror, .of = {"l1", "l2"}, .right = {"r1", "r2"}}};
    EXPECT_NEAR(pieces.value(Kind::distance, "beside", "middle"), 30.0_mm, 1e-12);
    EXPECT_NEAR(pieces.uncertainty(Kind::distance, "beside", "middle"), std::sqrt(2.0) * 1.0_mm / std::sqrt(4.0),
                0.01_mm);
}

TEST(Evaluate, AMiddleIsMoreCertainThanItsPoints) {
    Pieces pieces;
    pieces.anatomy.points = {{.id = "a", .at = {-10.0_mm, 0, 0}, .tolerance = 1.0_mm},
                             {.id = "b", .at = {10.0_mm, 0, 0}, .tolerance = 1.0_mm},
                             {.id = "over", .at = {0, 0, 30.0_mm}}};
    pieces.constructions = {{.id = "middle", .kind = Made::middle, .of = {"a", "b"}}};
    EXPECT_NEAR(pieces.uncertainty(Kind::distance, "over", "middle"), 1.0_mm / std::sqrt(3.0) / std::sqrt(2.0), 1e-6);
}

TEST(Evaluate, AnEntryIsLessCertainTheFlatterItsLineMeetsTheBone) {
    Pieces pieces;
    pieces.anatomy.axes = {{.id = "slanted", .from = {20.0_mm, 1.0_mm, 2.0_mm}, .to = {19.0_mm, 1.0_mm, 2.0_mm}},
                           {.id = "square", .from = {-20.0_mm, 1.0_mm, 2.0_mm}, .to = {-19.0_mm, 1.0_mm, 2.0_mm}}};
    pieces.anatomy.planes = {{.id = "face", .at = {-1.0_mm, 0, 0}, .normal = {1, 0, 0}}};
    pieces.constructions = {{.id = "on_slope", .kind = Made::entry, .of = {"slanted"}},
                            {.id = "on_face", .kind = Made::entry, .of = {"square"}}};
    EXPECT_NEAR(pieces.value(Kind::distance, "on_slope", "face"), 9.0_mm - 1.0_mm * std::tan(test::wedge_angle), 1e-12);
    EXPECT_NEAR(pieces.uncertainty(Kind::distance, "on_slope", "face"), 0.1_mm / std::cos(test::wedge_angle), 1e-12);
    EXPECT_NEAR(pieces.value(Kind::distance, "on_face", "face"), 1.0_mm, 1e-12);
    EXPECT_NEAR(pieces.uncertainty(Kind::distance, "on_face", "face"), 0.1_mm, 1e-12);
}

TEST(Evaluate, BothWallsOfAThicknessAreUncertainAlone) {
    Pieces pieces;
    pieces.anatomy.points = {{.id = "inside", .at = {1.0_mm, 0, 2.0_mm}}};
    pieces.anatomy.axes = {{.id = "across", .from = {}, .to = {1.0_mm, 0, 0}}};
    EXPECT_NEAR(pieces.value(Kind::thickness, "inside", "across"), 8.0_mm, 1e-12);
    EXPECT_NEAR(pieces.uncertainty(Kind::thickness, "inside", "across"),
                std::hypot(0.1_mm, 0.1_mm / std::cos(test::wedge_angle)), 1e-12);
}

TEST(Evaluate, ARoughnessIsAsUncertainAsItsWall) {
    // The lower face of the wedge, seen from the side
    Pieces pieces;
    pieces.anatomy.points = {{.id = "a", .at = {0, -4.0_mm, -5.0_mm}}, {.id = "b", .at = {0, 4.0_mm, -5.0_mm}}};
    pieces.anatomy.planes = {{.id = "side", .at = {}, .normal = {1, 0, 0}}};
    pieces.constructions = {
        {.id = "edge", .kind = Made::tangent, .of = {"a", "b"}, .in = "side", .side = "inferior", .within = 3.0_mm}};
    EXPECT_NEAR(pieces.value(Kind::roughness, "edge", ""), 0.0, 1e-9);
    EXPECT_NEAR(pieces.uncertainty(Kind::roughness, "edge", ""), 0.1_mm, 1e-9);
}

}  // namespace
}  // namespace kerf::bone
