// SPDX-License-Identifier: Apache-2.0
#include "text/regular_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace kerf::text {
namespace {

TEST(RegularFile, IsOpenedAlsoThroughALink) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "a") << "text";
    std::filesystem::create_symlink("a", folder / "b");
    for (const char* name : {"a", "b"}) {
        EXPECT_FALSE(fault_of_file(folder / name));
        std::ifstream in = open_regular_file(folder / name);
        std::string word;
        EXPECT_TRUE(in >> word);
        EXPECT_EQ(word, "text");
    }
}

TEST(RegularFile, IsNoFifoDeviceFolderOrDeadLink) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(mkfifo((folder / "fifo").c_str(), 0600), 0);
    std::filesystem::create_directory(folder / "folder");
    std::filesystem::create_symlink("nowhere", folder / "dead");
    std::filesystem::create_symlink("/dev/zero", folder / "zero");
    for (const std::string& file : {folder / "fifo", folder / "folder", folder / "dead", folder / "zero",
                                    folder / "missing", std::string("/dev/null"), std::string()}) {
        SCOPED_TRACE(file);
        const auto fault = fault_of_file(file);
        ASSERT_TRUE(fault);
        EXPECT_FALSE(fault->problem.empty() || fault->advice.empty());
        EXPECT_FALSE(open_regular_file(file).is_open());
        EXPECT_FALSE(open_regular_file(file));
    }
}

}  // namespace
}  // namespace kerf::text
