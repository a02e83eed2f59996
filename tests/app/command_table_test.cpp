// SPDX-License-Identifier: Apache-2.0
// Help, man page, completion and docs/commands.md have each command and each option of the table.
#include "app/command_table.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <set>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "app/command_line.h"
#include "app/man_page.h"
#include "session/recorder.h"
#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

CommandLine read(std::vector<std::string> words) {
    std::vector<const char*> pointers{"kerf"};
    for (const std::string& word : words) pointers.push_back(word.c_str());
    return read_command_line(static_cast<int>(pointers.size()), pointers.data());
}

std::string help_of(const Command& command) { return read({command.name, "--help"}).answer; }

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// As roff writes it.
std::string dashed(const std::string& text) {
    std::string out;
    for (const char c : text) out += c == '-' ? std::string("\\-") : std::string(1, c);
    return out;
}

TEST(CommandTable, NamesAreUnique) {
    std::set<std::string> names;
    for (const Command& command : command_table()) {
        EXPECT_TRUE(names.insert(command.name).second) << command.name;
        std::set<std::string> options{"--help", "-h"};
        for (const Parameter& option : command.options) {
            EXPECT_TRUE(option.is_option()) << command.name << " " << option.name;
            EXPECT_TRUE(options.insert(option.name).second) << command.name << " " << option.name;
            if (option.short_name.empty()) continue;
            EXPECT_TRUE(options.insert(option.short_name).second) << option.short_name;
        }
        EXPECT_EQ(find_command(command.name), &command);
    }
    EXPECT_EQ(find_command("fly"), nullptr);
}

TEST(CommandTable, GeneralHelpHasEveryCommand) {
    const std::string help = read({"--help"}).answer;
    for (const Command& command : command_table()) {
        EXPECT_TRUE(has(help, "\n  " + command.name + " ")) << command.name;
        EXPECT_TRUE(has(help, command.summary + "\n")) << command.name;
        EXPECT_TRUE(has(help, "\n" + command.group + ":\n")) << command.group;
    }
}

TEST(CommandTable, HelpHasEveryParameter) {
    for (const Command& command : command_table()) {
        const std::string help = help_of(command);
        EXPECT_TRUE(has(help, "Usage: kerf " + command.name)) << help;
        EXPECT_TRUE(has(help, session::notice_line)) << help;
        EXPECT_TRUE(has(help, command.footer)) << help;
        for (const auto* parameters : {&command.arguments, &command.options})
            for (const Parameter& parameter : *parameters) {
                EXPECT_TRUE(has(help, parameter.name)) << command.name << " " << parameter.name;
                EXPECT_TRUE(has(help, " " + help_text(parameter) + "\n")) << command.name << " " << parameter.name;
            }
        for (const Example& example : command.examples) EXPECT_TRUE(has(help, "  " + example.line + "\n")) << help;
    }
}

TEST(CommandTable, HelpNamesWordsAndDefaults) {
    for (const Command& command : command_table())
        for (const auto* parameters : {&command.arguments, &command.options})
            for (const Parameter& parameter : *parameters) {
                const std::string help = help_text(parameter);
                for (const std::string& word : parameter.value.words) EXPECT_TRUE(has(help, word)) << help;
                Options defaults = command.defaults;
                const Member member = parameter.member(defaults);
                std::string value;
                if (const auto* number = std::get_if<int*>(&member)) value = std::to_string(**number);
                if (const auto* text = std::get_if<std::string*>(&member)) value = **text;
                EXPECT_TRUE(value.empty() || value == parameter.default_value) << help;
                EXPECT_EQ(parameter.default_value.empty(), !has(help, "default")) << help;
            }
}

TEST(CommandTable, ExamplesAreRight) {
    std::size_t count = 0;
    for (const Command& command : command_table())
        for (const Example& example : command.examples) {
            std::istringstream line(example.line);
            std::vector<std::string> words;
            for (std::string word; line >> std::quoted(word);) words.push_back(word);
            ASSERT_EQ(words.front(), "kerf");
            words.erase(words.begin());
            const CommandLine read_line = read(words);
            EXPECT_EQ(read_line.answer, "") << example.line;
            EXPECT_EQ(read_line.command, &command) << example.line;
            ++count;
        }
    EXPECT_GT(count, 15u);
}

