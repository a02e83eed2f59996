// SPDX-License-Identifier: Apache-2.0
// `kerf anatomy make`, and made bones in procedures, as a user sees them.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

using test::contents_of;
using test::Ended;
using test::kerf;
using test::TemporaryFolder;

const std::string pedicle_screw = KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(MadeAnatomy, IsWrittenWithItsDimensions) {
    const TemporaryFolder folder;
    const std::string options = "anatomy make vertebra --level L4 --seed 7 --age 70 --set pedicle.width=9mm";
    const Ended written = kerf(options + " -o " + (folder / "made.yaml"));
    EXPECT_EQ(written.exit_code, 0) << written.err;
    EXPECT_TRUE(has(written.out, "Vertebra L4 of a ")) << written.out;
    EXPECT_TRUE(has(written.out, "pedicle.width [mm]               9 ")) << written.out;
    const std::string text = contents_of(folder / "made.yaml");
    EXPECT_TRUE(has(text, "not for diagnosis"));
    EXPECT_EQ(kerf(options).out, text) << "without a file it goes to standard output";
    EXPECT_EQ(kerf("validate " + pedicle_screw + " --anatomy " + (folder / "made.yaml")).exit_code, 0);
}

TEST(MadeAnatomy, IsDescribed) {
    const Ended described = kerf("describe vertebra/L5");
    EXPECT_EQ(described.exit_code, 0);
    EXPECT_TRUE(has(described.out, "pedicle.width")) << described.out;
    EXPECT_TRUE(has(described.out, "[recalled]"));
    const Ended unknown = kerf("describe vertebra/C3");
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_TRUE(has(unknown.err, "`L5`")) << unknown.err;
}

TEST(MadeAnatomy, RefusesWrongOptions) {
    const auto refused = [](const std::string& options, const std::string& message) {
        const Ended ended = kerf(options);
        EXPECT_EQ(ended.exit_code, 2) << options;
        EXPECT_TRUE(has(ended.err, message)) << options << "\n" << ended.err;
    };
    refused("anatomy make vertebra", "has no `level:`");
    refused("anatomy make rib --level L3", "rib");
    refused("anatomy make femur --level L3", "`proximal` or `distal`");
    refused("anatomy make mandible --level L3", "does not belong to a mandible");
    refused("anatomy make vertebra --level L3 --set pedicle.width=60mm", "set.pedicle.width is out of range");
    refused("anatomy make vertebra --level L3 --seed 1.5", "whole number");
    refused("anatomy make vertebra --level L3 --set pedicle.width=6mm --set pedicle.width=7mm", "pedicle.width");
    refused("rehearse " + pedicle_screw + " --seeds 1..2", "`--seeds` needs a bone to make");
    for (const char* seeds : {"3..1", "1..", "x", "1..100000", "-1"})
        refused("rehearse " + pedicle_screw + " --seeds " + seeds, "expected FIRST..LAST");
    refused("rehearse " + pedicle_screw + " --seeds 1..2 --cheats", "without `--cheats`");
    refused("rehearse " + pedicle_screw + " --seeds 1..2 --anatomy " + pedicle_screw, "`--anatomy` names a file");
    refused("anatomy make vertebra --level L3 --for " + pedicle_screw, "belongs to `kerf anatomy check`");
    refused("anatomy check x.yaml --seed 3 --for " + pedicle_screw, "belong to `make`");
}

TEST(MadeAnatomy, IsMadeWithinAProcedure) {
    const std::string made = " --set 'anatomy={make: vertebra, level: L2, seed: 3, set: {pedicle.width: 9 mm}}'";
    EXPECT_EQ(kerf("validate " + pedicle_screw + made).exit_code, 0);
    EXPECT_EQ(kerf("validate " + pedicle_screw + made + " --set 'anatomy.set.canal.width=24 mm'").exit_code, 0);
    const Ended contradicting =
        kerf("validate " + pedicle_screw + " --set 'anatomy={make: vertebra, level: L2, set: {pedicle.width: 3 mm}}'");
    EXPECT_EQ(contradicting.exit_code, 2);
    EXPECT_TRUE(has(contradicting.out, "`pedicle.cortex` is out of range")) << contradicting.out;
}

TEST(MadeAnatomy, RefusesAScrewWiderThanThePedicle) {
    const Ended refused = kerf("rehearse " + pedicle_screw + " --seeds 3..3 --set 'accuracy.spacing=0.5 mm' --set " +
                               "'anatomy={make: vertebra, level: L2, set: {pedicle.width: 5.5 mm}}'");
    EXPECT_EQ(refused.exit_code, 1) << "nobody passed\n" << refused.err;
    EXPECT_TRUE(has(refused.out, "       3  refused          The thread")) << refused.out;
    EXPECT_TRUE(has(refused.out, "The thread of `screw` is wider than the bone along `right_pedicle`: got 6.5 mm"))
        << refused.out;
    EXPECT_TRUE(has(refused.out, "0 passed, 0 failed, 1 refused before the run")) << refused.out;
}

}  // namespace
}  // namespace kerf::app
