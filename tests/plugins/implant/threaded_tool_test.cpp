// SPDX-License-Identifier: Apache-2.0
// The tools of the plugin: what they are made of, and what cannot be made.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "tests/plugins/implant/screw_rig.h"

namespace kerf {
namespace {

using namespace literals;

TEST(ThreadedTool, OfEachKindSaysWhatItIs) {
    struct Wanted {
        const char* id;
        bool stays;
        double radius, lead, seat;
    };
    for (const Wanted& wanted : {Wanted{"pedicle_screw", true, 3.25_mm, 2.75_mm, 45.0_mm},
                                 {"bone_screw", true, 2.25_mm, 1.75_mm, 36.0_mm},
                                 {"dental_implant", true, 2.05_mm, 0.8_mm, 10.0_mm},
                                 {"tap", false, 2.75_mm, 2.75_mm, 40.0_mm}}) {
        const ToolOutline outline = test::outline(test::threaded(wanted.id));
        EXPECT_EQ(outline.is_implant(), wanted.stays) << wanted.id;
        EXPECT_DOUBLE_EQ(outline.thread_radius, wanted.radius) << wanted.id;
        EXPECT_DOUBLE_EQ(outline.thread_lead, wanted.lead) << wanted.id;
        EXPECT_NEAR(-outline.cutting.end_z(), wanted.seat, 1e-9) << wanted.id;
    }
}

TEST(ThreadedTool, OfACancellousScrewHasAShaftWithoutThread) {
    const ToolOutline outline = test::outline(test::threaded("bone_screw", {{"outer_diameter", 6.5_mm},
                                                                            {"thread_length", 16.0_mm},
                                                                            {"shaft_length", 34.0_mm},
                                                                            {"shaft_diameter", 4.5_mm}}));
    EXPECT_NEAR(-outline.cutting.end_z(), 50.0_mm, 1e-9);
    EXPECT_NEAR(-outline.crest.end_z(), 16.0_mm, 1e-9) << "its thread ends where the shaft begins";
    EXPECT_NEAR(outline.cutting.distance({2.25_mm, 0, -30.0_mm}), 0.0, 1e-9);
}

TEST(ThreadedTool, RefusesWhatCannotBeMade) {
    const auto refusal = [](const char* tool, const std::map<std::string, double>& set) {
        ToolOutline outline;
        std::string error;
        return outline_of(test::threaded(tool, set), outline, error) ? std::string() : error;
    };
    const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
    EXPECT_EQ(refusal("pedicle_screw", {}), "");
    EXPECT_TRUE(has(refusal("pedicle_screw", {{"core_diameter", 7.0_mm}}),
                    "`core_diameter` is 7 mm; it needs less than `outer_diameter`"));
    EXPECT_TRUE(has(refusal("pedicle_screw", {{"tip_core_diameter", 5.0_mm}}), "`tip_core_diameter` is 5 mm"));
    EXPECT_TRUE(has(refusal("pedicle_screw", {{"head_diameter", 6.0_mm}}), "could not seat"));
    EXPECT_TRUE(has(refusal("pedicle_screw", {{"thread_length", 7.0_mm}}), "two turns"));
    EXPECT_TRUE(has(refusal("dental_implant", {{"outer_taper", 3.0_mm}}), "`outer_taper` is 3 mm; it needs less than"));
    EXPECT_TRUE(has(refusal("bone_screw", {{"shaft_diameter", 6.0_mm}}), "`shaft_diameter` is 6 mm"));
    EXPECT_EQ(refusal("tap", {}), "") << "a tap has no head";
}

}  // namespace
}  // namespace kerf
