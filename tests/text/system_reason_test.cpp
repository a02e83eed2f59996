// SPDX-License-Identifier: Apache-2.0
#include "text/system_reason.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <string>

#include "tests/support/temporary_folder.h"
#include "text/write_file.h"

namespace kerf::text {
namespace {

/// Returns whether a condition is true in a child under a limit of the system.
template <class Condition>
bool is_true_under(int resource, rlim_t limit, Condition condition) {
    const pid_t child = fork();
    if (child == 0) {
        signal(SIGXFSZ, SIG_IGN);
        const rlimit both{limit, limit};
        _exit(setrlimit(static_cast<__rlimit_resource>(resource), &both) == 0 && condition() ? 0 : 1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(SystemReason, NamesTheLimitOfFileSize) {
    const test::TemporaryFolder folder;
    EXPECT_TRUE(is_true_under(RLIMIT_FSIZE, 8192, [&] {
        const std::string error = write_file(folder / "a", std::string(100'000, 'x'));
        return error ==
               (folder / "a") + " could not be written: the limit of file size is 8 kB. Raise it (`ulimit -f`).";
    }));
    EXPECT_TRUE(has(system_reason(EFBIG), "too large for its disk"));
}

TEST(SystemReason, NamesTheLimitThatKeepsThreadsAway) {
    EXPECT_TRUE(is_true_under(RLIMIT_AS, rlim_t{1} << 40, [] { return has(thread_advice(), "`ulimit -v`"); }));
    EXPECT_TRUE(has(thread_advice(), "`ulimit -u`"));
}

TEST(SystemReason, NamesTheLimitOfMemoryThatIsSet) {
    const auto is_named = [](const std::string& limit) {
        return has(system_reason(ENOMEM), limit) && has(thread_advice(), limit) &&
               has(with_memory_limit("It does not start."), "It does not start. The memory is limited") &&
               has(with_memory_limit(""), limit);
    };
    EXPECT_TRUE(is_true_under(RLIMIT_AS, rlim_t{1} << 40, [&] { return is_named("`ulimit -v`"); }));
    EXPECT_TRUE(is_true_under(RLIMIT_DATA, rlim_t{1} << 40, [&] { return is_named("`ulimit -d`"); }));
    EXPECT_EQ(with_memory_limit("It does not start."), "It does not start.");
}

TEST(SystemReason, NamesOtherErrorsByTheirText) {
    EXPECT_TRUE(has(system_reason(ENOSPC), "the disk is full. Free some space"));
    EXPECT_EQ(system_reason(EACCES), "Permission denied");
}

TEST(OutputLock, NoticesThatItsFolderIsReplaced) {
    const test::TemporaryFolder own;
    MadeFolders made;
    ASSERT_EQ(made.make(own / "run"), "");
    OutputLock lock;
    ASSERT_EQ(lock.take(own / "run"), "");
    EXPECT_TRUE(lock.is_at(own / "run"));
    ASSERT_EQ(rename((own / "run").c_str(), (own / "other").c_str()), 0);
    EXPECT_FALSE(lock.is_at(own / "run"));
    EXPECT_TRUE(lock.is_at(own / "other"));
    MadeFolders another;
    ASSERT_EQ(another.make(own / "run"), "");
    EXPECT_FALSE(lock.is_at(own / "run"));
}

}  // namespace
}  // namespace kerf::text
