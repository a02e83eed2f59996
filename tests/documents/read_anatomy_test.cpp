// SPDX-License-Identifier: Apache-2.0
#include "documents/read_anatomy.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "documents/solids.h"
#include "kerf/units.hpp"
#include "tests/documents/marked_text.h"
#include "text/codes.h"

namespace kerf::documents {
namespace {

using namespace literals;

// An anatomy without fault. Each test changes one thing.
const std::string faultless = R"(apiVersion: kerf/v1
kind: Anatomy
metadata: {id: bone, title: A bone}
phantom:
  parts:
    - {id: body, box: {centre: 0 0 0 mm, size: 40 30 20 mm}, source: A book.}
    - {id: arch, elliptic_tube: {from: 0 0 0 mm, to: 0 30 0 mm, width: 10 mm, height: 15 mm, up: 0 0 1}}
    - {id: hole, tube: {from: 0 20 -9 mm, to: 0 20 9 mm, radius: 5 mm}, subtract: true}
tissues:
  - {id: cortical, thickness: 1.5 mm, density: 1.85 g/cm3, source: A book.}
  - {id: cancellous, density: 0.25 g/cm3}
landmarks:
  points: {midline: {at: [0 mm, 2 cm, 1 mm], tolerance: 1.5 mm}}
  axes: {pedicle: {from: -20 40 0 mm, to: -10 0 0 mm, tolerance: 1.5 mm}}
zones:
  canal: [ {tube: {from: 0 20 -9 mm, to: 0 20 9 mm, radius: 5 mm}} ]
)";

void expect_refused(text::Code code, std::string_view from, std::string_view to) {
    SCOPED_TRACE(std::string(to));
    const MarkedText marked(replaced(faultless, from, to));
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read_anatomy_text("bone.yaml", marked.text).take(diagnostics));
    expect_only(code, marked, diagnostics);
}

TEST(ReadAnatomy, ReadsRegionsOfTissues) {
    text::Diagnostics diagnostics;
    std::string text =
        replaced(faultless, "{id: cortical, thickness: 1.5 mm, density: 1.85 g/cm3, source: A book.}",
                 "{id: cortical, thickness: 1.5 mm, density: 1.85 g/cm3, regions: [{part: body, thickness: "
                 "0.5 mm, over: 1 mm}]}");
    text =
        replaced(text, "density: 0.25 g/cm3}",
                 "density: 0.25 g/cm3, regions: [{solids: [{sphere: {centre: 0 0 0 mm, radius: 5 mm}}], density: 0.2 "
                 "g/cm3}]}");
    const std::optional<Anatomy> anatomy = read_anatomy_text("bone.yaml", text).take(diagnostics);
    ASSERT_TRUE(anatomy) << to_text(diagnostics);
    const TissueRegion& shell = anatomy->tissues.at(0).regions.at(0);
    EXPECT_EQ(std::get<BoxSolid>(shell.solids.at(0)).size.x, 40.0_mm);
    EXPECT_EQ(shell.thickness, 0.5_mm);
    EXPECT_EQ(shell.over, 1.0_mm);
    EXPECT_EQ(anatomy->tissues.at(1).regions.at(0).density, 200.0);
}

TEST(ReadAnatomy, RefusesRegionsThatSayNothing) {
    const std::string cortical = "{id: cortical, thickness: 1.5 mm, density: 1.85 g/cm3, source: A book.}";
    const auto with_region = [](const std::string& region) {
        return "{id: cortical, thickness: 1.5 mm, density: 1.85 g/cm3, regions: [" + region + "]}";
    };
    expect_refused(text::Code::unknown_word, cortical, with_region("{part: «bodi», thickness: 1 mm}"));
    expect_refused(text::Code::missing_key, cortical, with_region("«{»part: body}"));
    expect_refused(text::Code::degenerate, "density: 0.25 g/cm3}",
                   "density: 0.25 g/cm3, regions: [{part: body, density: 0.2 g/cm3, «thickness»: 1 mm}]}");
}

