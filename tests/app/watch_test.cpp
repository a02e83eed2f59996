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

/// `kerf run PROCEDURE --watch` in a process of its own.
class WatchedRun {
public:
    WatchedRun(const std::string& procedure, const std::string& out, const std::string& log) : log_(log) {
        child_ = fork();
        if (child_ != 0) return;
        if (freopen(log.c_str(), "w", stdout) == nullptr || dup2(fileno(stdout), 2) < 0) _exit(9);
        execl(KERF_BUILD_DIR "/bin/kerf", "kerf", "run", procedure.c_str(), "--watch", "--out", out.c_str(), "--set",
              "accuracy.spacing=0.5 mm", "--set", "time_limit=2 s", nullptr);
        _exit(9);
    }
    ~WatchedRun() {
        kill(child_, SIGINT);
        int status = 0;
        waitpid(child_, &status, 0);
        EXPECT_TRUE(WIFEXITED(status) || WIFSIGNALED(status));
    }
    WatchedRun(const WatchedRun&) = delete;
    WatchedRun& operator=(const WatchedRun&) = delete;

    [[nodiscard]] bool waits() const {
        return comes([&] { return has(log_, "waiting for a change"); });
    }

private:
    std::string log_;
    pid_t child_ = -1;
};

TEST(Watch, RunsAgainWhenTheProcedureChanges) {
    const test::TemporaryFolder folder;
    fs::copy(KERF_SOURCE_DIR "/procedures/anatomy", folder / "anatomy");
    const std::string procedure = folder / "pedicle-screw.yaml", out = folder / "out", log = folder / "log";
    fs::copy(KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml", procedure);
    const WatchedRun run(procedure, out, log);
    ASSERT_TRUE(run.waits()) << test::contents_of(log);
    EXPECT_TRUE(fs::exists(out + "/summary.json"));
    fs::remove(out + "/summary.json");

    std::ofstream(procedure, std::ios::app) << "# changed\n";
    EXPECT_TRUE(comes([&] { return has(log, "pedicle-screw.yaml has changed") && fs::exists(out + "/summary.json"); }))
        << test::contents_of(log);
}

TEST(Watch, RunsAgainWhenASurfaceIsReplaced) {
    // Given the block of the golden files as a surface
    const test::TemporaryFolder folder;
    const std::string procedure = folder / "hole.yaml", out = folder / "out", log = folder / "log";
    fs::copy(KERF_SOURCE_DIR "/tests/golden/hole.yaml", procedure);
    std::string anatomy = test::contents_of(KERF_SOURCE_DIR "/tests/golden/block.yaml");
    const std::size_t at = anatomy.find("phantom:"), end = anatomy.find("tissues:");
    ASSERT_LT(at, end);
    anatomy.replace(at, end - at, "mesh: {file: bone.obj, unit: mm, frame: LPS}\n");
    std::ofstream(folder / "block.yaml") << anatomy;
    std::string cube;
    for (int i = 0; i < 8; ++i)
        cube += std::string("v ") + (i & 1 ? "10 " : "-10 ") + (i & 2 ? "10 " : "-10 ") + (i & 4 ? "10\n" : "-10\n");
    cube += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    std::ofstream(folder / "bone.obj") << cube;
    const WatchedRun run(procedure, out, log);
    ASSERT_TRUE(run.waits()) << test::contents_of(log);
    ASSERT_TRUE(fs::exists(out + "/summary.json")) << test::contents_of(log);
    fs::remove(out + "/summary.json");

    // When another file takes its name
    std::ofstream(folder / "new.obj") << cube;
    fs::rename(folder / "new.obj", folder / "bone.obj");

    EXPECT_TRUE(comes([&] { return has(log, "bone.obj has changed") && fs::exists(out + "/summary.json"); }))
        << test::contents_of(log);
}

}  // namespace
}  // namespace kerf::app