TEST(CommandTable, EveryRowRunsAFunction) {
    for (const Command& command : command_table()) {
        EXPECT_TRUE(static_cast<bool>(command.run)) << command.name;
        bool needs_something = false;
        for (const auto* parameters : {&command.arguments, &command.options})
            for (const Parameter& parameter : *parameters) needs_something |= parameter.is_required;
        EXPECT_EQ(needs_something, !command.when_missing.empty()) << command.name;
    }
}

TEST(ManPage, HasEveryCommandAndOption) {
    const std::string page = man_page();
    for (const Command& command : command_table()) {
        EXPECT_TRUE(has(page, "\n.SS \\fBkerf " + command.name + "\\fR\n")) << command.name;
        for (const Parameter& option : command.options)
            EXPECT_TRUE(has(page, "\\fB" + dashed(option.name) + "\\fR")) << option.name;
    }
    EXPECT_TRUE(has(page, std::string("\n") + session::notice_line + ".\n"));
    EXPECT_TRUE(has(page, "\n.TH KERF 1 "));
}

TEST(ManPage, IsAscii) {
    for (const char c : man_page())
        ASSERT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << static_cast<int>(static_cast<unsigned char>(c));
}

TEST(ManPage, GroffHasNoWarning) {
    if (std::system("command -v groff > /dev/null") != 0) GTEST_SKIP() << "groff is not installed";
    const test::TemporaryFolder folder;
    std::ofstream(folder / "kerf.1") << man_page();
    const std::string command =
        "groff -ww -man -Tascii " + (folder / "kerf.1") + " > " + (folder / "text") + " 2> " + (folder / "warnings");
    ASSERT_EQ(std::system(command.c_str()), 0) << test::contents_of(folder / "warnings");
    EXPECT_EQ(test::contents_of(folder / "warnings"), "");
    EXPECT_TRUE(has(test::contents_of(folder / "text"), "haptic simulation of bone surgery"));
}

/// docs/commands.md, from the table.
std::string page_of_commands() {
    std::string text =
        "<!-- SPDX-License-Identifier: Apache-2.0 -->\n# Commands\n\n*" + std::string(session::notice_line) +
        ".*\n\n`kerf COMMAND --help` prints the options of a command. The test `Docs.HaveEveryCommand` "
        "compares\nthis page with the program; with `KERF_UPDATE_GOLDEN=1` it writes the page again.\n\n"
        "## Completion and manual page\n\n"
        "`cmake --install` installs the manual page kerf(1) and the completion scripts for bash, zsh and "
        "fish.\nWithout an installation, load a script into the running shell:\n\n"
        "| shell | command |\n|---|---|\n"
        "| bash | `source <(kerf completion bash)` |\n"
        "| zsh | `source <(kerf completion zsh)` |\n"
        "| fish | `kerf completion fish \\| source` |\n\n"
        "`kerf man | man -l -` shows the manual page.\n";
    std::string group;
    for (const Command& command : command_table()) {
        if (command.group != group)
            text += "\n## " + (group = command.group) + "\n\n| command | what it does |\n|---|---|\n";
        std::string usage = "kerf " + command.name;
        for (const Parameter& argument : command.arguments)
            usage += (argument.is_required ? " " : " [") + argument.name + (command.has_many(argument) ? "..." : "") +
                     (argument.is_required ? "" : "]");
        text += "| `" + usage + "` | " + command.summary + " |\n";
    }
    return text;
}

TEST(Docs, HaveEveryCommand) {
    const std::string file = KERF_SOURCE_DIR "/docs/commands.md";
    if (std::getenv("KERF_UPDATE_GOLDEN") != nullptr) std::ofstream(file, std::ios::binary) << page_of_commands();
    EXPECT_EQ(test::contents_of(file), page_of_commands());
}

}  // namespace
}  // namespace kerf::app