TEST(ReadAnatomy, GivesSiValues) {
    text::Diagnostics diagnostics;
    const std::optional<Anatomy> anatomy = read_anatomy_text("bone.yaml", faultless).take(diagnostics);

    ASSERT_TRUE(anatomy) << to_text(diagnostics);
    EXPECT_TRUE(diagnostics.empty()) << to_text(diagnostics);
    ASSERT_EQ(anatomy->phantom.parts.size(), 3u);
    EXPECT_TRUE(std::get<BoxSolid>(anatomy->phantom.parts[0].solid).size == (Vec3{40.0_mm, 30.0_mm, 20.0_mm}));
    EXPECT_EQ(std::get<EllipticTubeSolid>(anatomy->phantom.parts[1].solid).height, 15.0_mm);
    EXPECT_EQ(std::get<TubeSolid>(anatomy->phantom.parts[2].solid).radius, 5.0_mm);
    EXPECT_TRUE(anatomy->phantom.parts[2].subtract);
    EXPECT_EQ(anatomy->tissues.at(0).thickness, 1.5_mm);
    EXPECT_EQ(anatomy->tissues.at(1).density, 0.25_g_per_cm3);
    EXPECT_TRUE(anatomy->points.at(0).at == (Vec3{0.0, 20.0_mm, 1.0_mm}));
    EXPECT_TRUE(anatomy->axes.at(0).to == (Vec3{-(10.0_mm), 0.0, 0.0}));
    EXPECT_EQ(anatomy->zones.at(0).solids.size(), 1u);
}

TEST(ReadAnatomy, ReadsASphere) {
    text::Diagnostics diagnostics;
    const auto anatomy =
        read_anatomy_text("bone.yaml", replaced(faultless, "box: {centre: 0 0 0 mm, size: 40 30 20 mm}",
                                                "sphere: {centre: 1 2 3 mm, radius: 2 cm}"))
            .take(diagnostics);
    ASSERT_TRUE(anatomy) << to_text(diagnostics);
    const auto& sphere = std::get<SphereSolid>(anatomy->phantom.parts[0].solid);
    EXPECT_TRUE(sphere.centre == (Vec3{1.0_mm, 2.0_mm, 3.0_mm}));
    EXPECT_EQ(sphere.radius, 20.0_mm);
}

const char* const boxed = "box: {centre: 0 0 0 mm, size: 40 30 20 mm}";

