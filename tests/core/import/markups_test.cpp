// SPDX-License-Identifier: Apache-2.0
#include "core/import/markups.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "kerf/units.hpp"
#include "tests/support/temporary_folder.h"

namespace kerf {
namespace {

using namespace literals;

struct Markups : testing::Test {
    test::TemporaryFolder folder;
    Diagnostics diagnostics;
    std::map<std::string, std::string> names;

    Anatomy read(const std::string& name, const std::string& text) {
        std::ofstream(folder / name) << text;
        Anatomy anatomy;
        anatomy.file = folder / "bone.yaml";
        anatomy.markups = {{name, 1.5_mm, names}};
        diagnostics.clear();
        add_markups(anatomy, diagnostics);
        return anatomy;
    }
    void expect_refused(const std::string& code, const std::string& words, const std::string& name,
                        const std::string& text) {
        SCOPED_TRACE(text);
        const Anatomy anatomy = read(name, text);
        EXPECT_TRUE(anatomy.points.empty() && anatomy.axes.empty() && anatomy.planes.empty());
        ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
        EXPECT_EQ(diagnostics[0].code, code) << to_text(diagnostics);
        EXPECT_NE(diagnostics[0].message.find(words), std::string::npos) << to_text(diagnostics);
    }
    static std::string json(const std::string& type, const std::string& frame, const std::string& points,
                            const std::string& more = "") {
        return R"({"@schema": "x", "markups": [{"type": ")" + type + R"(", "coordinateSystem": ")" + frame +
               R"(", "coordinateUnits": "mm", )" + more + R"("controlPoints": [)" + points + "]}]}";
    }
    static std::string point(const std::string& label, const std::string& place) {
        return R"({"label": ")" + label + R"(", "position": [)" + place + R"(], "positionStatus": "defined"})";
    }
};

TEST_F(Markups, GiveTheSamePlaceFromEitherFrame) {
    for (const std::string frame : {"LPS", "RAS"}) {
        const std::string place = frame == "LPS" ? "10, 20, 30" : "-10, -20, 30";
        const Anatomy anatomy = read("a.mrk.json", json("Fiducial", frame, point("entry", place)));
        ASSERT_EQ(anatomy.points.size(), 1u) << to_text(diagnostics);
        EXPECT_EQ(anatomy.points[0].id, "entry");
        EXPECT_NEAR(length(anatomy.points[0].at - Vec3{10.0_mm, 20.0_mm, 30.0_mm}), 0.0, 1e-12);
        EXPECT_EQ(anatomy.points[0].tolerance, 1.5_mm);
    }
}

TEST_F(Markups, MakeALineAnAxisAndAPlaneAPlane) {
    const Anatomy line =
        read("a.mrk.json", json("Line", "RAS", point("way-1", "1, 2, 3") + "," + point("way-2", "1, 2, 13")));
    ASSERT_EQ(line.axes.size(), 1u) << to_text(diagnostics);
    EXPECT_EQ(line.axes[0].id, "way-1");
    EXPECT_NEAR(length(line.axes[0].to - Vec3{-(1.0_mm), -(2.0_mm), 13.0_mm}), 0.0, 1e-12);

    const Anatomy plane = read("a.mrk.json", json("Plane", "RAS", point("cut-1", "0, 0, 5"),
                                                  R"("name": "cut", "center": [0, 0, 5], "normal": [0, 2, 0], )"));
    ASSERT_EQ(plane.planes.size(), 1u) << to_text(diagnostics);
    EXPECT_EQ(plane.planes[0].id, "cut");
    EXPECT_NEAR(length(plane.planes[0].normal - Vec3{0, -1, 0}), 0.0, 1e-12);
    EXPECT_NEAR(plane.planes[0].at.z, 5.0_mm, 1e-12);

    const Anatomy three =
        read("a.mrk.json",
             json("Plane", "LPS", point("p", "0, 0, 5") + "," + point("q", "10, 0, 5") + "," + point("r", "0, 10, 5")));
    ASSERT_EQ(three.planes.size(), 1u) << to_text(diagnostics);
    EXPECT_NEAR(length(three.planes[0].normal - Vec3{0, 0, 1}), 0.0, 1e-12);
}

