// SPDX-License-Identifier: Apache-2.0
#include "bone/import/break_bone.h"

#include <gtest/gtest.h>

#include <string>

#include "bone/import/make_body.h"
#include "core/field/cut/removed_volume.h"
#include "kerf/units.hpp"

namespace kerf::bone {
namespace {

using namespace literals;

documents::Anatomy rod(const documents::Fracture& fracture) {
    documents::Anatomy anatomy;
    anatomy.id = "rod";
    anatomy.phantom.parts = {{"rod", documents::BoxSolid{{0, 0, 0}, {20.0_mm, 20.0_mm, 60.0_mm}}, false, ""}};
    anatomy.tissues = {{"cortical", 1850.0, 3.0_mm, ""}, {"cancellous", 250.0, 0.0, ""}};
    anatomy.fracture = fracture;
    return anatomy;
}

double volume_of(const Body& body) { return bone_volume(body, CutField(body, 0)); }

TEST(BreakBone, PartsItAtThePlaneAndLosesTheGap) {
    const documents::Anatomy anatomy = rod({.at = {0, 0, 10.0_mm}, .normal = {0, 0, 1}, .gap = 1.0_mm});
    text::Diagnostics diagnostics;
    ImportReport report;
    auto body = make_body(anatomy, 0.5_mm).take(diagnostics);
    ASSERT_TRUE(body);
    const double whole = volume_of(*body);
    const auto fragment = break_bone(*body, anatomy, report).take(diagnostics);
    ASSERT_TRUE(fragment) << to_text(diagnostics);
    const double section = 20.0_mm * 20.0_mm;
    EXPECT_NEAR(volume_of(*fragment), section * 19.5_mm, 0.01 * section * 19.5_mm);
    EXPECT_NEAR(volume_of(*body), section * 39.5_mm, 0.01 * section * 39.5_mm);
    EXPECT_NEAR(whole - volume_of(*body) - volume_of(*fragment), section * 1.0_mm, 0.05 * section * 1.0_mm);
}

TEST(BreakBone, HasNoNewCortexAtTheBreak) {
    const documents::Anatomy anatomy = rod({.at = {0, 0, 10.0_mm}, .normal = {0, 0, 1}});
    text::Diagnostics diagnostics;
    ImportReport report;
    auto body = make_body(anatomy, 0.5_mm).take(diagnostics);
    const auto fragment = break_bone(*body, anatomy, report).take(diagnostics);
    ASSERT_TRUE(fragment);
    const auto is_cortical = [&](Vec3 at) { return fragment->materials[0].border.at(locate(*fragment, at)) < 0.0; };
    EXPECT_FALSE(is_cortical({0, 0, 11.0_mm})) << "the middle of the break";
    EXPECT_TRUE(is_cortical({8.5_mm, 0, 11.0_mm})) << "its rim";
    EXPECT_TRUE(is_cortical({0, 0, 28.5_mm})) << "the far end";
}

TEST(BreakBone, NotesWhereTheFragmentLiesAndWarnsOfItInTheRest) {
    for (const double shift : {5.0_mm, -5.0_mm}) {
        const documents::Anatomy anatomy = rod({.at = {0, 0, 10.0_mm}, .normal = {0, 0, 1}, .shift = {0, 0, shift}});
        text::Diagnostics diagnostics;
        ImportReport report;
        auto body = make_body(anatomy, 0.5_mm).take(diagnostics);
        ASSERT_TRUE(break_bone(*body, anatomy, report).take(diagnostics));
        ASSERT_EQ(report.notes.size(), 1u);
        EXPECT_NE(report.notes[0].find("lies 5.0 mm from its place"), std::string::npos) << report.notes[0];
        EXPECT_EQ(diagnostics.size(), shift < 0.0 ? 1u : 0u) << to_text(diagnostics);
    }
}

TEST(BreakBone, IsRefusedWhereOneSideHasNoBone) {
    const documents::Anatomy anatomy = rod({.at = {0, 0, 31.0_mm}, .normal = {0, 0, 1}});
    text::Diagnostics diagnostics;
    ImportReport report;
    auto body = make_body(anatomy, 0.5_mm).take(diagnostics);
    const double whole = volume_of(*body);
    EXPECT_FALSE(break_bone(*body, anatomy, report).take(diagnostics));
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, "E0605");
    EXPECT_EQ(volume_of(*body), whole) << "it stays whole";
}

}  // namespace
}  // namespace kerf::bone
