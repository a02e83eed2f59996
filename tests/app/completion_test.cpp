// SPDX-License-Identifier: Apache-2.0
// Each shell runs the script that `kerf completion` prints for it.
#include "app/completion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "app/command_table.h"
#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

using Words = std::vector<std::string>;

std::string quoted(const std::string& word) { return "'" + word + "'"; }

/// A folder with two documents, a page and a folder, in which bash completes.
class BashCompletion : public testing::Test {
protected:
    void SetUp() override {
        for (const char* name : {"a.yaml", "b c.yaml", "page.html", "plain.so"}) std::ofstream(folder_ / name) << "x";
        std::filesystem::create_directory(folder_ / "out");
        std::ofstream(script_ / "kerf") << completion_script("bash");
    }

    /// Returns what bash offers for the last of these words, sorted.
    [[nodiscard]] Words offered(const Words& words) const {
        std::string line =
            "cd " + quoted(folder_ / "") + " && source " + quoted(script_ / "kerf") + " && COMP_WORDS=(kerf";
        for (const std::string& word : words) line += " " + quoted(word);
        line += ") COMP_CWORD=" + std::to_string(words.size()) + " && _kerf; printf \"%s\\n\" \"${COMPREPLY[@]}\"";
        std::ofstream(script_ / "run") << "set -u\n" << line << "\n";
        const std::string command = "bash --norc " + quoted(script_ / "run") + " > " + quoted(script_ / "offered") +
                                    " 2> " + quoted(script_ / "errors");
        EXPECT_EQ(std::system(command.c_str()), 0) << test::contents_of(script_ / "errors");
        EXPECT_EQ(test::contents_of(script_ / "errors"), "");
        Words all;
        std::istringstream lines(test::contents_of(script_ / "offered"));
        for (std::string word; std::getline(lines, word);)
            if (!word.empty()) all.push_back(word);
        std::sort(all.begin(), all.end());
        return all;
    }

    const test::TemporaryFolder folder_, script_;
};

TEST_F(BashCompletion, OffersEveryCommand) {
    Words names;
    for (const Command& command : command_table()) names.push_back(command.name);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(offered({""}), names);
    EXPECT_EQ(offered({"help", ""}), names);
    EXPECT_EQ(offered({"va"}), Words{"validate"});
}

TEST_F(BashCompletion, OffersEveryOptionOfACommand) {
    for (const Command& command : command_table()) {
        Words names{"--help"};
        for (const Parameter& option : command.options) names.push_back(option.name);
        std::sort(names.begin(), names.end());
        EXPECT_EQ(offered({command.name, "-"}), names) << command.name;
    }
    EXPECT_EQ(offered({"-"}), (Words{"--help", "--version"}));
}

TEST_F(BashCompletion, OffersWords) {
    for (const Command& command : command_table())
        for (const Parameter& option : command.options) {
            if (option.value.kind != ValueKind::words) continue;
            Words words = option.value.words;
            std::sort(words.begin(), words.end());
            EXPECT_EQ(offered({command.name, option.name, ""}), words) << command.name << option.name;
        }
    EXPECT_EQ(offered({"run", "--mode", "e"}), Words{"exam"});
    EXPECT_EQ(offered({"schema", ""}), (Words{"anatomy", "procedure", "station"}));
    EXPECT_EQ(offered({"anatomy", ""}), (Words{"check", "make"}));
    EXPECT_EQ(offered({"new", ""}), (Words{"plugin", "procedure"}));
    EXPECT_EQ(offered({"completion", ""}), (Words{"bash", "fish", "zsh"}));
    EXPECT_EQ(offered({"check", "--level", ""}), (Words{"1", "2", "3", "4", "5"}));
}

TEST_F(BashCompletion, OffersFilesByEndingAndFolders) {
    EXPECT_EQ(offered({"run", ""}), (Words{"a.yaml", "b c.yaml", "out"}));
    EXPECT_EQ(offered({"run", "--hand", "expert", "a"}), Words{"a.yaml"});
    EXPECT_EQ(offered({"run", "a.yaml", "--out", ""}), Words{"out"});
    EXPECT_EQ(offered({"run", "a.yaml", "-o", "o"}), Words{"out"});
    EXPECT_EQ(offered({"run", "a.yaml", "--out", "=", "o"}), Words{"out"});
    EXPECT_EQ(offered({"run", "a.yaml", "--out", "="}), Words{"out"});
    EXPECT_EQ(offered({"anatomy", "check", "a"}), Words{"a.yaml"});
    EXPECT_EQ(offered({"validate", "a.yaml", "b"}), Words{"b c.yaml"});
    EXPECT_EQ(offered({"privacy", "p"}), (Words{"page.html", "plain.so"}));
}

TEST_F(BashCompletion, OffersNothingWithoutAChoice) {
    EXPECT_EQ(offered({"run", "a.yaml", ""}), Words{});
    EXPECT_EQ(offered({"run", "--variant", ""}), Words{});
    EXPECT_EQ(offered({"list", ""}), Words{});
    EXPECT_EQ(offered({"fly", ""}), Words{});
}

/// Checks a script by its own shell, without running it.
void expect_no_syntax_error(const std::string& shell) {
    if (std::system(("command -v " + shell + " > /dev/null").c_str()) != 0)
        GTEST_SKIP() << shell << " is not installed";
    const test::TemporaryFolder folder;
    std::ofstream(folder / "script") << completion_script(shell);
    EXPECT_EQ(std::system((shell + " -n " + (folder / "script")).c_str()), 0);
}

TEST(ZshCompletion, HasNoSyntaxError) { expect_no_syntax_error("zsh"); }

TEST(FishCompletion, HasNoSyntaxError) { expect_no_syntax_error("fish"); }

TEST(Completion, EveryScriptHasEveryCommandAndOption) {
    const std::string zsh = completion_script("zsh"), fish = completion_script("fish");
    for (const Command& command : command_table()) {
        EXPECT_NE(zsh.find("        '" + command.name + ":"), std::string::npos) << command.name;
        EXPECT_NE(zsh.find("                " + command.name + ")\n"), std::string::npos) << command.name;
        EXPECT_NE(fish.find("-n __fish_use_subcommand -a " + command.name + " "), std::string::npos) << command.name;
        for (const Parameter& option : command.options) {
            EXPECT_NE(zsh.find(option.name + "["), std::string::npos) << option.name;
            EXPECT_NE(fish.find("'__fish_seen_subcommand_from " + command.name + "' -l " + option.name.substr(2)),
                      std::string::npos)
                << command.name << " " << option.name;
        }
    }
}

}  // namespace
}  // namespace kerf::app