TEST_F(Markups, ReadTheOlderForm) {
    const std::string lines =
        "# columns = "
        "id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n1,-1.5,2,3,0,0,0,1,1,1,0,tip,,,2,0\n";
    for (const std::string frame : {"RAS", "0"}) {
        const Anatomy anatomy =
            read("a.fcsv", "# Markups fiducial file version = 5.6\n# CoordinateSystem = " + frame + "\n" + lines);
        ASSERT_EQ(anatomy.points.size(), 1u) << to_text(diagnostics);
        EXPECT_NEAR(length(anatomy.points[0].at - Vec3{1.5_mm, -(2.0_mm), 3.0_mm}), 0.0, 1e-12);
    }
    expect_refused("E0681", "does not say its coordinate system", "a.fcsv", lines);
    expect_refused("E0681", "must be LPS or RAS", "a.fcsv", "# CoordinateSystem = IJK\n" + lines);
    expect_refused("E0680", "must be a number", "a.fcsv",
                   "# CoordinateSystem = LPS\n1,\"1,5\",2,3,0,0,0,1,1,1,0,tip\n");
    expect_refused("E0680", "no column", "a.fcsv", "# CoordinateSystem = LPS\n1,2,3,4\n");
}

TEST_F(Markups, NeverGuessAndNeverRepeat) {
    expect_refused("E0681", "coordinateSystem", "a.mrk.json",
                   R"({"markups": [{"type": "Fiducial", "controlPoints": []}]})");
    std::string metres = json("Fiducial", "LPS", point("a", "1, 2, 3"));
    metres.replace(metres.find("\"mm\""), 4, "\"m\"");
    expect_refused("E0681", "must be mm", "a.mrk.json", metres);
    expect_refused("E0682", "no place", "a.mrk.json",
                   json("Fiducial", "LPS", R"({"label": "a", "positionStatus": "undefined"})"));
    expect_refused("E0682", "`ROI`", "a.mrk.json", json("ROI", "LPS", ""));
    expect_refused("E0682", "two points", "a.mrk.json", json("Line", "LPS", point("a", "1, 2, 3")));
    expect_refused("E0682", "no normal", "a.mrk.json", json("Plane", "LPS", point("a", "1, 2, 3")));
    expect_refused("E0682", "2 m away", "a.mrk.json", json("Fiducial", "LPS", point("a", "1e9, 2, 3")));
    expect_refused("E0683", "no id", "a.mrk.json", json("Fiducial", "LPS", point("L entry", "1, 2, 3")));
    expect_refused("E0683", "two landmarks", "a.mrk.json",
                   json("Fiducial", "LPS", point("a", "1, 2, 3") + "," + point("a", "1, 2, 4")));
    expect_refused("E0680", "no list `markups`", "a.mrk.json", "{}");
    expect_refused("E0680", "no list `markups`", "a.mrk.json", "{\"markups\": ");
    expect_refused("E0680", "ending", "a.txt", "{}");
}

TEST_F(Markups, TakeOtherNames) {
    names = {{"L entry", "left_entry"}};
    const Anatomy anatomy = read("a.mrk.json", json("Fiducial", "LPS", point("L entry", "1, 2, 3")));
    ASSERT_EQ(anatomy.points.size(), 1u) << to_text(diagnostics);
    EXPECT_EQ(anatomy.points[0].id, "left_entry");
}

TEST_F(Markups, ReadRealOnes) {
    const char* root = std::getenv("KERF_DATA");
    const std::string name = "meshes/femur_proximal_telfer_landmarks.fcsv";
    if (root == nullptr || !std::filesystem::exists(std::filesystem::path(root) / name)) GTEST_SKIP() << "no KERF_DATA";
    Anatomy anatomy;
    anatomy.file = folder / "bone.yaml";
    anatomy.markups = {{name, 1.5_mm, {}}};
    add_markups(anatomy, diagnostics);
    ASSERT_EQ(anatomy.points.size(), 6u) << to_text(diagnostics);
    EXPECT_EQ(anatomy.points[0].id, "LESSER_TROCH");
    EXPECT_NEAR(anatomy.points[0].at.z, -187.91_mm, 0.01_mm);
}

}  // namespace
}  // namespace kerf
