// SPDX-License-Identifier: Apache-2.0
#include "text/shell.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>

#include "text/printable.h"

namespace kerf::text {
namespace {

/// Returns what bash passes to a program for a word of a command line.
std::string read_by_bash(const std::string& word) {
    const std::string script = "printf '%s' " + word;
    std::string quoted;
    for (const char c : script) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    FILE* pipe = popen(("bash -c '" + quoted + "'").c_str(), "r");
    if (pipe == nullptr) return "no bash";
    std::string read;
    std::array<char, 256> some{};
    for (std::size_t n = 0; (n = std::fread(some.data(), 1, some.size(), pipe)) > 0;) read.append(some.data(), n);
    pclose(pipe);
    return read;
}

TEST(ShellWord, ShellReadsItBack) {
    for (const std::string word : {"plain/path-1_2.yaml",
                                   "my tools",
                                   "it's",
                                   "a\"b",
                                   "$HOME",
                                   "`date`",
                                   "$(date)",
                                   "a;b",
                                   "*",
                                   "a\\b",
                                   "x'y z'",
                                   "!1",
                                   "#c",
                                   "~",
                                   "a&b",
                                   "(c)",
                                   "knöchern",
                                   "日本",
                                   "",
                                   "line\nbreak",
                                   "tab\t",
                                   "esc\x1b[31m",
                                   "bytes\xff\xfe",
                                   "it's\x07",
                                   "\u202eevil"}) {
        EXPECT_EQ(read_by_bash(shell_quoted(word)), word) << shell_quoted(word);
        EXPECT_EQ(printable(shell_quoted(word)), shell_quoted(word)) << "a terminal shows it as it is";
    }
}

TEST(ShellWord, LeavesPlainWordsAsTheyAre) {
    EXPECT_EQ(shell_quoted("procedures/pedicle-screw.yaml"), "procedures/pedicle-screw.yaml");
    EXPECT_EQ(shell_quoted("my tools"), "'my tools'");
}

TEST(ShellPath, IsNoOption) {
    EXPECT_EQ(shell_path("-rf"), "./-rf");
    EXPECT_EQ(shell_path("- x"), "'./- x'");
    EXPECT_EQ(shell_path("a-b"), "a-b");
}

}  // namespace
}  // namespace kerf::text
