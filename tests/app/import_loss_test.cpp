// SPDX-License-Identifier: Apache-2.0
// What `kerf import` reports of a written surface is what is read back.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "app/import_source.h"
#include "bone/surface/read_surface.h"
#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

/// An octahedron, `refined` times split, around a point [mm].
std::string octahedron(Vec3 centre, double radius, int refined) {
    std::vector<std::array<Vec3, 3>> faces;
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0})
            for (const double z : {-1.0, 1.0}) {
                const Vec3 a{x, 0, 0}, b{0, y, 0}, c{0, 0, z};
                if (x * y * z > 0.0)
                    faces.push_back({a, b, c});
                else
                    faces.push_back({a, c, b});
            }
    for (int i = 0; i < refined; ++i) {
        std::vector<std::array<Vec3, 3>> finer;
        for (const auto& [a, b, c] : faces) {
            const Vec3 ab = normalized(a + b), bc = normalized(b + c), ca = normalized(c + a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        faces = std::move(finer);
    }
    std::string vertices, triangles;
    int count = 0;
    const auto number = [](double value) {
        std::array<char, 40> text{};
        return std::string(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
    };
    std::vector<Vec3> known;
    for (const auto& face : faces) {
        triangles += "f";
        for (const Vec3& corner : face) {
            const Vec3 at = centre + radius * corner;
            auto same =
                std::find_if(known.begin(), known.end(), [&](Vec3 p) { return length(p - at) < 1e-9 * radius; });
            if (same == known.end()) {
                known.push_back(at);
                same = known.end() - 1;
                vertices += "v " + number(at.x) + " " + number(at.y) + " " + number(at.z) + "\n";
                ++count;
            }
            triangles += " " + std::to_string(same - known.begin() + 1);
        }
        triangles += "\n";
    }
    return vertices + triangles;
}

struct Imported {
    ImportOutcome outcome;
    double off = 0.0;       ///< [mm] largest distance of a written vertex from the nearest of the source
    double reported = 0.0;  ///< [mm]
};

Imported imported(const std::string& obj) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "bone.obj") << obj;
    Imported made;
    ImportRequest request;
    request.source = folder / "bone.obj";
    request.out = folder / "bone.stl";
    request.frame = "LPS";
    made.outcome = import_source(request);
    EXPECT_EQ(made.outcome.error, "");
    text::Diagnostics ignored;
    const auto source = bone::read_surface(folder / "bone.obj").take(ignored);
    const auto written = bone::read_surface(folder / "bone.stl").take(ignored);
    EXPECT_TRUE(source && written) << to_text(made.outcome.diagnostics);
    if (!source || !written) return made;
    for (const Vec3& v : written->mesh.vertices) {
        double nearest = HUGE_VAL;
        for (const Vec3& p : source->mesh.vertices) nearest = std::min(nearest, length(v - p));
        made.off = std::max(made.off, nearest);
    }
    const std::string all = made.outcome.text + to_text(made.outcome.diagnostics);
    for (const std::string before : {"off by up to ", "rounded by at most "})
        if (const std::size_t at = all.find(before); at != std::string::npos)
            std::from_chars(all.data() + at + before.size(), all.data() + all.size(), made.reported);
    return made;
}

bool warns(const Imported& made) {
    return std::any_of(made.outcome.diagnostics.begin(), made.outcome.diagnostics.end(), [](const text::Diagnostic& d) {
        return d.code == "W0686" && d.message.find("STL rounded the surface") != std::string::npos;
    });
}

TEST(ImportLoss, IsWhatIsReadBack) {
    for (const double far : {0.0, 1e2, 1e4, 1e6, 1e7}) {
        const Imported made = imported(octahedron({far, -far, 0.3 * far}, 10.0, 2));
        EXPECT_LE(made.off, made.reported) << far << "\n" << made.outcome.text;
        EXPECT_LE(made.reported, 2.0 * made.off + 1e-9) << far << "\n" << made.outcome.text;
        EXPECT_EQ(warns(made), made.off > 0.01) << far << "\n" << to_text(made.outcome.diagnostics);
    }
}

TEST(ImportLoss, CountsFacesThatLoseTheirArea) {
    const Imported made = imported(octahedron({2e7, 2e7, 2e7}, 3.0, 3));
    ASSERT_TRUE(warns(made)) << to_text(made.outcome.diagnostics);
    const std::string all = to_text(made.outcome.diagnostics);
    EXPECT_EQ(all.find(", and 0 of 512 faces"), std::string::npos) << all;
    EXPECT_NE(all.find(" of 512 faces have lost their area"), std::string::npos) << all;
}

TEST(ImportLoss, CountsWhatStlCannotStore) {
    std::string obj = octahedron({0, 0, 0}, 10.0, 1);
    obj = "o ball\nvn 0 0 1\nvn 0 1 0\nvt 0 0\nusemtl bone\n" + obj + "l 1 2\n";
    const Imported made = imported(obj);
    EXPECT_NE(
        made.outcome.text.find("without lines (1), names of groups (1), normals (2), texture coordinates (1), uses of "
                               "materials (1)"),
        std::string::npos)
        << made.outcome.text;
    EXPECT_EQ(imported(octahedron({0, 0, 0}, 10.0, 1)).outcome.text.find("without"), std::string::npos);
}

TEST(ImportSize, RefusesABoneLongerThanAPerson) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "bone.obj") << octahedron({0, 0, 0}, 39.25, 1);
    ImportRequest request;
    request.source = folder / "bone.obj";
    request.out = folder / "bone.stl";
    request.unit = "m";
    EXPECT_EQ(import_source(request).error.substr(0, 58), "the surface is 78.5 m long in `--unit m`, longer than a pe");
    EXPECT_FALSE(std::ifstream(request.out).is_open());
    request.unit = "mm";
    EXPECT_EQ(import_source(request).error, "");
}

}  // namespace
}  // namespace kerf::app