TEST(ReadAnatomy, ReadsALoftWithAFilletOnBothSides) {
    text::Diagnostics diagnostics;
    const auto anatomy =
        read_anatomy_text(
            "bone.yaml",
            replaced(replaced(faultless, boxed,
                              "loft: {up: 0 -1 0, rim: 1.5 mm, sections: [{at: 1 0 -9 mm, width: 40 mm, height: 30 mm, "
                              "exponent: 2.2}, {at: 1 0 9 mm, width: 38 mm, height: 30 mm}]}"),
                     "up: 0 0 1}}", "up: 0 0 1}, blend: 3 mm, mirror: true}"))
            .take(diagnostics);
    ASSERT_TRUE(anatomy) << to_text(diagnostics);
    const auto& loft = std::get<LoftSolid>(anatomy->phantom.parts[0].solid);
    ASSERT_EQ(loft.sections.size(), 2u);
    EXPECT_EQ(loft.sections[0].exponent, 2.2);
    EXPECT_EQ(loft.sections[1].exponent, 2.0);
    EXPECT_EQ(loft.rim, 1.5_mm);
    EXPECT_FALSE(loft.path.empty());
    ASSERT_EQ(anatomy->phantom.parts.size(), 4u);
    const PhantomPart &arch = anatomy->phantom.parts[1], &other = anatomy->phantom.parts[2];
    EXPECT_EQ(arch.blend, 3.0_mm);
    EXPECT_EQ(other.blend, 3.0_mm);
    EXPECT_EQ(other.id, "arch_mirrored");
}
TEST(ReadAnatomy, MirrorsEachKindOfSolid) {
    for (const std::string solid :
         {"box: {centre: 9 1 2 mm, size: 4 3 2 mm}", "tube: {from: 9 0 0 mm, to: 3 5 6 mm, radius: 2 mm}",
          "elliptic_tube: {from: 9 0 0 mm, to: 3 5 6 mm, width: 4 mm, height: 3 mm, up: 0.5 0 1}",
          "sphere: {centre: 9 1 2 mm, radius: 3 mm}",
          "loft: {up: 0.3 0 1, sections: [{at: 9 0 0 mm, width: 4 mm, height: 3 mm}, {at: 5 3 2 mm, width: 6 mm, "
          "height: 3 mm}, {at: 1 9 2 mm, width: 2 mm, height: 3 mm}]}",
          "loft: {up: 0.3 0 1, sections: [{at: 9 0 0 mm, outline: [0 0 mm, 4 0 mm, 0 2 mm]}, {at: 5 9 2 mm, outline: "
          "[0 -1 mm, 5 0 mm, 0 3 mm]}]}"}) {
        text::Diagnostics diagnostics;
        const auto anatomy =
            read_anatomy_text("bone.yaml", replaced(faultless, boxed, solid + ", mirror: true")).take(diagnostics);
        ASSERT_TRUE(anatomy) << to_text(diagnostics);
        const Solid &one = anatomy->phantom.parts[0].solid, &other = anatomy->phantom.parts[1].solid;
        for (const Vec3 p : {Vec3{8.0_mm, 1.0_mm, 1.0_mm}, Vec3{4.0_mm, 4.0_mm, 3.0_mm}, Vec3{6.0_mm, 7.0_mm, 0.0}})
            EXPECT_NEAR(distance_to(one, p), distance_to(other, {-p.x, p.y, p.z}), 1e-12) << solid;
    }
}
TEST(ReadAnatomy, RefusesALoftWithoutShape) {
    const auto refused = [](text::Code code, const std::string& loft) { expect_refused(code, boxed, loft); };
    refused(text::Code::out_of_range, "loft: {up: 0 0 1, sections: «[»{at: 0 0 0 mm, width: 4 mm, height: 3 mm}]}");
    refused(
        text::Code::degenerate,
        "loft: {up: 0 0 1, sections: [{at: 0 0 0 mm, width: 4 mm, height: 3 mm}, «{»at: 0 0 0 mm, width: 4 mm, height: "
        "3 mm}]}");
    refused(
        text::Code::degenerate,
        "loft: {up: «0 0 1», sections: [{at: 0 0 0 mm, width: 4 mm, height: 3 mm}, {at: 0 0 9 mm, width: 4 mm, height: "
        "3 mm}]}");
    refused(text::Code::degenerate, "loft: {up: 0 0 1, sections: «[»{at: 0 0 0 mm, width: 40 mm, height: 3 mm}, {at: "
                                    "10 0 0 mm, width: 40 mm, height: "
                                    "3 mm}, {at: 10 10 0 mm, width: 40 mm, height: 3 mm}]}");
    refused(text::Code::missing_key,
            "«loft»: {sections: [{at: 0 0 0 mm, width: 4 mm, height: 3 mm}, {at: 0 0 9 mm, width: 4 "
            "mm, height: 3 mm}]}");
    refused(text::Code::out_of_range, "loft: {up: 0 1 0, sections: [{at: 0 0 0 mm, width: 4 mm, height: 3 mm, "
                                      "exponent: «0.5»}, {at: 0 0 9 mm, width: 4 "
                                      "mm, height: 3 mm}]}");
}

