// SPDX-License-Identifier: Apache-2.0
#include "bone/import/make_body.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "kerf/units.hpp"

namespace kerf::bone {
namespace {

using namespace literals;

documents::Anatomy shelled_block() {
    documents::Anatomy anatomy;
    anatomy.id = "block";
    anatomy.phantom.parts = {{"block", documents::BoxSolid{{0, 0, 0}, {20.0_mm, 20.0_mm, 20.0_mm}}, false, ""}};
    anatomy.tissues = {{"cortical", 1850.0, 2.0_mm, ""}, {"cancellous", 250.0, 0.0, ""}};
    return anatomy;
}

TEST(MakeBody, TellsHowFarItIsWithEachOfItsParts) {
    // Given someone who listens
    std::map<std::string, std::vector<double>> told;
    std::vector<std::string> parts;
    ImportOptions options;
    options.progress = [&](double share, const std::string& what) {
        if (parts.empty() || parts.back() != what) parts.push_back(what);
        told[what].push_back(share);
    };

    // When a bone of two tissues is made
    text::Diagnostics diagnostics;
    ASSERT_TRUE(make_body(shelled_block(), 0.5_mm, nullptr, options).take(diagnostics)) << to_text(diagnostics);

    // Then each part was told in its turn, from near its start to near its end, and begun anew once at most
    EXPECT_EQ(parts, (std::vector<std::string>{"distances to its surface and tissues"}));
    for (const auto& [part, shares] : told) {
        int times_begun = 1;
        for (std::size_t i = 1; i < shares.size(); ++i) times_begun += shares[i] < shares[i - 1];
        EXPECT_LE(times_begun, 2) << part;
        EXPECT_LT(shares.front(), 0.2) << part;
        EXPECT_GT(shares.back(), 0.8) << part;
        EXPECT_LE(shares.back(), 1.0) << part;
    }
}

TEST(MakeBody, PutsATissueWhereItsSolidsAre) {
    // Given a rod of root in the block, and a cortex under the half of its top that is at positive x
    documents::Anatomy anatomy = shelled_block();
    anatomy.tissues = {
        {"root", 2100.0, 0.0, "", {documents::TubeSolid{{0, 0, -20.0_mm}, {0, 0, 20.0_mm}, 3.0_mm}}},
        {"cortical", 1850.0, 2.0_mm, "", {documents::BoxSolid{{10.0_mm, 0, 0}, {20.0_mm, 40.0_mm, 40.0_mm}}}},
        {"cancellous", 250.0, 0.0, ""}};
    text::Diagnostics diagnostics;
    ImportReport report;
    const auto body = make_body(anatomy, 0.5_mm, &report).take(diagnostics);
    ASSERT_TRUE(body) << to_text(diagnostics);
    const auto is_in = [&](std::size_t tissue, Vec3 at) {
        return body->materials[tissue].border.at(locate(*body, at)) < 0.0;
    };
    EXPECT_TRUE(is_in(0, {2.5_mm, 0, 0}));
    EXPECT_FALSE(is_in(0, {3.5_mm, 0, 0}));
    EXPECT_TRUE(is_in(1, {6.0_mm, 0, 8.5_mm}));
    EXPECT_FALSE(is_in(1, {6.0_mm, 0, 7.5_mm})) << "below the shell";
    EXPECT_FALSE(is_in(1, {-6.0_mm, 0, 8.5_mm})) << "beside its solid";
    EXPECT_NE(report.notes.at(1).find("within 1 solid;"), std::string::npos) << report.notes.at(1);
}

TEST(MakeBody, MakesShellAndDensityByRegion) {
    // Given a block whose shell is thin, and whose inside is light, where x is positive
    documents::Anatomy anatomy = shelled_block();
    const documents::Solid half = documents::BoxSolid{{20.0_mm, 0, 0}, {40.0_mm, 80.0_mm, 80.0_mm}};
    anatomy.tissues[0].regions = {{{half}, 1.0_mm, 0.5_mm, 0.0}};
    anatomy.tissues[1].regions = {{{half}, 1.0_mm, 0.0, 150.0}};
    text::Diagnostics diagnostics;
    ImportReport report;
    const auto body = make_body(anatomy, 0.25_mm, &report).take(diagnostics);
    ASSERT_TRUE(body) << to_text(diagnostics);
    const auto to_border = [&](Vec3 at) { return body->materials[0].border.at(locate(*body, at)); };
    const auto density = [&](Vec3 at) { return body->materials[1].densities.at(locate(*body, at), -1.0); };
    for (const double x : {3.0_mm, 6.0_mm}) {
        EXPECT_NEAR(to_border({x, 0, 9.2_mm}), 0.3_mm, 0.02_mm) << "0.8 mm deep, under a shell of 0.5 mm";
        EXPECT_NEAR(to_border({-x, 0, 8.2_mm}), -0.2_mm, 0.02_mm) << "1.8 mm deep, in a shell of 2 mm";
        EXPECT_NEAR(density({x, 0, 0}), 150.0, 0.01);
        EXPECT_NEAR(density({-x, 0, 0}), 250.0, 0.01);
    }
    EXPECT_NEAR(density({-0.5_mm, 0, 0}), 200.0, 2.0) << "half way";
    EXPECT_DOUBLE_EQ(body->materials[1].density, 250.0) << "the largest, which limits are checked with";
    EXPECT_NE(report.notes.at(1).find("0.50 to 2.00 mm"), std::string::npos) << report.notes.at(1);
    EXPECT_NE(report.notes.at(2).find("density by place"), std::string::npos) << report.notes.at(2);
}

}  // namespace
}  // namespace kerf::bone
