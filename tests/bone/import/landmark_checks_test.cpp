// SPDX-License-Identifier: Apache-2.0
#include "bone/import/landmark_checks.h"

#include <gtest/gtest.h>

#include <string>

#include "bone/import/make_body.h"
#include "kerf/units.hpp"

namespace kerf::bone {
namespace {

using namespace literals;

/// A block of 20 mm around the origin.
documents::Anatomy block() {
    documents::Anatomy anatomy;
    anatomy.file = "bone.yaml";
    anatomy.phantom.parts = {{"block", documents::BoxSolid{{}, {20.0_mm, 20.0_mm, 20.0_mm}}, false, ""}};
    anatomy.tissues = {{"bone", 1850.0, 0.0, ""}};
    return anatomy;
}

std::string findings_of(const documents::Anatomy& anatomy) {
    text::Diagnostics diagnostics;
    const auto body = make_body(anatomy, 0.5_mm).take(diagnostics);
    std::string codes;
    for (const text::Diagnostic& d : diagnostics) codes += (codes.empty() ? "" : " ") + d.code;
    return codes;
}

TEST(LandmarkChecks, FindSidesThatAreSwapped) {
    using Lies = documents::LandmarkPoint::Lies;
    const auto pair = [](const char* left, const char* right, double left_x) {
        documents::Anatomy anatomy = block();
        anatomy.points = {{left, {left_x, 0, 0}, 1.0_mm, Lies::anywhere},
                          {right, {-left_x, 0, 0}, 1.0_mm, Lies::anywhere}};
        return findings_of(anatomy);
    };
    EXPECT_EQ(pair("left_pedicle", "right_pedicle", 15.0_mm), "");
    EXPECT_EQ(pair("left_pedicle", "right_pedicle", -15.0_mm), "E0612");
    EXPECT_EQ(pair("entry-left", "entry-right", -15.0_mm), "E0612");
    EXPECT_EQ(pair("leftover", "rightover", -15.0_mm), "") << "no sides";
    EXPECT_EQ(pair("a", "b", -15.0_mm), "");
}

TEST(LandmarkChecks, HoldPointsToWhatIsKnownOfThem) {
    using Lies = documents::LandmarkPoint::Lies;
    const auto at = [](double x, Lies lies) {
        documents::Anatomy anatomy = block();
        anatomy.points = {{"p", {x, 0, 0}, 1.0_mm, lies}};
        return findings_of(anatomy);
    };
    EXPECT_EQ(at(10.5_mm, Lies::on_bone), "");
    EXPECT_EQ(at(12.0_mm, Lies::on_bone), "E0613");
    EXPECT_EQ(at(5.0_mm, Lies::on_bone), "E0613");
    EXPECT_EQ(at(5.0_mm, Lies::in_bone), "");
    EXPECT_EQ(at(11.5_mm, Lies::in_bone), "E0613");
    EXPECT_EQ(at(9.5_mm, Lies::off_bone), "");
    EXPECT_EQ(at(8.5_mm, Lies::off_bone), "E0613");
}

TEST(LandmarkChecks, DoubtAZoneThatIsMostlyBone) {
    const auto zone = [](double x) {
        documents::Anatomy anatomy = block();
        anatomy.zones = {{"canal", {documents::TubeSolid{{x, 0, -(8.0_mm)}, {x, 0, 8.0_mm}, 3.0_mm}}}};
        return findings_of(anatomy);
    };
    EXPECT_EQ(zone(20.0_mm), "");
    EXPECT_EQ(zone(0.0), "W0614");
    const documents::Anatomy half = [] {
        documents::Anatomy anatomy = block();
        anatomy.zones = {{"canal", {documents::BoxSolid{{10.0_mm, 0, 0}, {8.0_mm, 8.0_mm, 8.0_mm}}}}};
        return anatomy;
    }();
    text::Diagnostics diagnostics;
    const auto body = make_body(half, 0.5_mm).take(diagnostics);
    EXPECT_NEAR(fraction_in_bone(*body, half.zones[0]), 0.5, 0.07 /* points 1 mm apart */);
}

}  // namespace
}  // namespace kerf::bone
