// SPDX-License-Identifier: Apache-2.0
// Folders of attempts, made and read back.
#include "app/attempts.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

std::string made(const std::string& folder, const std::string& learner = "L17") {
    std::string error;
    const std::string attempt = make_attempt_folder(folder, learner, "screw", error);
    EXPECT_EQ(error, "");
    return attempt;
}

void write(const std::string& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

TEST(Attempts, GetTheNextNumber) {
    const test::TemporaryFolder folder;
    EXPECT_EQ(made(folder / "all"), folder / "all/L17/screw/001");
    EXPECT_EQ(made(folder / "all"), folder / "all/L17/screw/002");
    EXPECT_EQ(made(folder / "all", ""), folder / "all/no-code/screw/001");
    std::filesystem::create_directory(folder / "all/L17/screw/041");
    write(folder / "all/L17/screw/042", "a file");
    EXPECT_EQ(made(folder / "all"), folder / "all/L17/screw/043");
}

TEST(Attempts, NeverGetTheSameFolder) {
    const test::TemporaryFolder folder;
    std::vector<std::vector<std::string>> of_thread(4);
    std::vector<std::thread> threads;
    for (auto& mine : of_thread)
        threads.emplace_back([&] {
            for (int i = 0; i < 25; ++i) mine.push_back(made(folder / "all"));
        });
    for (std::thread& thread : threads) thread.join();
    std::set<std::string> all;
    for (const auto& mine : of_thread) all.insert(mine.begin(), mine.end());
    EXPECT_EQ(all.size(), 100u);
}

TEST(Attempts, NameAFolderThatCannotBeMade) {
    const test::TemporaryFolder folder;
    write(folder / "file", "");
    std::string error;
    EXPECT_EQ(make_attempt_folder(folder / "file", "L17", "screw", error), "");
    EXPECT_NE(error.find(folder / "file"), std::string::npos) << error;
    EXPECT_NE(error.find("--attempts"), std::string::npos) << error;
}

TEST(Attempts, AreReadNewestFirst) {
    const test::TemporaryFolder folder;
    write(made(folder / "all") + "/summary.json",
          R"({"verdict": "pass", "score": 92.5, "duration_s": 61.25, "hand": "device"})");
    const std::string second = made(folder / "all");
    write(second + "/summary.json", R"({"verdict": "fail", "score": 10, "duration_s": 5, "hand": "simulated"})");
    write(second + "/session.db", "x");
    const auto attempts = read_attempts(folder / "all", "L17");
    ASSERT_EQ(attempts.size(), 2u);
    EXPECT_EQ(attempts[0].number, 2);
    EXPECT_EQ(attempts[0].verdict, "fail");
    EXPECT_TRUE(attempts[0].is_demonstration);
    EXPECT_TRUE(attempts[0].has_session);
    EXPECT_EQ(attempts[1].number, 1);
    EXPECT_EQ(attempts[1].procedure, "screw");
    EXPECT_EQ(attempts[1].score, 92.5);
    EXPECT_EQ(attempts[1].duration, 61.25);
    EXPECT_FALSE(attempts[1].is_demonstration);
    EXPECT_FALSE(attempts[1].has_session);
    EXPECT_TRUE(read_attempts(folder / "all", "L18").empty());
}

TEST(Attempts, HaveNoResultWithoutAReadableSummary) {
    const test::TemporaryFolder folder;
    for (const char* text : {"{", "[]", R"({"verdict": 7, "score": "high"})", ""})
        write(made(folder / "all") + "/summary.json", text);
    made(folder / "all");  // without a file
    for (const auto& attempt : read_attempts(folder / "all", "L17")) {
        EXPECT_EQ(attempt.verdict, "no result") << attempt.folder;
        EXPECT_FALSE(attempt.score) << attempt.folder;
    }
    EXPECT_EQ(read_attempts(folder / "all", "L17").size(), 5u);
}

TEST(Attempts, AreRemovedOnlyIfEmpty) {
    const test::TemporaryFolder folder;
    const std::string empty = made(folder / "all"), full = made(folder / "all");
    write(full + "/session.db", "x");
    remove_empty_attempt(empty);
    remove_empty_attempt(full);
    EXPECT_FALSE(std::filesystem::exists(empty));
    EXPECT_TRUE(std::filesystem::exists(full + "/session.db"));
}

}  // namespace
}  // namespace kerf::app
