// SPDX-License-Identifier: Apache-2.0
// Lines and planes of 3D Slicer in both frames, in each form of a plane.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <string>

#include "bone/import/markups.h"
#include "kerf/units.hpp"
#include "tests/support/temporary_folder.h"

namespace kerf::bone {
namespace {

using namespace literals;

struct MarkupFrames : testing::Test {
    test::TemporaryFolder folder;

    documents::Anatomy read(const std::string& markups) {
        std::ofstream(folder / "a.mrk.json") << R"({"@schema": "x", "markups": [)" + markups + "]}";
        documents::Anatomy anatomy;
        anatomy.file = folder / "bone.yaml";
        anatomy.markups = {{"a.mrk.json", 1.5_mm, {}}};
        text::Diagnostics diagnostics;
        add_markups(anatomy, diagnostics);
        EXPECT_TRUE(diagnostics.empty()) << to_text(diagnostics);
        return anatomy;
    }
    /// A vector [mm] of LPS, written in a frame.
    static std::string written(const std::string& frame, std::array<int, 3> lps) {
        const int sign = frame == "RAS" ? -1 : 1;
        return '[' + std::to_string(sign * lps[0]) + ", " + std::to_string(sign * lps[1]) + ", " +
               std::to_string(lps[2]) + ']';
    }
    static std::string point(const std::string& frame, const std::string& label, std::array<int, 3> lps) {
        return R"({"label": ")" + label + R"(", "position": )" + written(frame, lps) + '}';
    }
    static std::string markup(const std::string& frame, const std::string& type, const std::string& more,
                              const std::string& points) {
        return R"({"type": ")" + type + R"(", "coordinateSystem": ")" + frame + R"(", )" + more +
               R"("controlPoints": [)" + points + "]}";
    }
    static void expect_near(Vec3 is, Vec3 wanted) {
        EXPECT_NEAR(is.x, wanted.x, 1e-12);
        EXPECT_NEAR(is.y, wanted.y, 1e-12);
        EXPECT_NEAR(is.z, wanted.z, 1e-12);
    }
};

TEST_F(MarkupFrames, GiveALineTheSameEndsInTheSameOrder) {
    for (const std::string frame : {"LPS", "RAS"}) {
        const documents::Anatomy anatomy = read(markup(
            frame, "Line", "", point(frame, "entry", {10, 20, 30}) + ", " + point(frame, "target", {11, 22, -33})));
        ASSERT_EQ(anatomy.axes.size(), 1u);
        EXPECT_EQ(anatomy.axes[0].id, "entry");
        expect_near(anatomy.axes[0].from, {10.0_mm, 20.0_mm, 30.0_mm});
        expect_near(anatomy.axes[0].to, {11.0_mm, 22.0_mm, -33.0_mm});
        EXPECT_EQ(anatomy.axes[0].tolerance, 1.5_mm);
    }
}

TEST_F(MarkupFrames, GiveAPlaneTheSameNormalInEachForm) {
    const Vec3 at{10.0_mm, 20.0_mm, 30.0_mm}, normal{2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0};
    for (const std::string frame : {"LPS", "RAS"}) {
        const std::string along = R"("normal": )" + written(frame, {2, -1, 2}) + ", ";
        // Across (2, −1, 2): (1, 2, 0) × (−2, 0, 2) = 2 (2, −1, 2)
        const std::string three = point(frame, "cut", {10, 20, 30}) + ", " + point(frame, "q", {11, 22, 30}) + ", " +
                                  point(frame, "r", {8, 20, 32});
        for (const std::string& form :
             {markup(frame, "Plane", R"("name": "cut", "center": )" + written(frame, {10, 20, 30}) + ", " + along, ""),
              markup(frame, "Plane", R"("name": "cut", "origin": )" + written(frame, {10, 20, 30}) + ", " + along, ""),
              markup(frame, "Plane", "", three)}) {
            SCOPED_TRACE(form);
            const documents::Anatomy anatomy = read(form);
            ASSERT_EQ(anatomy.planes.size(), 1u);
            EXPECT_EQ(anatomy.planes[0].id, "cut");
            expect_near(anatomy.planes[0].at, at);
            expect_near(anatomy.planes[0].normal, normal);
            EXPECT_EQ(anatomy.planes[0].tolerance, 1.5_mm);
        }
    }
}

TEST_F(MarkupFrames, BelongToEachMarkupOfAFile) {
    const documents::Anatomy anatomy = read(markup("RAS", "Fiducial", "", point("RAS", "one", {1, 2, 3})) + ", " +
                                            markup("LPS", "Fiducial", "", point("LPS", "two", {4, 5, 6})) + ", " +
                                            markup("RAS", "Fiducial", "", point("RAS", "three", {7, 8, 9})));
    ASSERT_EQ(anatomy.points.size(), 3u);
    expect_near(anatomy.points[0].at, {1.0_mm, 2.0_mm, 3.0_mm});
    expect_near(anatomy.points[1].at, {4.0_mm, 5.0_mm, 6.0_mm});
    expect_near(anatomy.points[2].at, {7.0_mm, 8.0_mm, 9.0_mm});
}

}  // namespace
}  // namespace kerf::bone
