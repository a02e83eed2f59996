// SPDX-License-Identifier: Apache-2.0
#include "app/badges/badge_store.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"
#include "text/sha256.h"

namespace kerf::app {
namespace {

namespace fs = std::filesystem;
using test::contents_of;
using test::TemporaryFolder;

Badge some_badge() {
    return {.digest = text::sha256_of("a plugin"),
            .plugin = "example.peck 0.1.0",
            .kit = 1,
            .requested = 3,
            .level = 3,
            .tests = 60};
}

struct BadgeFiles : testing::Test {
    TemporaryFolder folder;
    const Badge badge = some_badge();
    const BadgeStore store{folder / "state/kerf/badges"};
    const std::string file = store.folder() + "/" + badge.digest + ".json";

    void write(const std::string& text) const {
        fs::create_directories(store.folder());
        std::ofstream(file) << text;
    }
    /// The store neither believes nor changes what has the badge's name.
    void expect_left_alone(const std::string& why) const {
        const BadgeStore::Found found = store.find(badge.digest);
        EXPECT_FALSE(found.badge);
        EXPECT_NE(found.fault.find(file), std::string::npos) << found.fault;
        EXPECT_NE(found.fault.find(why), std::string::npos) << found.fault;
        const BadgeStore::Kept kept = store.keep(badge);
        EXPECT_FALSE(kept.badge);
        EXPECT_NE(kept.fault.find(file + " is in the way"), std::string::npos) << kept.fault;
    }
};

TEST_F(BadgeFiles, KeepABadgeByItsDigest) {
    EXPECT_FALSE(store.find(badge.digest).badge);
    EXPECT_EQ(store.keep(badge).badge, badge);
    EXPECT_EQ(store.find(badge.digest).badge, badge);
    EXPECT_FALSE(store.find(text::sha256_of("another plugin")).badge);
    EXPECT_EQ(std::distance(fs::directory_iterator(store.folder()), fs::directory_iterator()), 1);
}

TEST_F(BadgeFiles, AreTheSameBytesEachTime) {
    static_cast<void>(store.keep(badge));
    const std::string first = contents_of(file);
    static_cast<void>(store.keep(badge));
    EXPECT_EQ(contents_of(file), first);
    EXPECT_NE(first, "");
}

TEST_F(BadgeFiles, AreIgnoredAndThenReplacedIfDamaged) {
    write("{\"schema\": 1, ");
    const BadgeStore::Found found = store.find(badge.digest);
    EXPECT_FALSE(found.badge);
    EXPECT_EQ(found.fault, "the badge " + file + " is ignored: it is damaged. Remove it, then run `kerf check`.");
    const BadgeStore::Kept kept = store.keep(badge);
    EXPECT_EQ(kept.badge, badge);
    EXPECT_EQ(kept.fault, "the badge " + file + " was replaced: it is damaged.");
    EXPECT_EQ(store.find(badge.digest).badge, badge);
}

TEST_F(BadgeFiles, AreNotFollowedThroughALink) {
    write("");
    fs::remove(file);
    std::ofstream(folder / "elsewhere") << text_of(badge);
    fs::create_symlink(folder / "elsewhere", file);
    expect_left_alone("it is a link");
    EXPECT_TRUE(fs::is_symlink(file));
    EXPECT_EQ(contents_of(folder / "elsewhere"), text_of(badge));
}

TEST_F(BadgeFiles, MayBeAFifoWithoutAWriter) {
    write("");
    fs::remove(file);
    ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
    expect_left_alone("it is not a regular file");
    EXPECT_TRUE(fs::is_fifo(file));
}

TEST_F(BadgeFiles, MayBeAFolder) {
    fs::create_directories(file);
    expect_left_alone("it is not a regular file");
}

TEST_F(BadgeFiles, AreNotReadIfTheyAreHuge) {
    write("");
    fs::resize_file(file, 1'000'000'000'000);  // without blocks
    expect_left_alone("it is larger than a badge");
    EXPECT_EQ(fs::file_size(file), 1'000'000'000'000u);
}

TEST_F(BadgeFiles, OfAnotherUserAreNotBelieved) {
    write(text_of(badge));
    if (geteuid() != 0 || chown(file.c_str(), 65534, 65534) != 0) GTEST_SKIP() << "only root can give a file away";
    expect_left_alone("it belongs to another user");
    EXPECT_EQ(contents_of(file), text_of(badge));
}

TEST_F(BadgeFiles, NeedAFolderThatCanBeMade) {
    std::ofstream(folder / "state") << "a file";
    const BadgeStore::Kept kept = store.keep(badge);
    EXPECT_FALSE(kept.badge);
    EXPECT_NE(kept.fault.find("the badge is not kept: "), std::string::npos) << kept.fault;
    EXPECT_FALSE(store.find(badge.digest).badge);
    EXPECT_EQ(store.find(badge.digest).fault, "");
    EXPECT_EQ(contents_of(folder / "state"), "a file");
}

TEST(BadgeStore, FollowsTheEnvironment) {
    const auto folder_with = [](const char* own, const char* state, const char* home) {
        for (const auto& [name, value] : {std::pair{"KERF_BADGES", own}, {"XDG_STATE_HOME", state}, {"HOME", home}})
            value != nullptr ? setenv(name, value, 1) : unsetenv(name);
        return BadgeStore::of_environment();
    };
    const std::string home_before = std::getenv("HOME") != nullptr ? std::getenv("HOME") : "";
    EXPECT_EQ(folder_with("/a", "/b", "/c").folder(), "/a");
    EXPECT_EQ(folder_with("", "/b", "/c").folder(), "/b/kerf/badges");
    EXPECT_EQ(folder_with(nullptr, "relative", "/c").folder(), "/c/.local/state/kerf/badges");
    EXPECT_EQ(folder_with(nullptr, nullptr, nullptr).folder(), "");
    EXPECT_FALSE(folder_with(nullptr, nullptr, nullptr).is_off());
    EXPECT_NE(folder_with(nullptr, nullptr, nullptr).keep(some_badge()).fault.find("Set HOME"), std::string::npos);
    EXPECT_TRUE(folder_with("off", "/b", "/c").is_off());
    setenv("HOME", home_before.c_str(), 1);
    unsetenv("XDG_STATE_HOME");
    setenv("KERF_BADGES", "off", 1);
}

}  // namespace
}  // namespace kerf::app
