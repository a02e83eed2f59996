// SPDX-License-Identifier: Apache-2.0
// Every outcome of every command by its exit code, and what it says there. 0: as wanted, 1: not passed, 2: bad input.
// What ends with 3, a fault, is in program_test.cpp.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

using test::contents_of;
using test::Ended;
using test::kerf;
using test::ran_operation;
using test::TemporaryFolder;

const std::string pedicle_screw = KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml";
const std::string coarse = " --set 'accuracy.spacing=0.5 mm'";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string written(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
    std::ofstream(folder / name, std::ios::binary) << text;
    return folder / name;
}

/// The shipped procedure with `from` replaced, beside its anatomy.
std::string changed(const TemporaryFolder& folder, const std::string& from, const std::string& to) {
    std::filesystem::copy(KERF_SOURCE_DIR "/procedures/anatomy", folder / "anatomy",
                          std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing);
    std::string text = contents_of(pedicle_screw);
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return written(folder, "changed.yaml", text.replace(at, from.size(), to));
}

/// A cube of 1 mm as STL text.
std::string cube() {
    const int corners[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    std::string text = "solid cube\n";
    for (const auto& triangle : corners) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const int corner : triangle)
            text += "vertex " + std::to_string(corner & 1) + " " + std::to_string(corner >> 1 & 1) + " " +
                    std::to_string(corner >> 2) + "\n";
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid cube\n";
}

// ---- run, rehearse -----------------------------------------------------------------------------------------------

TEST(ExitCode, OfARunIsThatOfItsVerdict) {
    const TemporaryFolder own;
    const Ended passed = ran_operation("pedicle-screw/expert", own).ended;
    EXPECT_EQ(passed.exit_code, 0) << passed.err;
    EXPECT_TRUE(has(passed.out, "verdict: pass\n")) << passed.out;

    const Ended failed = ran_operation("pedicle-screw/medial-breach", own).ended;
    EXPECT_EQ(failed.exit_code, 1) << failed.err;
    EXPECT_TRUE(has(failed.out, "verdict: fail\n")) << failed.out;

    const Ended incomplete = kerf("run " + pedicle_screw + coarse + " --set 'time_limit=1 s' --out " + (own / "short"));
    EXPECT_EQ(incomplete.exit_code, 1) << incomplete.err;
    EXPECT_TRUE(has(incomplete.out, "verdict: incomplete\n")) << incomplete.out;
}

TEST(ExitCode, OfARunThatCannotBeginIsTwo) {
    const TemporaryFolder folder;
    const std::string anatomy = "run " KERF_SOURCE_DIR "/tests/golden/W0712.yaml --anatomy " KERF_SOURCE_DIR
                                "/tests/golden/E0610.yaml --out " +
                                (folder / "run");
    const Ended no_bone = kerf(anatomy);
    EXPECT_EQ(no_bone.exit_code, 2);
    EXPECT_TRUE(has(no_bone.err, "E0610")) << no_bone.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "run"));
    EXPECT_EQ(kerf("run " + pedicle_screw + " --set 'accuracy.spacing=1 kg' --out " + (folder / "run")).exit_code, 2);
    EXPECT_EQ(kerf("run " + pedicle_screw + " --variant nobody --out " + (folder / "run")).exit_code, 2);
}

TEST(ExitCode, OfSeveralRehearsedFilesIsTheWorst) {
    const TemporaryFolder folder;
    const std::string other =
        changed(folder, "expect: pass", "expect: {fail: canal}") + coarse +
        " --patch " KERF_SOURCE_DIR "/tests/app/few-rehearsals.yaml --set "
        "rehearsals.no-starting-hole=~ --set rehearsals.backed-out=~ --set rehearsals.medial-breach=~";
    EXPECT_EQ(kerf("rehearse /nowhere.yaml " + other).exit_code, 2);
    EXPECT_EQ(kerf("rehearse " + pedicle_screw + " " + other).exit_code, 1);
}

// ---- looking at documents ----------------------------------------------------------------------------------------

TEST(ExitCode, OfValidateIgnoresWarnings) {
    const Ended warned = kerf("validate " KERF_SOURCE_DIR "/tests/golden/W0706.yaml");
    EXPECT_TRUE(has(warned.out, "W0706")) << warned.out;
    EXPECT_EQ(warned.exit_code, 0);
    EXPECT_EQ(kerf("validate " KERF_SOURCE_DIR "/tests/golden/E0701.yaml").exit_code, 2);
    EXPECT_EQ(kerf("validate " + pedicle_screw + " " KERF_SOURCE_DIR "/tests/golden/E0701.yaml").exit_code, 2);
    EXPECT_EQ(kerf("validate " KERF_SOURCE_DIR "/tests/golden/E0701.yaml " + pedicle_screw).exit_code, 2);
}

TEST(ExitCode, OfAnatomyCheckIsTwoWithAnError) {
    const std::string good = KERF_SOURCE_DIR "/procedures/anatomy/vertebra-phantom.yaml";
    const Ended checked = kerf("anatomy check " + good + " --for " + pedicle_screw);
    EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
    EXPECT_EQ(kerf("anatomy check /nowhere.yaml --for " + pedicle_screw).exit_code, 2);
    EXPECT_EQ(kerf("anatomy check " KERF_SOURCE_DIR "/tests/golden/E0610.yaml --for " KERF_SOURCE_DIR
                   "/tests/golden/W0712.yaml")
                  .exit_code,
              2);
}

TEST(ExitCode, OfPreviewNeedsAScene) {
    const TemporaryFolder folder;
    const std::string page = folder / "page.html";
    const Ended drawn = kerf("preview " + pedicle_screw + coarse + " --out " + page);
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_EQ(drawn.out, page + "\n");
    EXPECT_TRUE(std::filesystem::exists(page));
    EXPECT_EQ(kerf("preview /nowhere.yaml --out " + (folder / "other.html")).exit_code, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "other.html"));
}

