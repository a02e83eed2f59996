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

TEST(TargetOfLink, IsTheFileBehindAllLinks) {
    const test::TemporaryFolder folder, elsewhere;
    std::ofstream(folder / "a") << "text";
    std::filesystem::create_symlink(folder / "a", elsewhere / "b");
    std::filesystem::create_symlink("b", elsewhere / "c");
    for (const char* name : {"b", "c"})
        EXPECT_EQ(target_of_link(elsewhere / name), std::filesystem::canonical(folder / "a").string());

    std::filesystem::create_symlink("nowhere", folder / "dead");
    std::filesystem::create_symlink("loop", folder / "loop");
    for (const std::string& same : {folder / "a", folder / "dead", folder / "loop", folder / "none", std::string()})
        EXPECT_EQ(target_of_link(same), same);
}

TEST(RegularFile, IsNoFifoDeviceFolderOrDeadLink) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(mkfifo((folder / "fifo").c_str(), 0600), 0);
    std::filesystem::create_directory(folder / "folder");
    std::filesystem::create_symlink("nowhere", folder / "dead");
    std::filesystem::create_symlink("/dev/zero", folder / "zero");
    std::filesystem::create_symlink("loop", folder / "loop");
    for (const std::string& file : {folder / "loop", folder / "fifo", folder / "folder", folder / "dead",
                                    folder / "zero", folder / "missing", std::string("/dev/null"), std::string()}) {
        SCOPED_TRACE(file);
        const auto fault = fault_of_file(file);
        ASSERT_TRUE(fault);
        EXPECT_FALSE(fault->problem.empty() || fault->advice.empty());
        EXPECT_FALSE(open_regular_file(file).is_open());
        EXPECT_FALSE(open_regular_file(file));
    }
}

TEST(RegularFile, NamesTheKindOfAnotherFile) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(mkfifo((folder / "fifo").c_str(), 0600), 0);
    ASSERT_EQ(mknod((folder / "socket").c_str(), S_IFSOCK | 0600, 0), 0);
    std::filesystem::create_symlink("loop", folder / "loop");
    EXPECT_EQ(fault_of_file(folder / "fifo")->problem, "this is a FIFO, not a regular file.");
    EXPECT_EQ(fault_of_file(folder / "socket")->problem, "this is a socket, not a regular file.");
    EXPECT_EQ(fault_of_file("/dev/zero")->problem, "this is a device, not a regular file.");
    EXPECT_EQ(fault_of_file(folder / "loop")->problem, "this is a link that leads to itself.");
}

}  // namespace
}  // namespace kerf::text
