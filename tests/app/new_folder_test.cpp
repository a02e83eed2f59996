// SPDX-License-Identifier: Apache-2.0
#include "app/new_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <string>

#include "app/new_folder_files.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

namespace fs = std::filesystem;

/// `SweptTool` as `swept_tool`, whose type would be SweptTool again.
std::string snake_case(const std::string& type) {
    std::string name;
    for (const char c : type) {
        const bool is_capital = std::isupper(static_cast<unsigned char>(c)) != 0;
        if (is_capital && !name.empty()) name += '_';
        name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return name;
}

/// Returns the type that a new tool defines.
std::string type_in(const std::string& source) {
    const std::string before = "struct ";
    const std::size_t at = source.find(before) + before.size();
    return source.substr(at, source.find(' ', at) - at);
}

TEST(NewFolder, GivesAPluginATypeOfItsOwn) {
    const test::TemporaryFolder folder;
    std::size_t written = 0;
    for (const char* word : taken_words) {
        const std::string name = snake_case(word);
        if (name.size() > 40 || name == "round_burr") continue;
        if (!write_new_folder(NewKind::tool, name, folder / name).empty()) continue;  // refused: see below
        ++written;
        const std::string type = type_in(test::contents_of(folder / (name + "/" + name + ".cpp")));
        EXPECT_TRUE(std::none_of(std::begin(taken_words), std::end(taken_words),
                                 [&](const char* taken) { return type == taken; }))
            << name << ": " << type;
        EXPECT_TRUE(std::any_of(type.begin(), type.end(), [](char c) { return c >= 'a' && c <= 'z'; })) << type;
    }
    EXPECT_GT(written, 100u);
}

TEST(NewFolder, WritesPluginsThatCompile) {
    for (const char* name : {"motor", "outline", "e_o_f", "double", "state"}) {
        const test::TemporaryFolder folder;
        ASSERT_EQ(write_new_folder(NewKind::tool, name, folder / name), "");
        const test::Ended ended = test::shell(
            KERF_CXX " -std=c++20 -fsyntax-only -Wall -Wextra -Werror -I " KERF_SOURCE_DIR "/core/sdk/include " +
            (folder / (std::string(name) + "/" + name + ".cpp")));
        EXPECT_EQ(ended.exit_code, 0) << name << "\n" << ended.err;
    }
}

TEST(NewFolder, ReplacesTheNameOnce) {
    for (const NewKind kind : {NewKind::tool, NewKind::strategy, NewKind::procedure})
        for (const std::string name : {"my_round_burr_2", "my_ball_groove", "bicortical_hole_2", "a"}) {
            const test::TemporaryFolder folder;
            ASSERT_EQ(write_new_folder(kind, name, folder / "made"), "");
            EXPECT_TRUE(fs::exists(folder / ("made/" + name + ".yaml")));
            const std::string procedure = test::contents_of(folder / ("made/" + name + ".yaml"));
            EXPECT_NE(procedure.find("\n  id: " + name + "\n"), std::string::npos) << procedure.substr(0, 400);
        }
}

TEST(NewFolder, RefusesNamesOfKerf) {
    const test::TemporaryFolder folder;
    for (const char* name : {"burring", "drilling", "sawing", "implant", "remesh_cgal", "udp", "kerf", "null"}) {
        for (const NewKind kind : {NewKind::tool, NewKind::strategy}) {
            const std::string error = write_new_folder(kind, name, folder / name);
            EXPECT_NE(error.find("the name "), std::string::npos) << name;
            EXPECT_NE(error.find("Write `kerf new plugin "), std::string::npos) << error;
        }
        EXPECT_FALSE(fs::exists(folder / name));
    }
    EXPECT_EQ(write_new_folder(NewKind::procedure, "burring", folder / "burring"), "");
    EXPECT_NE(write_new_folder(NewKind::procedure, "null", folder / "null"), "");
}

TEST(NewFolder, SuggestsTheNameThatWasMeant) {
    const test::TemporaryFolder folder;
    const auto suggested = [&](NewKind kind, const std::string& name) {
        const std::string error = write_new_folder(kind, name, folder / "made");
        const std::size_t at = error.find("Write `kerf new ") + 16;
        return error.substr(at, error.find('`', at) - at);
    };
    EXPECT_EQ(suggested(NewKind::tool, "Round Burr"), "plugin round_burr");
    EXPECT_EQ(suggested(NewKind::tool, "My Tool"), "plugin my_tool");
    EXPECT_EQ(suggested(NewKind::tool, "MyTool"), "plugin my_tool");
    EXPECT_EQ(suggested(NewKind::tool, "Drilling"), "plugin my_drilling");
    EXPECT_EQ(suggested(NewKind::procedure, "my-hole"), "procedure my_hole");
    EXPECT_EQ(suggested(NewKind::procedure, "2 holes"), "procedure my_2_holes");
    EXPECT_EQ(suggested(NewKind::procedure, "null"), "procedure my_null");
    EXPECT_EQ(suggested(NewKind::procedure, "--"), "procedure bicortical_hole");
    EXPECT_EQ(suggested(NewKind::tool, std::string(50, 'A')), "plugin " + std::string(40, 'a'));
}

TEST(NewFolder, PrintsCommandsThatAShellReads) {
    const test::TemporaryFolder folder;
    const std::string within = "cd " + folder.path() + " && " KERF_BUILD_DIR "/bin/kerf new ";
    const test::Ended plugin = test::shell(within + "plugin mill --out 'my tools'");
    EXPECT_NE(plugin.out.find("cmake -S 'my tools' -B 'my tools/build' "), std::string::npos) << plugin.out;
    EXPECT_NE(plugin.out.find("ctest --test-dir 'my tools/build'\n"), std::string::npos) << plugin.out;
    EXPECT_NE(plugin.out.find("kerf check 'my tools/build/lib/kerf/kerf_mill.so' "), std::string::npos) << plugin.out;
    const test::Ended procedure = test::shell(within + "procedure hole --out \"it's \\$HOME\"");
    EXPECT_NE(procedure.out.find("kerf run 'it'\\''s $HOME/hole.yaml'\n"), std::string::npos) << procedure.out;
}

}  // namespace
}  // namespace kerf::app