TEST(ReadAnatomy, RefusesALoftWithoutOutline) {
    const auto refused = [](text::Code code, const std::string& sections) {
        expect_refused(code, boxed, "loft: {up: 0 1 0, sections: " + sections + "}");
    };
    const std::string triangle = "{at: 0 0 9 mm, outline: [0 0 mm, 4 0 mm, 0 2 mm]}";
    refused(text::Code::missing_key, "[«{»at: 0 0 0 mm, width: 4 mm}, " + triangle + "]");
    refused(text::Code::one_of, "[{at: 0 0 0 mm, width: «4 mm», outline: [0 0 mm, 4 0 mm, 0 2 mm]}, " + triangle + "]");
    refused(text::Code::out_of_range, "[{at: 0 0 0 mm, outline: «[»0 0 mm, 4 0 mm]}, " + triangle + "]");
    refused(text::Code::not_a_number, "[{at: 0 0 0 mm, outline: [0 0 mm, «4 mm», 0 2 mm]}, " + triangle + "]");
    refused(text::Code::degenerate, "[{at: 0 0 0 mm, outline: «[»0 0 mm, 4 0 mm, 0 4 mm, 4 4 mm]}, " + triangle + "]");
    refused(text::Code::degenerate,
            "[{at: 0 0 0 mm, width: 4 mm, height: 3 mm}, «{»at: 0 0 9 mm, outline: [0 0 mm, 4 0 "
            "mm, 0 2 mm]}]");
    refused(text::Code::degenerate, "[" + triangle + ", «{»at: 0 0 19 mm, outline: [0 0 mm, 0 2 mm, 4 0 mm]}]");
}

