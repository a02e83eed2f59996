// SPDX-License-Identifier: Apache-2.0
// `kerf privacy` reads a database as the other commands do, and reports one that it cannot read to its end.
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "app/privacy/privacy_report.h"
#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

/// Writes a database whose last row, with a path, is only in its -wal file, as a killed run leaves it.
void write_killed(const std::string& file) {
    const TemporaryFolder folder;
    const std::string open_file = folder / "open.db";
    sqlite3* writer = nullptr;
    ASSERT_EQ(sqlite3_open(open_file.c_str(), &writer), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(writer,
                           "PRAGMA journal_mode=WAL; CREATE TABLE notes (text); PRAGMA wal_checkpoint(TRUNCATE);"
                           "INSERT INTO notes VALUES ('from /home/jane/scans/1')",
                           nullptr, nullptr, nullptr),
              SQLITE_OK);
    fs::copy_file(open_file, file);
    fs::copy_file(open_file + "-wal", file + "-wal");
    sqlite3_close(writer);
}

void expect_the_path(const PrivacyReport& report) {
    EXPECT_EQ(report.error, "");
    EXPECT_FALSE(report.is_partial);
    ASSERT_EQ(report.findings.size(), 1u);
    EXPECT_EQ(report.findings[0].value, "/home/jane/scans/1");
}

TEST(PrivacyOfADatabase, ReadsTheWalInAReadOnlyFolder) {
    const TemporaryFolder folder;
    write_killed(folder / "a.db");
    fs::permissions(folder / "", fs::perms{0555});
    const bool was_root = geteuid() == 0 && seteuid(65534) == 0;  // root may write to any folder
    const PrivacyReport report = privacy_report(folder / "a.db");
    ASSERT_TRUE(!was_root || seteuid(0) == 0);
    fs::permissions(folder / "", fs::perms::owner_all);
    expect_the_path(report);
}

TEST(PrivacyOfADatabase, ReadsTheWalOfALinksTarget) {
    const TemporaryFolder folder, elsewhere;
    write_killed(folder / "a.db");
    fs::create_symlink(folder / "a.db", elsewhere / "link.db");
    expect_the_path(privacy_report(elsewhere / "link.db"));

    ASSERT_EQ(mkfifo((folder / "a.db-journal").c_str(), 0600), 0);
    const std::string error = privacy_report(elsewhere / "link.db").error;
    EXPECT_TRUE(error.starts_with((elsewhere / "link.db") + ": is a link to ")) << error;
    EXPECT_NE(error.find("a.db-journal: this is a FIFO"), std::string::npos) << error;
}

TEST(PrivacyOfADatabase, ReportsADamagedOneFirst) {
    const TemporaryFolder folder;
    const std::string file = folder / "a.db";
    sqlite3* writer = nullptr;
    ASSERT_EQ(sqlite3_open(file.c_str(), &writer), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(writer, "CREATE TABLE notes (bytes); INSERT INTO notes VALUES (zeroblob(90000))", nullptr,
                           nullptr, nullptr),
              SQLITE_OK);
    sqlite3_close(writer);
    EXPECT_FALSE(privacy_report(file).is_partial);

    for (const std::uintmax_t size : {50'000u, 4096u}) {
        fs::resize_file(file, size);
        const PrivacyReport report = privacy_report(file);
        EXPECT_TRUE(report.is_partial) << size;
        const std::string text = privacy_text("a.db", report, false);
        EXPECT_TRUE(text.starts_with("a.db: not checked to its end; in the rest: no personal data found\n")) << text;
        EXPECT_NE(text.find("it is damaged"), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace kerf::app
