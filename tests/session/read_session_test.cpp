// SPDX-License-Identifier: Apache-2.0
#include "session/read_session.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "session/recorder.h"
#include "synthetic_run.h"
#include "tests/support/plain_session.h"
#include "tests/support/temporary_folder.h"

namespace kerf::session {
namespace {

enum class Rows { compressed, plain };

/// A session of ten ticks, at rest a little beside the origin, changed by `sql`.
std::string session_after(const test::TemporaryFolder& folder, const std::string& sql, Rows rows = Rows::plain) {
    std::string path = folder / "session.db";
    auto recorder = Recorder::create(path, {}).recorder;
    for (std::uint64_t tick = 0; tick < 10; ++tick) {
        TickRow row;
        row.tick = tick;
        row.device_from_handle = {{0.001, 0.0, -0.002}, {1, 0, 0, 0}};
        recorder->push(row);
    }
    EXPECT_EQ(recorder->finish(test::synthetic_summary()), "");
    if (rows == Rows::plain) {
        EXPECT_EQ(test::make_rows_plain(path), "");
    }
    EXPECT_EQ(test::run_sql(path, sql), "") << sql;
    return path;
}

std::string refusal_after(const std::string& sql, Rows rows = Rows::plain) {
    const test::TemporaryFolder folder;
    std::string error;
    EXPECT_FALSE(read_session(session_after(folder, sql, rows), error)) << sql;
    return error;
}

TEST(ReadSession, GivesEveryPoseInOrder) {
    for (const Rows rows : {Rows::compressed, Rows::plain}) {
        const test::TemporaryFolder folder;
        std::string error;
        const auto inputs = read_session(session_after(folder, "", rows), error);
        ASSERT_TRUE(inputs) << error;
        ASSERT_EQ(inputs->device_from_handle.size(), 10u);
        EXPECT_EQ(inputs->device_from_handle[9].position.z, -0.002);
        EXPECT_EQ(inputs->hash, "0123456789abcdef");
    }
}

TEST(ReadSession, ABlockThatIsDamagedIsRefused) {
    const std::string pose = " WHERE column_name='device_from_handle_qx'";
    for (const auto& [sql, words] : std::vector<std::pair<std::string, std::string>>{
             {"UPDATE blocks SET data=substr(data, 1, 9)" + pose, "damaged column `device_from_handle_qx`"},
             {"UPDATE blocks SET rows=1000000000", "has 1000000000 rows"},
             {"DELETE FROM blocks" + pose, "lacks its column `device_from_handle_qx`"},
             {"UPDATE blocks SET data=(SELECT data FROM blocks WHERE column_name='device_from_handle_qw')" + pose,
              "tick 0 holds no pose"},
             {"UPDATE blocks SET differences=0 WHERE column_name='tick'", "is missing, so it cannot be replayed"},
             {"DELETE FROM blocks WHERE table_name='ticks'", "holds no ticks"},
             {"DROP TABLE blocks", "`blocks` cannot be read"}})
        EXPECT_NE(refusal_after(sql, Rows::compressed).find(words), std::string::npos)
            << sql << ": " << refusal_after(sql, Rows::compressed);
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
    EXPECT_NE(refusal_after("PRAGMA user_version=9").find("schema 9, need 2 to 5"), std::string::npos);
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
}  // namespace kerf::session
