// SPDX-License-Identifier: Apache-2.0
#include "text/write_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace kerf::text {
namespace {

namespace fs = std::filesystem;
using test::contents_of;
using test::TemporaryFolder;

TEST(WriteFile, LeavesAPipeWhereItIs) {
    const TemporaryFolder folder;
    const std::string pipe = folder / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_NE(write_file(pipe, "text").find("it is a device or a pipe"), std::string::npos);
    EXPECT_TRUE(fs::is_fifo(pipe));
    EXPECT_FALSE(fs::exists(pipe + ".part"));
}

TEST(WriteFile, ReplacesTheWholeFileAndLeavesNothingElse) {
    const TemporaryFolder folder;
    ASSERT_EQ(write_file(folder / "a.txt", "a longer text"), "");
    ASSERT_EQ(write_file(folder / "a.txt", "short"), "");
    EXPECT_EQ(contents_of(folder / "a.txt"), "short");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(WriteFile, SaysWhichFileCouldNotBeWritten) {
    const TemporaryFolder folder;
    const std::string error = write_file(folder / "missing/a.txt", "text");
    EXPECT_NE(error.find("a.txt could not be written"), std::string::npos) << error;
}

TEST(WriteFile, FollowsNoLinkThatStandsInItsWay) {
    const TemporaryFolder folder;
    ASSERT_EQ(write_file(folder / "mine.txt", "years of work"), "");
    fs::create_symlink(folder / "mine.txt", folder / "a.txt.part");
    fs::create_symlink(folder / "mine.txt", folder / "a.txt");
    ASSERT_EQ(write_file(folder / "a.txt", "text"), "");
    fs::create_hard_link(folder / "mine.txt", folder / "b.txt.part");
    ASSERT_EQ(write_file(folder / "b.txt", "text"), "");
    ASSERT_EQ(mkfifo((folder / "c.txt.part").c_str(), 0600), 0);
    ASSERT_EQ(write_file(folder / "c.txt", "text"), "");

    EXPECT_EQ(contents_of(folder / "mine.txt"), "years of work");
    for (const char* name : {"a.txt", "b.txt", "c.txt"}) EXPECT_EQ(contents_of(folder / name), "text") << name;
    EXPECT_FALSE(fs::is_symlink(folder / "a.txt"));
}

TEST(WriteFile, KeepsTheOldFileWhenTheNewDoesNotFit) {
    const TemporaryFolder folder;
    ASSERT_EQ(write_file(folder / "a.txt", "old"), "");
    const pid_t child = fork();
    if (child == 0) {
        signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{1000, 1000};
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(2);
        _exit(write_file(folder / "a.txt", std::string(2000, 'x')).empty() ? 1 : 0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_EQ(contents_of(folder / "a.txt"), "old");
    EXPECT_FALSE(fs::exists(folder / "a.txt.part"));
}

TEST(FileWriter, LetsNobodyElseWriteTheSameFile) {
    const TemporaryFolder folder;
    FileWriter first(folder / "a.txt");
    first.write("first");
    EXPECT_NE(write_file(folder / "a.txt", "second").find("another process is writing it"), std::string::npos);
    EXPECT_EQ(first.finish(), "");
    EXPECT_EQ(contents_of(folder / "a.txt"), "first");
    EXPECT_EQ(write_file(folder / "a.txt", "second"), "");
    EXPECT_EQ(contents_of(folder / "a.txt"), "second");
}

TEST(FileWriter, LeavesNothingWhenItIsNotFinished) {
    const TemporaryFolder folder;
    { FileWriter(folder / "a.txt").write("half"); }
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(MadeFolders, GoAgainUnlessTheyAreKept) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "mine");
    {
        MadeFolders made;
        ASSERT_EQ(made.make(folder / "mine/a/b"), "");
        EXPECT_TRUE(fs::is_directory(folder / "mine/a/b"));
    }
    EXPECT_TRUE(fs::is_empty(folder / "mine"));
    MadeFolders made;
    EXPECT_NE(made.make((folder / "mine/a/") + std::string(300, 'b') + "/c"), "");
    EXPECT_TRUE(fs::is_empty(folder / "mine"));
    ASSERT_EQ(made.make(folder / "mine//a/./b/"), "");
    made.keep();
    EXPECT_TRUE(fs::is_directory(folder / "mine/a/b"));
}

}  // namespace
}  // namespace kerf::text