TEST(ReadAnatomy, RefusesASphereWithoutRadius) {
    expect_refused(text::Code::missing_key, "box: {centre: 0 0 0 mm, size: 40 30 20 mm}",
                   "«sphere»: {centre: 1 2 3 mm}");
}
TEST(ReadAnatomy, ReadsFits) {
    text::Diagnostics diagnostics;
    std::string text =
        replaced(faultless, "1 mm], tolerance: 1.5 mm}",
                 "1 mm], fit: {sphere: {radius: 2 cm}, residual: {at_most: 0.5 mm}}, tolerance: 1.5 mm}");
    text = replaced(text, "to: -10 0 0 mm, tolerance: 1.5 mm}",
                    "to: -10 0 0 mm, fit: {neck: {head: midline, within: 8 mm}}, tolerance: 1.5 mm}");
    const auto anatomy = read_anatomy_text("bone.yaml", text).take(diagnostics);
    ASSERT_TRUE(anatomy) << to_text(diagnostics);
    ASSERT_TRUE(anatomy->points.at(0).fit && anatomy->axes.at(0).fit);
    EXPECT_EQ(anatomy->points[0].fit->radius, 20.0_mm);
    EXPECT_EQ(anatomy->points[0].fit->within, 15.0_mm);
    EXPECT_EQ(anatomy->points[0].fit->residual, 0.5_mm);
    EXPECT_EQ(anatomy->axes[0].fit->shape, LandmarkFit::Shape::neck);
    EXPECT_EQ(anatomy->axes[0].fit->reference, "midline");
    EXPECT_EQ(anatomy->axes[0].fit->within, 8.0_mm);
    EXPECT_FALSE(anatomy->axes[0].fit->residual);
}
TEST(ReadAnatomy, RefusesTwoShapesOfOneFit) {
    expect_refused(text::Code::one_of, "0 0 mm, tolerance: 1.5 mm}}",
                   "0 0 mm, fit: {tube: {radius: 9 mm}, «neck»: {head: midline}}, tolerance: 1.5 mm}}");
}
TEST(ReadAnatomy, RefusesANeckWithoutAFittedHead) {
    expect_refused(text::Code::fit_reference, "0 0 mm, tolerance: 1.5 mm}}",
                   "0 0 mm, fit: {neck: {head: «midline»}}, tolerance: 1.5 mm}}");
}
TEST(ReadAnatomy, RefusesAnUnknownShaft) {
    expect_refused(text::Code::fit_reference, "0 0 mm, tolerance: 1.5 mm}}",
                   "0 0 mm, fit: {condyles: {shaft: «femur»}}, tolerance: 1.5 mm}}");
}
TEST(ReadAnatomy, RefusesAPieceChosenByAFittedPoint) {
    text::Diagnostics diagnostics;
    std::string text =
        replaced(faultless, "1 mm], tolerance: 1.5 mm}", "1 mm], fit: {sphere: {radius: 2 cm}}, tolerance: 1.5 mm}");
    const std::size_t first = text.find("phantom:"), last = text.find("tissues:");
    text.replace(first, last - first, "ct: {image: scan.nrrd, threshold: 150, keep: {component_at: «midline»}}\n");
    const MarkedText marked(text);
    EXPECT_FALSE(read_anatomy_text("bone.yaml", marked.text).take(diagnostics));
    expect_only(text::Code::fit_reference, marked, diagnostics);
}
TEST(ReadAnatomy, RefusesFitsInACircle) {
    expect_refused(text::Code::fit_reference, "0 0 mm, tolerance: 1.5 mm}}",
                   "0 0 mm, fit: {condyles: {shaft: «pedicle»}}, tolerance: 1.5 mm}}");
}
TEST(ReadAnatomy, RefusesAProcedure) { expect_refused(text::Code::wrong_kind, "kind: Anatomy", "kind: «Procedure»"); }
TEST(ReadAnatomy, RefusesAPartOfTwoShapes) {
    expect_refused(text::Code::one_of, "20 mm}, source: A book.",
                   "20 mm}, «tube»: {from: 0 0 0 mm, to: 0 0 1 mm, radius: 1 mm}");
}
TEST(ReadAnatomy, RefusesAPartWithoutShape) {
    expect_refused(text::Code::one_of, "{id: body, box: {centre: 0 0 0 mm, size: 40 30 20 mm}, source: A book.}",
                   "«{»id: body}");
}
TEST(ReadAnatomy, RefusesTwoPartsOfOneName) { expect_refused(text::Code::duplicate_id, "id: arch", "id: «body»"); }
TEST(ReadAnatomy, RefusesTwoLandmarksOfOneName) {
    expect_refused(text::Code::duplicate_id, "{pedicle:", "{«midline»:");
}
TEST(ReadAnatomy, RefusesATubeWithoutLength) {
    expect_refused(text::Code::degenerate, "tube: {from: 0 20 -9 mm, to: 0 20 9 mm",
                   "«tube»: {from: 0 20 9 mm, to: 0 20 9 mm");
}
TEST(ReadAnatomy, RefusesAnUpThatPointsAlongTheTube) {
    expect_refused(text::Code::degenerate, "up: 0 0 1", "up: «0 1 0»");
}
TEST(ReadAnatomy, RefusesToTakeAwayFromNothing) {
    expect_refused(text::Code::degenerate, "source: A book.}\n    - {id: arch", "subtract: «true»}\n    - {id: arch");
}
TEST(ReadAnatomy, RefusesAThicknessOfTheBase) {
    expect_refused(text::Code::degenerate, "{id: cancellous,", "{id: cancellous, «thickness»: 1 mm,");
}
TEST(ReadAnatomy, RefusesTissuesInTheWrongOrderOnce) {
    const std::size_t begin = faultless.find("  - {id: cortical,"), middle = faultless.find("  - {id: cancellous,"),
                      end = faultless.find("landmarks:");
    const std::string cortical = faultless.substr(begin, middle - begin),
                      cancellous = faultless.substr(middle, end - middle);
    const MarkedText marked(faultless.substr(0, begin) + replaced(cancellous, "cancellous", "«cancellous»") + cortical +
                            faultless.substr(end));
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read_anatomy_text("bone.yaml", marked.text).take(diagnostics));
    expect_only(text::Code::degenerate, marked, diagnostics);
    EXPECT_NE(to_text(diagnostics).find("Write `cancellous` last."), std::string::npos) << to_text(diagnostics);
}
TEST(ReadAnatomy, RefusesAShellWithoutThickness) {
    expect_refused(text::Code::missing_key, "{id: cortical, thickness: 1.5 mm,", "«{»id: cortical,");
}
TEST(ReadAnatomy, GivesATissueItsSolidsAndAZoneThoseOfATissue) {
    const std::string tooth = "{tube: {from: 0 0 0 mm, to: 0 0 9 mm, radius: 2 mm}}";
    std::string text = replaced(faultless, "  - {id: cancellous,",
                                "  - {id: root, solids: [" + tooth +
                                    "], density: 2 g/cm3}\n"
                                    "  - {id: crest, solids: [" +
                                    tooth +
                                    "], thickness: 1 mm, density: 2 g/cm3}\n"
                                    "  - {id: cancellous,");
    text = replaced(text, "canal: [", "roots: [{tissue: root}]\n  canal: [");
    text::Diagnostics diagnostics;
    const std::optional<Anatomy> anatomy = read_anatomy_text("bone.yaml", text).take(diagnostics);
    ASSERT_TRUE(anatomy) << to_text(diagnostics);
    EXPECT_EQ(anatomy->tissues.at(1).thickness, 0.0);
    EXPECT_EQ(std::get<TubeSolid>(anatomy->tissues.at(1).solids.at(0)).radius, 2.0_mm);
    EXPECT_EQ(anatomy->tissues.at(2).thickness, 1.0_mm);
    EXPECT_EQ(std::get<TubeSolid>(anatomy->zones.at(0).solids.at(0)).radius, 2.0_mm);
    EXPECT_TRUE(anatomy->zones.at(0).is_tissue);
    EXPECT_FALSE(anatomy->zones.at(1).is_tissue);
}
TEST(ReadAnatomy, RefusesSolidsOfTheBase) {
    expect_refused(text::Code::degenerate, "{id: cancellous,",
                   "{id: cancellous, «solids»: [{box: {centre: 0 0 0 mm, size: 1 1 1 mm}}],");
}
TEST(ReadAnatomy, RefusesAZoneOfATissueWithoutSolids) {
    expect_refused(text::Code::unknown_word, "canal: [", "canal: [{tissue: «cortical»}, ");
}
TEST(ReadAnatomy, RefusesABoxWithoutSize) {
    expect_refused(text::Code::out_of_range, "size: 40 30 20 mm", "size: «40 0 20 mm»");
}
TEST(ReadAnatomy, RefusesBoneAsHeavyAsSteel) { expect_refused(text::Code::out_of_range, "0.25 g/cm3", "«7.8 g/cm3»"); }
TEST(ReadAnatomy, RefusesTwoNumbersForAPoint) {
    expect_refused(text::Code::not_three_numbers, "[0 mm, 2 cm, 1 mm]", "«[»0 mm, 2 cm]");
}
TEST(ReadAnatomy, RefusesAPointWithoutUnit) {
    expect_refused(text::Code::missing_unit, "from: -20 40 0 mm", "from: «-20 40 0»");
}
TEST(ReadAnatomy, RefusesALandmarkWithoutTolerance) {
    expect_refused(text::Code::missing_key, "midline: {at: [0 mm, 2 cm, 1 mm], tolerance: 1.5 mm}",
                   "«midline»: {at: [0 mm, 2 cm, 1 mm]}");
}
TEST(ReadAnatomy, RefusesOtherWordsForTrue) {
    expect_refused(text::Code::unknown_word, "subtract: true", "subtract: «yes»");
}
TEST(ReadAnatomy, RefusesAnUnknownKey) {
    expect_refused(text::Code::unknown_key, "radius: 5 mm}, sub", "radius: 5 mm, «colour»: red}, sub");
}
TEST(ReadAnatomy, RefusesMoreTissuesThanASampleCanMix) {
    const std::string shell = "  - {id: cortical, thickness: 1.5 mm, density: 1.85 g/cm3, source: A book.}\n";
    std::string five;
    for (const char* id : {"a", "b", "c", "d"}) five += replaced(shell, "cortical", id);
    expect_refused(text::Code::out_of_range, shell + "  - {", five + "  - «{»");
}

