// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/loading_trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "core/plugin/loader.h"
#include "tests/support/temporary_folder.h"

namespace kerf {
namespace {

std::string file_of(const std::string& how) { return KERF_BUILD_DIR "/tests/bad_plugins/plugin_that_" + how + ".so"; }

void expect_refused(const std::string& how, const std::string& says) {
    const PluginLoad load = load_plugin(file_of(how));
    EXPECT_FALSE(load.plugin) << how;
    EXPECT_NE(load.refusal.find(file_of(how) + "): " + says), std::string::npos) << load.refusal;
}

TEST(LoadingTrial, NamesWhatEndedItAndGoesOn) {
    ASSERT_TRUE(can_try());
    expect_refused("aborts", "aborted while it was loaded.");
    expect_refused("crashes", "crashed (Segmentation fault) while it was loaded.");
    expect_refused("exits", "ended the program with exit code 0 while it was loaded.");
    expect_refused("leaves_in_load", "ended the program with exit code 0 while it was loaded.");
    expect_refused("throws", "threw an exception (`not today`) while it was loaded.");
    expect_refused("dangling_parameters", "crashed (Segmentation fault) while its tables were read.");
    expect_refused("crashes_in_unload", "crashed (Segmentation fault) while it was unloaded.");
}

TEST(LoadingTrial, EndsOneThatHangsAfterItsLimit) {
    const std::vector<Trial> trials = try_in_child(
        {"a", "b", "c"},
        [](const std::string& path, const TrialReport& report) {
            report.does("while it slept");
            if (path == "b") std::this_thread::sleep_for(std::chrono::hours(1));
            return path == "c" ? std::string("is c.") : std::string();
        },
        std::chrono::seconds(1));
    ASSERT_EQ(trials.size(), 3u);
    EXPECT_EQ(trials[0].refusal, "");
    EXPECT_EQ(trials[1].refusal.find("did not come back within 1 s while it slept."), 0u) << trials[1].refusal;
    EXPECT_EQ(trials[2].refusal, "is c.");
}

TEST(LoadingTrial, RefusesAPluginThatLoopsWhileItIsLoaded) {
    const auto start = std::chrono::steady_clock::now();
    expect_refused("loops_in_load", "did not come back within 5 s while it was loaded.");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(9));
}

TEST(LoadingTrial, KeepsWhatThePluginWroteLast) {
    const std::vector<Trial> trials = try_in_child({"a"}, [](const std::string&, const TrialReport&) {
        std::fputs("no licence found\x1b[2J\n", stderr);
        std::exit(4);
        return std::string();
    });
    EXPECT_NE(trials.front().refusal.find("exit code 4 while it was loaded. It wrote `no licence found\\x1b[2J`."),
              std::string::npos)
        << trials.front().refusal;
}

TEST(LoadingTrial, MakesNoChildBesideAnotherThread) {
    std::atomic<bool> is_done{false};
    std::thread other([&] {
        while (!is_done) std::this_thread::yield();
    });
    EXPECT_FALSE(can_try());
    is_done = true;
    other.join();
}

// Whatever the file was cut to, its headers tell; no such length may reach the dynamic linker, which would crash.
TEST(ElfFile, RefusesAPluginCutShort) {
    const test::TemporaryFolder folder;
    const std::string whole = test::contents_of(file_of("nothing_wrong"));
    for (std::size_t part = 0; part < 16; ++part) {
        const std::string path = folder / ("cut-" + std::to_string(part) + ".so");
        std::ofstream(path, std::ios::binary) << whole.substr(0, whole.size() * part / 16);
        const PluginLoad load = load_plugin(path);
        if (load.plugin) continue;  // behind its segments there are only tables for debuggers
        const bool is_named = load.refusal.find("is cut short: it has ") != std::string::npos ||
                              load.refusal.find("is not a shared library") != std::string::npos;
        EXPECT_TRUE(is_named) << load.refusal;
    }
}

TEST(ElfFile, NamesTheMachineItWasBuiltFor) {
    const test::TemporaryFolder folder;
    std::string other = test::contents_of(file_of("nothing_wrong"));
    other[18] = static_cast<char>(183);  // e_machine
    other[19] = 0;
    std::ofstream(folder / "arm.so", std::ios::binary) << other;
    const std::string refusal = load_plugin(folder / "arm.so").refusal;
    EXPECT_NE(refusal.find("is built for AArch64, and this Kerf runs on x86-64."), std::string::npos) << refusal;
}

// A header of this machine is not called one of another machine.
TEST(ElfFile, NamesADamagedHeader) {
    const test::TemporaryFolder folder;
    for (const std::size_t byte : {4, 5}) {  // class and order of bytes
        std::string damaged = test::contents_of(file_of("nothing_wrong"));
        damaged[byte] = static_cast<char>(3 - damaged[byte]);
        std::ofstream(folder / "damaged.so", std::ios::binary) << damaged;
        const std::string refusal = load_plugin(folder / "damaged.so").refusal;
        EXPECT_NE(refusal.find("damaged or of another kind"), std::string::npos) << refusal;
        EXPECT_EQ(refusal.find("this Kerf runs on"), std::string::npos) << refusal;
    }
}

}  // namespace
}  // namespace kerf
