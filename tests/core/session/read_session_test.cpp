// SPDX-License-Identifier: Apache-2.0
#include "core/session/read_session.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/session/recorder.h"
#include "synthetic_run.h"
#include "tests/support/temporary_folder.h"

namespace kerf {
namespace {

/// A session of ten ticks, at rest a little beside the origin, changed by `sql`.
std::string session_after(const test::TemporaryFolder& folder, const std::string& sql) {
    std::string path = folder / "session.db";
    auto recorder = Recorder::create(path, {}).recorder;
    for (std::uint64_t tick = 0; tick < 10; ++tick) {
        TickRow row;
        row.tick = tick;
        row.device_from_handle = {{0.001, 0.0, -0.002}, {1, 0, 0, 0}};
        recorder->push(row);
    }
    EXPECT_EQ(recorder->finish(test::synthetic_summary()), "");
    sqlite3* database = nullptr;
    EXPECT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
    sqlite3_close(database);
    return path;
}

std::string refusal_after(const std::string& sql) {
    const test::TemporaryFolder folder;
    std::string error;
    EXPECT_FALSE(read_session(session_after(folder, sql), error)) << sql;
    return error;
}

TEST(ReadSession, GivesEveryPoseInOrder) {
    const test::TemporaryFolder folder;
    std::string error;
    const auto inputs = read_session(session_after(folder, ""), error);
    ASSERT_TRUE(inputs) << error;
    ASSERT_EQ(inputs->device_from_handle.size(), 10u);
    EXPECT_EQ(inputs->device_from_handle[9].position.z, -0.002);
    EXPECT_EQ(inputs->hash, "0123456789abcdef");
}

TEST(ReadSession, APoseThatIsNoneIsRefusedWithItsTick) {
    for (const char* what : {"device_from_handle_x=9e999", "device_from_handle_x=1e300", "device_from_handle_y=NULL",
                             "device_from_handle_z='abc'", "device_from_handle_qw=0", "device_from_handle_qx=1"})
        EXPECT_NE(refusal_after(std::string("UPDATE ticks SET ") + what + " WHERE tick=7").find("tick 7 holds no pose"),
                  std::string::npos)
            << what;
}

TEST(ReadSession, AMissingTickOrAnotherSchemaIsRefused) {
    EXPECT_NE(refusal_after("DELETE FROM ticks WHERE tick=5").find("tick 5 is missing"), std::string::npos);
    EXPECT_NE(refusal_after("DELETE FROM ticks").find("holds no ticks"), std::string::npos);
    EXPECT_NE(refusal_after("PRAGMA user_version=9").find("schema 9, need 2 or 3"), std::string::npos);
}

TEST(ReadSession, RowsThatAreComputedAreRefused) {
    // Nobody could say when this one ends
    EXPECT_NE(
        refusal_after("ALTER TABLE ticks RENAME TO old; CREATE VIEW ticks AS WITH RECURSIVE n(tick) AS (SELECT 0 UNION "
                      "ALL SELECT tick + 1 FROM n) SELECT n.tick AS tick, old.* FROM n, old")
            .find("computes its table `ticks`"),
        std::string::npos);
    EXPECT_NE(refusal_after("ALTER TABLE session ADD COLUMN more AS (printf('%.*c', 9, 'x'))")
                  .find("computes its table `session`"),
              std::string::npos);
    EXPECT_NE(refusal_after("DROP TABLE ticks; CREATE VIRTUAL TABLE ticks USING rtree(tick, a, b)")
                  .find("computes its table `ticks`"),
              std::string::npos);
}

TEST(ReadSession, ADamagedOrCutFileIsRefused) {
    const test::TemporaryFolder folder;
    const std::string path = session_after(folder, "");
    for (const std::uintmax_t size :
         {std::uintmax_t{20'000}, std::uintmax_t{5000}, std::uintmax_t{100}, std::uintmax_t{0}}) {
        std::filesystem::resize_file(path, size);
        std::string error;
        EXPECT_FALSE(read_session(path, error)) << size;
        EXPECT_NE(error, "");
    }
}

}  // namespace
}  // namespace kerf