// The same out of a CT.
const std::string faultless_ct = R"(apiVersion: kerf/v1
kind: Anatomy
metadata: {id: bone, title: A bone}
ct:
  image: scans/bone.nii.gz
  labels: {file: scans/labels.nrrd, keep: [22, 23]}
  threshold: 150
  closing: 2 mm
  fill: true
  density: {at_zero: -0.1 g/cm3, per_unit: 0.001 g/cm3, floor: 0.1 g/cm3, source: A book.}
tissues:
  - {id: cortical, thickness: 1.5 mm, density: 1.85 g/cm3}
  - {id: cancellous}
landmarks: {}
)";

void expect_ct_refused(text::Code code, std::string_view from, std::string_view to) {
    SCOPED_TRACE(std::string(to));
    const MarkedText marked(replaced(faultless_ct, from, to));
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read_anatomy_text("bone.yaml", marked.text).take(diagnostics));
    expect_only(code, marked, diagnostics);
}

TEST(ReadAnatomy, GivesTheCtInSi) {
    text::Diagnostics diagnostics;
    const std::optional<Anatomy> anatomy = read_anatomy_text("bone.yaml", faultless_ct).take(diagnostics);

    ASSERT_TRUE(anatomy && anatomy->ct) << to_text(diagnostics);
    EXPECT_EQ(anatomy->ct->image, "scans/bone.nii.gz");
    EXPECT_EQ(anatomy->ct->labels, "scans/labels.nrrd");
    EXPECT_EQ(anatomy->ct->keep, (std::vector<int>{22, 23}));
    EXPECT_EQ(anatomy->ct->threshold, 150.0);
    EXPECT_EQ(anatomy->ct->closing, 2.0_mm);
    EXPECT_TRUE(anatomy->ct->fill);
    EXPECT_EQ(anatomy->ct->density.value().floor, 0.1_g_per_cm3);
}

