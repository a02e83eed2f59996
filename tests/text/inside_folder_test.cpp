// SPDX-License-Identifier: Apache-2.0
#include "text/inside_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace kerf::text {
namespace {

namespace fs = std::filesystem;

TEST(InsideFolder, FollowsLinksOfFilesAndFolders) {
    const test::TemporaryFolder folder;
    fs::create_directories(folder / "in/deep");
    fs::create_directories(folder / "out");
    std::ofstream(folder / "in/a") << "a";
    std::ofstream(folder / "out/b") << "b";
    fs::create_symlink("a", folder / "in/near");
    fs::create_symlink("../out/b", folder / "in/far");
    fs::create_directory_symlink("../out", folder / "in/away");
    fs::create_directory_symlink("in", folder / "alias");
    fs::create_symlink("loop", folder / "in/loop");

    for (const char* name : {"a", "near", "deep/missing", "", "deep/../a"})
        for (const char* root : {"in", "in/", "alias"})
            EXPECT_TRUE(is_inside_folder(folder / ("in/" + std::string(name)), folder / root)) << name << " " << root;
    for (const char* name : {"far", "away/b", "away", "../out/b", "loop", "../in2"})
        EXPECT_FALSE(is_inside_folder(folder / ("in/" + std::string(name)), folder / "in")) << name;
}

TEST(InsideFolder, TakesTheWorkingFolderForAnEmptyOne) {
    EXPECT_TRUE(is_inside_folder("some/file", ""));
    EXPECT_FALSE(is_inside_folder("/etc/passwd", ""));
}

}  // namespace
}  // namespace kerf::text
