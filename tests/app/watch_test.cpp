// SPDX-License-Identifier: Apache-2.0
// `kerf run --watch` runs again when a document changes.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

namespace fs = std::filesystem;

/// Waits up to a minute for a condition.
template <class Condition>
bool comes(Condition condition) {
    for (int i = 0; i < 600; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return false;
}

bool has(const std::string& file, const std::string& text) {
    return test::contents_of(file).find(text) != std::string::npos;
}

TEST(Watch, RunsAgainWhenTheProcedureChanges) {
    const test::TemporaryFolder folder;
    fs::copy(KERF_SOURCE_DIR "/procedures/anatomy", folder / "anatomy");
    const std::string procedure = folder / "pedicle-screw.yaml", out = folder / "out", log = folder / "log";
    fs::copy(KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml", procedure);
    const pid_t child = fork();
    if (child == 0) {
        if (freopen(log.c_str(), "w", stdout) == nullptr || dup2(fileno(stdout), 2) < 0) _exit(9);
        execl(KERF_BUILD_DIR "/bin/kerf", "kerf", "run", procedure.c_str(), "--watch", "--out", out.c_str(), "--set",
              "accuracy.spacing=0.5 mm", "--set", "time_limit=2 s", nullptr);
        _exit(9);
    }
    ASSERT_TRUE(comes([&] { return has(log, "waiting for a change"); })) << test::contents_of(log);
    EXPECT_TRUE(fs::exists(out + "/summary.json"));
    fs::remove(out + "/summary.json");

    std::ofstream(procedure, std::ios::app) << "# changed\n";
    EXPECT_TRUE(comes([&] { return has(log, "pedicle-screw.yaml has changed") && fs::exists(out + "/summary.json"); }))
        << test::contents_of(log);

    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) || WIFSIGNALED(status));
}

}  // namespace
}  // namespace kerf::app