TEST(ReadAnatomy, RefusesAnImageOutsideBothFolders) {
    for (const char* path : {"/scans/bone.nii.gz", "../bone.nii.gz", "scans/../../bone.nii.gz", "'c:bone.nii.gz'"})
        expect_ct_refused(text::Code::path_outside, "scans/bone.nii.gz", "«" + std::string(path) + "»");
}
TEST(ReadAnatomy, RefusesALabelThatIsNoWholeNumber) { expect_ct_refused(text::Code::not_a_number, "[22,", "[«22.5»,"); }
TEST(ReadAnatomy, RefusesTwoDensitiesForTheBase) {
    expect_ct_refused(text::Code::degenerate, "{id: cancellous}", "{id: cancellous, «density»: 0.25 g/cm3}");
}
TEST(ReadAnatomy, RefusesACtWithoutThreshold) {
    expect_ct_refused(
        text::Code::missing_key,
        "ct:\n  image: scans/bone.nii.gz\n  labels: {file: scans/labels.nrrd, keep: [22, 23]}\n  threshold: 150",
        "«ct»:\n  image: scans/bone.nii.gz\n  labels: {file: scans/labels.nrrd, keep: [22, 23]}");
}
TEST(ReadAnatomy, RefusesACtBesideAPhantom) {
    expect_ct_refused(text::Code::one_of,
                      "ct:", "phantom: {parts: [{id: body, box: {centre: 0 0 0 mm, size: 1 1 1 mm}}]}\n«ct»:");
}

// And out of a surface.
const std::string faultless_mesh = R"(apiVersion: kerf/v1
kind: Anatomy
metadata: {id: bone, title: A bone}
mesh:
  file: meshes/bone.stl
  unit: cm
  frame: RAS
  repair: {holes_up_to: 3 mm, pieces_under: 2 mm3, inner: solid}
  canal: {tube: {from: 0 0 0 mm, to: 0 0 10 mm, radius: 4 mm}}
  source: A book.
