// SPDX-License-Identifier: Apache-2.0
#include "conformance/sandbox.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/plugin/guarded_memory.h"

namespace kerf::conformance {
namespace {

volatile int sink = 0;

TEST(Sandbox, ReturnsWhatTheWorkReturns) {
    const Ended ended = run_in_child([] { return std::string("done"); });
    EXPECT_EQ(ended.how, Ended::How::returned);
    EXPECT_EQ(ended.text, "done");
    EXPECT_EQ(run_in_child([] { return std::string(); }).how, Ended::How::returned) << "nothing is an answer too";
}

TEST(Sandbox, KeepsWhatIsPrintedFitForATerminal) {
    const Ended ended = run_in_child([] {
        std::puts("one \x1b[2J");
        std::fflush(stdout);
        return std::string("done");
    });
    EXPECT_EQ(ended.output, "one \\x1b[2J\n");
}

TEST(Sandbox, NamesACrash) {
    const Ended ended = run_in_child([] {
        std::raise(SIGSEGV);
        return std::string();
    });
    EXPECT_EQ(ended.how, Ended::How::crashed);
    EXPECT_NE(ended.text.find("SIGSEGV"), std::string::npos) << ended.text;
}

TEST(Sandbox, NamesTheMemoryThatWasMisused) {
    const Ended ended = run_in_child([] {
        GuardedMemory memory;
        void* const inputs = memory.allocate(sizeof(int), alignof(int), "it wrote beyond the inputs");
        memory.make_read_only("it wrote to the inputs");
        *static_cast<volatile int*>(inputs) = 1;
        return std::string();
    });
    EXPECT_NE(ended.text.find("it wrote to the inputs"), std::string::npos) << ended.text;
}

TEST(Sandbox, NoticesThatItsProcessWasLeft) {
    EXPECT_EQ(run_in_child([]() -> std::string { std::exit(0); }).how, Ended::How::left);
    EXPECT_EQ(run_in_child([]() -> std::string { std::quick_exit(0); }).how, Ended::How::left);
    EXPECT_EQ(run_in_child([]() -> std::string { _exit(0); }).how, Ended::How::left);
}

TEST(Sandbox, EndsWorkThatDoesNotReturn) {
    const Ended busy = run_in_child(
        []() -> std::string {
            for (;;) sink = sink + 1;
        },
        {.cpu_seconds = 1});
    EXPECT_EQ(busy.how, Ended::How::timed_out);
    const Ended asleep = run_in_child(
        []() -> std::string {
            for (;;) pause();
        },
        {.wall_seconds = 1});
    EXPECT_EQ(asleep.how, Ended::How::timed_out);
}

TEST(Sandbox, EndsWhatTheWorkHasStarted) {
    int pipe[2];
    ASSERT_EQ(::pipe(pipe), 0);
    const Ended ended = run_in_child([&] {
        if (fork() == 0)
            for (;;) pause();
        return std::string("done");
    });
    EXPECT_EQ(ended.text, "done");
    close(pipe[1]);
    char byte = 0;
    EXPECT_EQ(read(pipe[0], &byte, 1), 0) << "the grandchild is gone, so nobody can write";
    close(pipe[0]);
}

}  // namespace
}  // namespace kerf::conformance
