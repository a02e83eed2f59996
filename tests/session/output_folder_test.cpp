// SPDX-License-Identifier: Apache-2.0
#include "session/output_folder.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "session/recorder.h"
#include "tests/support/temporary_folder.h"

namespace kerf::session {
namespace {

namespace fs = std::filesystem;
using test::contents_of;
using test::TemporaryFolder;

/// As a run does it, except that nothing follows.
std::string prepared(const std::string& folder) {
    text::OutputLock lock;
    text::MadeFolders made;
    std::string error = prepare_output(folder, lock, made);
    made.keep();
    return error;
}

TEST(PrepareOutput, MakesAFolderThatIsNotThere) {
    const TemporaryFolder folder;
    EXPECT_EQ(prepared(folder / "new/run"), "");
    EXPECT_TRUE(fs::is_directory(folder / "new/run"));
}

TEST(PrepareOutput, TakesAnEmptyFolder) {
    const TemporaryFolder folder;
    EXPECT_EQ(prepared(folder.path()), "");
}

TEST(PrepareOutput, EmptiesAFolderThatHoldsASession) {
    const TemporaryFolder folder;
    Recorder::create(folder / "session.db", {}).recorder.reset();
    ASSERT_EQ(text::write_file(folder / "report.html", "old"), "");

    EXPECT_EQ(prepared(folder.path()), "");
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(PrepareOutput, KnowsASessionThatWasKilledAtOnce) {
    const TemporaryFolder folder, copy;
    const auto created = Recorder::create(folder / "session.db", {});
    fs::copy_file(folder / "session.db", copy / "session.db");  // as the disk has it while the recorder still runs
    EXPECT_EQ(prepared(copy.path()), "");
}

TEST(PrepareOutput, LeavesAnotherFolderAlone) {
    const TemporaryFolder folder;
    ASSERT_EQ(text::write_file(folder / "thesis.txt", "years of work"), "");

    EXPECT_NE(prepared(folder.path()), "");
    EXPECT_EQ(contents_of(folder / "thesis.txt"), "years of work");
}

TEST(PrepareOutput, LeavesSomebodysFilesBesideASessionAlone) {
    const TemporaryFolder folder;
    Recorder::create(folder / "session.db", {}).recorder.reset();
    ASSERT_EQ(text::write_file(folder / "thesis.txt", "years of work"), "");

    EXPECT_NE(prepared(folder.path()).find("thesis.txt"), std::string::npos);
    EXPECT_EQ(contents_of(folder / "thesis.txt"), "years of work");
    EXPECT_TRUE(fs::exists(folder / "session.db"));
}

TEST(PrepareOutput, IsNotFooledByTheNameOfASession) {
    const TemporaryFolder folder;
    ASSERT_EQ(text::write_file(folder / "session.db", std::string(4096, 'x')), "");
    EXPECT_NE(prepared(folder.path()), "");
    EXPECT_TRUE(fs::exists(folder / "session.db"));
}

TEST(PrepareOutput, TakesAwayWhatAKilledRunLeftHalfWritten) {
    const TemporaryFolder folder;
    Recorder::create(folder / "session.db", {}).recorder.reset();
    for (const char* name : {"session.db-wal", "session.db-journal", "bone.stl.part"})
        ASSERT_EQ(text::write_file(folder / name, "half"), "");
    EXPECT_EQ(prepared(folder.path()), "");
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(PrepareOutput, TakesAwayTheTracesOfARunThatHardlyBegan) {
    for (const std::vector<std::string>& left :
         std::vector<std::vector<std::string>>{{"session.db.part"},
                                               {"session.db.part", "session.db.part-journal"},
                                               {"session.db-journal"},
                                               {"session.db-wal", "session.db-shm"}}) {
        const TemporaryFolder folder;
        for (const std::string& name : left) ASSERT_EQ(text::write_file(folder / name, "half"), "");
        EXPECT_EQ(prepared(folder.path()), "") << left.front();
        EXPECT_TRUE(fs::is_empty(folder.path())) << left.front();
    }
    const TemporaryFolder folder;
    for (const char* name : {"session.db", "session.db-journal"}) ASSERT_EQ(text::write_file(folder / name, ""), "");
    EXPECT_EQ(prepared(folder.path()), "");
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(PrepareOutput, LeavesWhatOnlyLooksLikeATraceAlone) {
    const TemporaryFolder folder, another;
    ASSERT_EQ(text::write_file(another / "mine.txt", ""), "");
    fs::create_symlink(another / "mine.txt", folder / "session.db");
    EXPECT_NE(prepared(folder.path()), "");
    fs::remove(folder / "session.db");
    ASSERT_EQ(text::write_file(folder / "session.db", ""), "");
    ASSERT_EQ(text::write_file(folder / "thesis.txt", "years of work"), "");
    EXPECT_NE(prepared(folder.path()), "");
    EXPECT_EQ(contents_of(folder / "thesis.txt"), "years of work");
}

TEST(PrepareOutput, RefusesAPathThatIsTooLong) {
    const TemporaryFolder folder;
    std::string deep = folder / "a";
    while (deep.size() < 600) deep += "/aaaaaaaaa";
    EXPECT_NE(prepared(deep).find("bytes, expected at most"), std::string::npos) << prepared(deep);
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(PrepareOutput, RefusesAFolderThatAnotherRunWrites) {
    const TemporaryFolder folder;
    Recorder::create(folder / "session.db", {}).recorder.reset();
    {
        text::OutputLock first, second;
        text::MadeFolders made;
        ASSERT_EQ(prepare_output(folder / "run", first, made), "");
        EXPECT_NE(prepare_output(folder / "run", second, made).find("is being written by another run"),
                  std::string::npos);
    }
    EXPECT_EQ(prepared(folder / "run"), "");
}

TEST(PrepareOutput, ALockOfAKilledRunBlocksNobody) {
    // Given a process that holds the folder
    const TemporaryFolder folder;
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        text::OutputLock lock;
        text::MadeFolders made;
        const char is_ours = prepare_output(folder.path(), lock, made).empty() ? 'y' : 'n';
        if (write(ends[1], &is_ours, 1) == 1) pause();
        _exit(1);
    }
    char is_ours = 'n';
    ASSERT_EQ(read(ends[0], &is_ours, 1), 1);
    ASSERT_EQ(is_ours, 'y');
    EXPECT_NE(prepared(folder.path()), "");

    // When it is killed, and can clear nothing away
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    for (const int end : ends) close(end);

    EXPECT_EQ(prepared(folder.path()), "");
}

TEST(PrepareOutput, RefusesAFile) {
    const TemporaryFolder folder;
    ASSERT_EQ(text::write_file(folder / "run", "text"), "");
    EXPECT_NE(prepared(folder / "run"), "");
}

}  // namespace
}  // namespace kerf::session