tissues:
  - {id: cortical, density: 1.85 g/cm3}
landmarks: {}
)";

void expect_mesh_refused(text::Code code, std::string_view from, std::string_view to) {
    SCOPED_TRACE(std::string(to));
    const MarkedText marked(replaced(faultless_mesh, from, to));
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read_anatomy_text("bone.yaml", marked.text).take(diagnostics));
    expect_only(code, marked, diagnostics);
}

TEST(ReadAnatomy, GivesTheMeshInSi) {
    text::Diagnostics diagnostics;
    const std::optional<Anatomy> anatomy = read_anatomy_text("bone.yaml", faultless_mesh).take(diagnostics);

    ASSERT_TRUE(anatomy && anatomy->mesh) << to_text(diagnostics);
    EXPECT_EQ(anatomy->mesh->file, "meshes/bone.stl");
    EXPECT_EQ(anatomy->mesh->unit, 1e-2);
    EXPECT_TRUE(anatomy->mesh->is_ras && anatomy->mesh->names_frame);
    EXPECT_EQ(anatomy->mesh->holes_up_to, 3.0_mm);
    EXPECT_DOUBLE_EQ(anatomy->mesh->pieces_under, 2e-9);
    EXPECT_EQ(anatomy->mesh->inner, InnerPieces::solid);
    EXPECT_EQ(anatomy->mesh->canal.value().radius, 4.0_mm);
}
TEST(ReadAnatomy, TakesAMeshForLpsAndSoundWhenNothingIsSaid) {
    text::Diagnostics diagnostics;
    const auto anatomy =
        read_anatomy_text("bone.yaml",
                          replaced(faultless_mesh,
                                   "  frame: RAS\n  repair: {holes_up_to: 3 mm, pieces_under: 2 mm3, inner: solid}\n  "
                                   "canal: {tube: {from: 0 0 0 mm, to: 0 0 10 mm, radius: 4 mm}}\n",
                                   ""))
            .take(diagnostics);
    ASSERT_TRUE(anatomy) << to_text(diagnostics);
    EXPECT_FALSE(anatomy->mesh->is_ras || anatomy->mesh->names_frame);
    EXPECT_EQ(anatomy->mesh->holes_up_to, 0.0);
    EXPECT_EQ(anatomy->mesh->inner, InnerPieces::unsaid);
}
TEST(ReadAnatomy, RefusesAMeshWithoutUnit) {
    expect_mesh_refused(text::Code::missing_key, "mesh:\n  file: meshes/bone.stl\n  unit: cm",
                        "«mesh»:\n  file: meshes/bone.stl");
}
TEST(ReadAnatomy, RefusesAUnitThatIsNone) { expect_mesh_refused(text::Code::unknown_word, "unit: cm", "unit: «inch»"); }
TEST(ReadAnatomy, RefusesAFrameThatIsNone) {
    expect_mesh_refused(text::Code::unknown_word, "frame: RAS", "frame: «LAS»");
}
TEST(ReadAnatomy, RefusesToCloseAWholeSection) {
    expect_mesh_refused(text::Code::out_of_range, "holes_up_to: 3 mm", "holes_up_to: «30 mm»");
}
TEST(ReadAnatomy, RefusesAMeshOutsideBothFolders) {
    expect_mesh_refused(text::Code::path_outside, "meshes/bone.stl", "«../bone.stl»");
}
TEST(ReadAnatomy, RefusesAMeshBesideAPhantom) {
    expect_mesh_refused(text::Code::one_of,
                        "mesh:", "phantom: {parts: [{id: body, box: {centre: 0 0 0 mm, size: 1 1 1 mm}}]}\n«mesh»:");
}

}  // namespace
}  // namespace kerf::documents
