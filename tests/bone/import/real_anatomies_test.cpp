// SPDX-License-Identifier: Apache-2.0
// Every scan and surface that is there becomes a bone, and every landmark lies on the bone it names.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "bone/image/scan.h"
#include "bone/import/make_body.h"
#include "documents/read_anatomy.h"
#include "kerf/units.hpp"

namespace kerf::bone {
namespace {

using namespace literals;

std::filesystem::path data() {
    const char* root = std::getenv("KERF_DATA");
    return root == nullptr ? std::filesystem::path() : std::filesystem::path(root);
}

struct RealAnatomy : testing::TestWithParam<const char*> {};

TEST_P(RealAnatomy, BecomesABoneWithItsLandmarksWhereTheySay) {
    if (!std::filesystem::exists(data() / "volumes")) GTEST_SKIP() << "KERF_DATA names no folder with volumes/.";
    text::Diagnostics diagnostics;
    const auto anatomy =
        documents::read_anatomy(std::string(KERF_SOURCE_DIR "/tests/real-data/") + GetParam()).take(diagnostics);
    ASSERT_TRUE(anatomy) << to_text(diagnostics);

    // `lies` of every point, sides and zones are checked when the bone is made.
    const auto body = make_body(*anatomy, 0.5_mm).take(diagnostics);
    ASSERT_TRUE(body) << to_text(diagnostics);
    EXPECT_FALSE(text::has_error(diagnostics)) << to_text(diagnostics);
    for (const documents::LandmarkAxis& axis : anatomy->axes) {
        check_axis(*anatomy, axis, axis_in_bone(*body, axis), diagnostics);
        EXPECT_FALSE(text::has_error(diagnostics)) << to_text(diagnostics);
    }
}

INSTANTIATE_TEST_SUITE_P(All, RealAnatomy,
                         testing::Values("l3.yaml", "t12.yaml", "mandible.yaml", "jaw.yaml", "leg.yaml",
                                         "femur-z013.yaml"));

TEST(RealScans, AllOpenAndAreRead) {
    if (!std::filesystem::exists(data() / "volumes")) GTEST_SKIP() << "KERF_DATA names no folder with volumes/.";
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(data() / "volumes")) {
        if (entry.path().extension() == ".raw") continue;
        SCOPED_TRACE(entry.path().filename().string());
        text::Diagnostics diagnostics;
        const auto scan = open_scan(entry.path().string(), {}, {}).take(diagnostics);
        ASSERT_TRUE(scan) << to_text(diagnostics);
        const auto image = scan->read(scan->grid().all(), 0, {}).take(diagnostics);
        ASSERT_TRUE(image) << to_text(diagnostics);
        EXPECT_EQ(image->values.size(), scan->grid().all().voxels());
        ++count;
    }
    EXPECT_GE(count, 8);
}

}  // namespace
}  // namespace kerf::bone
