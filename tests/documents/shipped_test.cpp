// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "documents/check_needs.h"
#include "documents/read_anatomy.h"
#include "documents/read_procedure.h"
#include "kerf/units.hpp"
#include "tests/documents/catalog.h"

/// The procedures and anatomies that come with Kerf.
namespace kerf::documents {
namespace {

using namespace literals;

const std::string procedure_file = KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml";
const std::string anatomy_file = KERF_SOURCE_DIR "/procedures/anatomy/vertebra-phantom.yaml";

std::string text_of(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

Procedure shipped_procedure() {
    text::Diagnostics diagnostics;
    std::optional<Procedure> procedure = read_procedure(procedure_file, spine_catalog()).take(diagnostics);
    EXPECT_TRUE(procedure && diagnostics.empty()) << to_text(diagnostics);
    return procedure.value_or(Procedure{});
}

Anatomy shipped_anatomy(const std::string& file = anatomy_file) {
    text::Diagnostics diagnostics;
    std::optional<Anatomy> anatomy = read_anatomy(file).take(diagnostics);
    EXPECT_TRUE(anatomy && diagnostics.empty()) << to_text(diagnostics);
    return anatomy.value_or(Anatomy{});
}

// ---- the plainest possible geometry, to check the phantom by

double distance_along(const Vec3& from, const Vec3& to, Vec3 point) {
    const double along = dot(point - from, normalized(to - from));
    return std::max(-along, along - length(to - from));
}

Vec3 across(const Vec3& from, const Vec3& to, Vec3 point) {
    const Vec3 axis = normalized(to - from);
    return (point - from) - dot(point - from, axis) * axis;
}

/// Negative inside. Outside it is at most the true distance [m]; for a tube without its caps it is exact.
double distance(const Solid& solid, Vec3 p) {
    if (const auto* box = std::get_if<BoxSolid>(&solid)) {
        const Vec3 d = p - box->centre;
        return std::max(
            {std::abs(d.x) - box->size.x / 2, std::abs(d.y) - box->size.y / 2, std::abs(d.z) - box->size.z / 2});
    }
    if (const auto* tube = std::get_if<TubeSolid>(&solid))
        return std::max(length(across(tube->from, tube->to, p)) - tube->radius,
                        distance_along(tube->from, tube->to, p));
    const auto& tube = std::get<EllipticTubeSolid>(solid);
    const Vec3 axis = normalized(tube.to - tube.from);
    const Vec3 side = normalized(cross(axis, tube.up));
    const Vec3 up = cross(side, axis);
    const Vec3 d = across(tube.from, tube.to, p);
    const double a = tube.width / 2, b = tube.height / 2;
    const double radial = std::hypot(dot(d, side) / a, dot(d, up) / b) - 1.0;
    return std::max(radial * std::min(a, b), distance_along(tube.from, tube.to, p));
}

bool in_bone(const Anatomy& anatomy, Vec3 p) {
    bool is_bone = false;
    for (const PhantomPart& part : anatomy.phantom.parts)
        if (distance(part.solid, p) < 0.0) is_bone = !part.subtract;
    return is_bone;
}

double distance_to_zone(const Zone& zone, Vec3 p) {
    double nearest = 1.0;
    for (const Solid& solid : zone.solids) nearest = std::min(nearest, distance(solid, p));
    return nearest;
}

/// Depth of the first bone along the axis, from the axis's origin [m].
double entry_depth(const Anatomy& anatomy, const LandmarkAxis& axis) {
    const Vec3 along = normalized(axis.to - axis.from);
    double depth = 0.0;
    while (depth < 0.1 && !in_bone(anatomy, axis.from + depth * along)) depth += 0.01_mm;
    return depth;
}

constexpr double drill_radius = 1.6_mm;

/// Smallest distance of a drill's flank to the zone, down to 35 mm [m], for an axis shifted towards the midline.
double flank_clearance(const Anatomy& anatomy, const LandmarkAxis& axis, double medial_shift) {
    const Vec3 along = normalized(axis.to - axis.from);
    const Vec3 to_midline = normalized(across(axis.from, axis.to, anatomy.points.at(0).at));
    const double entry = entry_depth(anatomy, axis);
    double clearance = 1.0;
    for (double depth = -5.0_mm; depth <= 35.0_mm; depth += 0.05_mm)
        clearance = std::min(clearance, distance_to_zone(anatomy.zones.at(0), axis.from + (entry + depth) * along +
                                                                                  medial_shift * to_midline));
    return clearance - drill_radius;
}

// ---- the tests

TEST(Shipped, ProcedureMeetsItsAnatomy) {
    const Procedure procedure = shipped_procedure();
    text::Diagnostics diagnostics;
    const std::optional<Anatomy> anatomy = read_anatomy(procedure.anatomy_file).take(diagnostics);
    ASSERT_TRUE(anatomy) << to_text(diagnostics);
    check_needs(procedure, *anatomy, diagnostics);
    EXPECT_TRUE(diagnostics.empty()) << to_text(diagnostics);
}

TEST(Shipped, ProcedureOpensWithWhatItIsNotFor) {
    EXPECT_TRUE(text_of(procedure_file)
                    .starts_with("# For training and research; not for diagnosis, planning or deciding treatment\n"));
}

TEST(Shipped, BlunderIsTheExpertsHoleShiftedAndNothingElse) {
    const Procedure procedure = shipped_procedure();
    const std::vector<Waypoint>& expert = procedure.rehearsals.at(0).path;
    ASSERT_EQ(procedure.rehearsals.at(2).id, "medial-breach");
    const std::vector<Waypoint>& blunder = procedure.rehearsals.at(2).path;
    ASSERT_LT(blunder.size(), expert.size()) << "it inserts no screw";
    EXPECT_NE(expert[blunder.size()].step, expert[0].step) << "it drills all of the hole";
    for (std::size_t i = 0; i < blunder.size(); ++i) {
        EXPECT_EQ(expert[i].depth, blunder[i].depth);
        EXPECT_EQ(blunder[i].medial, 5.0_mm);
    }
}

const std::string anatomies = KERF_SOURCE_DIR "/procedures/anatomy/";

/// A phantom of a vertebra that the procedure runs on.
struct Vertebra {
    const char* id;
    std::string file;
    double breach;       ///< [m] so far to the side the drill goes into the canal
    double medial_wall;  ///< [m] from the middle, level with the canal's widest

    friend void PrintTo(const Vertebra& vertebra, std::ostream* out) { *out << vertebra.id; }
};

class Phantom : public testing::TestWithParam<Vertebra> {};

TEST_P(Phantom, EveryPlannedAxisStartsEightToTenMillimetresOutsideTheBone) {
    const Anatomy anatomy = shipped_anatomy(GetParam().file);
    for (const LandmarkAxis& axis : anatomy.axes) {
        EXPECT_GT(entry_depth(anatomy, axis), 8.0_mm) << axis.id;
        EXPECT_LT(entry_depth(anatomy, axis), 10.0_mm) << axis.id;
    }
}

TEST_P(Phantom, PlannedDrillLiesInBoneWithItsWholeFlankDownTo35Millimetres) {
    const Anatomy anatomy = shipped_anatomy(GetParam().file);
    for (const LandmarkAxis& axis : anatomy.axes) {
        const Vec3 along = normalized(axis.to - axis.from);
        const Vec3 side = normalized(cross(along, {0, 0, 1}));
        const Vec3 up = cross(side, along);
        const double entry = entry_depth(anatomy, axis);
        int samples_in_air = 0;
        for (double depth = 1.0_mm /* below the slanted entry */; depth <= 35.0_mm; depth += 0.05_mm)
            for (double turn = 0.0; turn < 2.0 * pi; turn += 0.2) {
                const Vec3 flank = drill_radius * (std::cos(turn) * side + std::sin(turn) * up);
                samples_in_air += !in_bone(anatomy, axis.from + (entry + depth) * along + flank);
                samples_in_air += !in_bone(anatomy, axis.from + (entry + depth) * along);
            }
        EXPECT_EQ(samples_in_air, 0) << axis.id;
    }
}

TEST_P(Phantom, PlannedDrillClearsTheCanalAndABreachCutsIntoIt) {
    const Anatomy anatomy = shipped_anatomy(GetParam().file);
    for (const LandmarkAxis& axis : anatomy.axes) {
        EXPECT_GT(flank_clearance(anatomy, axis, 0.0), 2.5_mm) << axis.id;
        EXPECT_LT(flank_clearance(anatomy, axis, GetParam().breach), -(1.0_mm)) << axis.id;
    }
}

TEST_P(Phantom, CanalIsEmptyAndItsWallTowardsThePedicleIsBone) {
    const Anatomy anatomy = shipped_anatomy(GetParam().file);
    int bone_in_canal = 0, samples = 0;
    for (double x = -12.0_mm; x <= 12.0_mm; x += 0.2_mm)
        for (double y = 17.0_mm; y <= 35.0_mm; y += 0.2_mm) {
            const bool is_canal = distance_to_zone(anatomy.zones.at(0), {x, y, 5.0_mm}) < 0.0;
            samples += is_canal;
            bone_in_canal += is_canal && in_bone(anatomy, {x, y, 5.0_mm});
        }
    EXPECT_GT(samples, 1000);
    EXPECT_EQ(bone_in_canal, 0);
    for (const double side : {-1.0, 1.0})
        EXPECT_TRUE(in_bone(anatomy, {side * GetParam().medial_wall, 22.0_mm, 5.0_mm}));
}

TEST_P(Phantom, HasAllThatTheProcedureNeeds) {
    text::Diagnostics diagnostics;
    check_needs(shipped_procedure(), shipped_anatomy(GetParam().file), diagnostics);
    EXPECT_TRUE(diagnostics.empty()) << to_text(diagnostics);
}

INSTANTIATE_TEST_SUITE_P(Shipped, Phantom,
                         testing::Values(Vertebra{"l3", anatomy_file, 5.0_mm, 12.0_mm},
                                         Vertebra{"l4", anatomies + "vertebra-l4-phantom.yaml", 6.3_mm, 12.8_mm}),
                         [](const auto& one) { return one.param.id; });

// ---- bad input: whatever happens to a file on its way, reading it ends in a value or in an error that has a place

void expect_answer(const std::string& text, int& refused) {
    text::Diagnostics diagnostics;
    std::optional<Procedure> procedure;
    ASSERT_NO_THROW(procedure = read_procedure_text("damaged.yaml", text, spine_catalog()).take(diagnostics));
    ASSERT_EQ(procedure.has_value(), !text::has_error(diagnostics)) << to_text(diagnostics);
    ASSERT_NO_THROW((void)to_text(diagnostics));
    refused += !procedure;
}

TEST(DamagedProcedure, CutOffAnywhereIsAnsweredWithoutAThrow) {
    const std::string whole = text_of(procedure_file);
    int refused = 0;
    for (std::size_t size = 0; size < whole.size(); ++size) expect_answer(whole.substr(0, size), refused);
    EXPECT_GT(refused, static_cast<int>(whole.size() / 2));
}

TEST(DamagedProcedure, WithAnyByteChangedIsAnsweredWithoutAThrow) {
    const std::string whole = text_of(procedure_file);
    int refused = 0;
    for (std::size_t at = 0; at < whole.size();
         ++at) {  // one damage a byte, in turns: each reading takes a millisecond
        const char damages[]{'\0', '\n', '"', '[', '\x80', static_cast<char>(whole[at] ^ 1)};
        std::string damaged = whole;
        damaged[at] = damages[(at + at / std::size(damages)) % std::size(damages)];
        expect_answer(damaged, refused);
    }
    EXPECT_GT(refused, static_cast<int>(whole.size() / 6));
}

TEST(DamagedAnatomy, CutOffAnywhereIsAnsweredWithoutAThrow) {
    const std::string whole = text_of(anatomy_file);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        text::Diagnostics diagnostics;
        std::optional<Anatomy> anatomy;
        ASSERT_NO_THROW(anatomy = read_anatomy_text("damaged.yaml", whole.substr(0, size)).take(diagnostics));
        ASSERT_EQ(anatomy.has_value(), !text::has_error(diagnostics));
    }
}

TEST(HostileDocument, OfOneMegabyteIsAnsweredWithoutAThrow) {
    const std::string header = "apiVersion: kerf/v1\nkind: Procedure\n";
    for (const char* piece :
         {"[", "{a: ", "- ", "a:\n", "[a, ", "\"", "&a ", "*a ", "a: b: ", "? ", "!a ", "---\n", "%TAG\n"}) {
        std::string text = header;
        while (text.size() + 8 < (1u << 20)) text += piece;
        int refused = 0;
        expect_answer(text, refused);
        EXPECT_EQ(refused, 1) << piece;
    }
}

}  // namespace
}  // namespace kerf::documents