TEST(ExitCode, OfWhatOnlyPrintsIsZeroOrTwo) {
    for (const char* good : {"", "list", "describe", "describe kerf.drilling", "describe kerf.sawing/oscillating_blade",
                             "explain", "explain E0412", "schema", "schema anatomy"}) {
        const Ended printed = kerf(good);
        EXPECT_EQ(printed.exit_code, 0) << good << printed.err;
        EXPECT_GT(printed.out.size(), 100u) << good;
        EXPECT_EQ(printed.err, "") << good;
    }
    EXPECT_EQ(kerf("expand " + pedicle_screw).exit_code, 0);
    for (const char* bad :
         {"describe kerf.drilling/nothing", "explain E9999", "expand /nowhere.yaml", "schema bone", "fly"}) {
        const Ended refused = kerf(bad);
        EXPECT_EQ(refused.exit_code, 2) << bad;
        EXPECT_NE(refused.err, "") << bad;
        EXPECT_EQ(refused.out, "") << bad;
    }
}

TEST(ExitCode, TheTwoSchemasAreOfTheirDocuments) {
    const std::string procedure = kerf("schema").out, anatomy = kerf("schema anatomy").out;
    EXPECT_TRUE(has(procedure, "\"steps\"")) << "of a procedure";
    EXPECT_FALSE(has(anatomy, "\"steps\""));
    EXPECT_TRUE(has(anatomy, "\"landmarks\""));
    EXPECT_EQ(kerf("schema procedure").out, procedure);
}

// ---- looking at data ---------------------------------------------------------------------------------------------

TEST(ExitCode, OfImportIsThatOfItsSource) {
    const TemporaryFolder folder;
    const std::string good = written(folder, "cube.stl", cube()), out = folder / "straight.stl";
    const Ended taken = kerf("import " + good + " --out " + out);
    EXPECT_EQ(taken.exit_code, 0) << taken.err;
    EXPECT_TRUE(has(taken.out, "not for diagnosis")) << taken.out;
    EXPECT_TRUE(std::filesystem::exists(out));

    const Ended torn =
        kerf("import " + written(folder, "torn.stl", cube().substr(0, 300)) + " --out " + (folder / "no.stl"));
    EXPECT_EQ(torn.exit_code, 2) << torn.out;
    EXPECT_NE(torn.err, "");
    EXPECT_FALSE(has(torn.out, "not for diagnosis")) << torn.out;
    EXPECT_FALSE(std::filesystem::exists(folder / "no.stl"));
    EXPECT_EQ(kerf("import /nowhere.nrrd").exit_code, 2);
    EXPECT_EQ(kerf("import " + good + " --out " + (folder / "nowhere/straight.stl")).exit_code, 2)
        << "it cannot be written there";
}

TEST(ExitCode, OfPrivacyIsThatOfTheWorstFile) {
    const TemporaryFolder folder;
    const std::string clean = written(folder, "clean.stl", cube());
    const std::string named = written(folder, "named.txt", "PatientID=4\n");
    EXPECT_EQ(kerf("privacy " + clean).exit_code, 0) << kerf("privacy " + clean).out;
    EXPECT_EQ(kerf("privacy " + named).exit_code, 1) << kerf("privacy " + named).out;
    EXPECT_EQ(kerf("privacy /nowhere.dcm").exit_code, 2);
    EXPECT_EQ(kerf("privacy " + clean + " " + named).exit_code, 1);
    EXPECT_EQ(kerf("privacy " + named + " " + clean).exit_code, 1);
    EXPECT_EQ(kerf("privacy /nowhere.dcm " + named + " " + clean).exit_code, 2);
    EXPECT_EQ(kerf("privacy " + named + " /nowhere.dcm " + clean).exit_code, 2);

    const std::string damaged = folder / "damaged.db";
    std::filesystem::copy_file(KERF_SOURCE_DIR "/tests/sessions/schema-5.db", damaged);
    std::filesystem::resize_file(damaged, 4096);
    const Ended partial = kerf("privacy " + damaged + " " + clean);
    EXPECT_EQ(partial.exit_code, 2);
    EXPECT_TRUE(has(partial.out, damaged + ": not checked to its end; in the rest: no")) << partial.out;
}

TEST(ExitCode, OfReportNeedsASession) {
    const TemporaryFolder folder;
    EXPECT_EQ(kerf("report /nowhere.db").exit_code, 2);
    EXPECT_EQ(kerf("report " + written(folder, "text.db", "no database")).exit_code, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "report.html"));
}

// ---- studies -----------------------------------------------------------------------------------------------------

TEST(ExitCode, OfPlanNeedsAProcedure) {
    EXPECT_EQ(kerf("plan /nowhere.yaml").exit_code, 2);
    EXPECT_EQ(kerf("plan " KERF_SOURCE_DIR "/tests/golden/E0701.yaml").exit_code, 2);
}

TEST(ExitCode, OfStabilityNeedsItsPlugin) {
    const TemporaryFolder folder;
    const Ended refused = kerf("stability --quick --plugin nobody --out " + (folder / "out"));
    EXPECT_EQ(refused.exit_code, 2) << refused.out;
    EXPECT_TRUE(has(refused.err, "nobody")) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(ExitCode, OfChartNeedsItsScene) {
    const TemporaryFolder folder;
    const Ended refused = kerf("chart --quick --scene nowhere --out " + (folder / "out"));
    EXPECT_EQ(refused.exit_code, 2) << refused.out;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
}  // namespace kerf::app
