// SPDX-License-Identifier: Apache-2.0
// Work in a child process, whose parent waits for its word. tests/app/plugin_guard_test.cpp has plugins that end it.
#include "app/worker.h"

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <string>

#include "app/standard_streams.h"

namespace kerf::app {
namespace {

TEST(Worker, ReturnsTheExitCodeOfItsWork) {
    for (const ExitCode code : {exit_pass, exit_not_passed, exit_bad_input, exit_fault})
        EXPECT_EQ(run_in_worker([&] { return code; }), code);
}

TEST(Worker, ReportsAnExceptionOfItsWorkAsAFault) {
    EXPECT_EQ(run_in_worker([]() -> ExitCode { throw std::runtime_error("not today"); }), exit_fault);
}

TEST(Worker, TakesNoEndWithoutAWordForSuccess) {
    const ErrorCopy copy;
    EXPECT_EQ(run_in_worker([] {
                  syscall(SYS_exit_group, 0);
                  return exit_pass;
              }),
              exit_fault);
    EXPECT_NE(copy.text().find("ended the program with exit code 0, without a result, and no plugin was called"),
              std::string::npos)
        << copy.text();
}

TEST(Worker, NamesTheSignalThatEndedIt) {
    for (const auto& [signal, name] :
         {std::pair{SIGKILL, "SIGKILL"}, {SIGALRM, "SIGALRM"}, {SIGTERM, "a signal ended the program by SIGTERM"}}) {
        const ErrorCopy copy;
        EXPECT_EQ(run_in_worker([signal = signal] {
                      std::signal(signal, SIG_DFL);
                      raise(signal);
                      return exit_pass;
                  }),
                  exit_fault);
        EXPECT_NE(copy.text().find(name), std::string::npos) << copy.text();
    }
}

TEST(Worker, LeavesNoCopyOfItselfBehind) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    EXPECT_EQ(run_in_worker([&] {
                  if (syscall(SYS_fork) == 0)
                      for (;;) pause();
                  return exit_pass;
              }),
              exit_pass);
    close(ends[1]);
    char none = 0;
    EXPECT_EQ(read(ends[0], &none, 1), 0) << "nobody has the other end";
    close(ends[0]);
}

TEST(Worker, PassesASignalOnOnce) {
    EXPECT_EXIT(
        {
            const ExitCode code = run_in_worker([] {
                kill(getppid(), SIGTERM);
                for (;;) pause();
                return exit_pass;
            });
            std::_Exit(code);
        },
        testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace kerf::app
