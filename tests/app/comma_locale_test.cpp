// SPDX-License-Identifier: Apache-2.0
// Numbers have a point, whatever locale a library in the process has set.
#include <gtest/gtest.h>

#include <clocale>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "app/standard_streams.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

/// Returns a text without the lines about how long a plugin took: they differ with the load of the machine.
std::string without_times(const std::string& text) {
    std::istringstream lines(text);
    std::string rest;
    for (std::string line; std::getline(lines, line);)
        if (line.find("longer than its budget") == std::string::npos) rest += line + "\n";
    return rest;
}

/// A locale with a decimal comma, made in a folder of its own.
struct CommaLocale : testing::Test {
    void SetUp() override {
        const test::Ended made = test::shell("localedef --no-archive -i de_DE -f UTF-8 " + (folder / "de_DE.UTF-8"));
        if (made.exit_code != 0) GTEST_SKIP() << "no localedef, or no source of de_DE (Debian: locales)";
        environment = "LOCPATH=" + folder.path() + " LD_PRELOAD=" KERF_SETS_LOCALE " KERF_SETS_LOCALE=de_DE.UTF-8";
#ifdef __SANITIZE_ADDRESS__
        GTEST_SKIP() << "the sanitizer must be the first library";
#endif
    }

    /// Expects the same output and files with the library as without.
    void expect_same(const std::string& arguments, const std::string& file = "") {
        SCOPED_TRACE(arguments);
        const test::Ended plain = test::kerf(arguments);
        const std::string written = file.empty() ? "" : test::contents_of(file);
        const test::Ended comma = test::kerf(arguments, environment);
        EXPECT_EQ(comma.exit_code, plain.exit_code);
        EXPECT_EQ(comma.out, plain.out);
        EXPECT_EQ(without_times(comma.err), without_times(plain.err));
        EXPECT_NE(plain.out.size() + plain.err.size(), 0u);
        if (!file.empty()) {
            EXPECT_EQ(test::contents_of(file), written);
            EXPECT_NE(written, "");
        }
    }

    test::TemporaryFolder folder;
    std::string environment;
};

TEST_F(CommaLocale, ChangesNoOutputOfAProgram) {
    const std::string golden = KERF_SOURCE_DIR "/tests/golden/", out = folder / "out";
    std::ofstream(folder / "cube.obj") << "v 0 0 0\nv 20.5 0 0\nv 0 20.5 0\nv 0 0 20.5\n"
                                          "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    expect_same("validate " + golden + "hole.yaml --bone");
    expect_same("expand " + golden + "hole.yaml --set 'accuracy.spacing=0.75 mm'");
    expect_same("run " + golden + "hole.yaml --out " + out, out + "/summary.json");
    expect_same("report " + out, out + "/report.html");
    expect_same("import " + (folder / "cube.obj") + " --out " + (folder / "cube.stl"), folder / "cube.stl");
    expect_same("anatomy make vertebra --level L3 --seed 3 --set pedicle.width=7.5mm --out " + (folder / "l3.yaml"),
                folder / "l3.yaml");
    expect_same("describe kerf.drilling");
    expect_same("validate " + golden + "E0412.yaml");
}

TEST_F(CommaLocale, ChangesNoTextOfTheLibrary) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    setenv("LOCPATH", folder.path().c_str(), 1);
    const bool is_set = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
    char own[16] = "";
    std::snprintf(own, sizeof own, "%.1f", 0.5);
    const std::string text = formatted("%.2f %g", 5.85, 0.25);
    std::setlocale(LC_ALL, before.c_str());
    unsetenv("LOCPATH");
    ASSERT_TRUE(is_set);
    EXPECT_STREQ(own, "0,5");
    EXPECT_EQ(text, "5.85 0.25");
}

}  // namespace
}  // namespace kerf::app
