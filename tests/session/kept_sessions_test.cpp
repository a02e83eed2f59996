// SPDX-License-Identifier: Apache-2.0
// tests/sessions holds a session of each schema. Every build reads all of them.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>

#include "session/read_session.h"
#include "session/recorder.h"
#include "session/report/read_run.h"
#include "session/report/report.h"
#include "session/session_file.h"
#include "session/summary.h"

namespace kerf::session {
namespace {

const std::string folder = KERF_SOURCE_DIR "/tests/sessions/";

std::string session_of(std::int32_t schema) { return folder + "schema-" + std::to_string(schema) + ".db"; }

std::int64_t schema_of(const std::string& path) {
    SessionFile file;
    EXPECT_EQ(file.open(path, {}), "");
    SessionQuery version(file.handle(), "PRAGMA user_version");
    return version.next() ? version.integer(0) : -1;
}

class KeptSession : public testing::TestWithParam<std::int32_t> {};

TEST_P(KeptSession, IsThereAndOfItsSchema) {
    ASSERT_TRUE(std::filesystem::exists(session_of(GetParam())))
        << "tests/sessions lacks a session of schema " << GetParam() << "; its README.md says how to make one";
    EXPECT_EQ(schema_of(session_of(GetParam())), GetParam());
    EXPECT_LT(std::filesystem::file_size(session_of(GetParam())), 100'000u);
}

TEST_P(KeptSession, HasAReport) {
    std::string error;
    const auto run = read_run(session_of(GetParam()), error);
    ASSERT_TRUE(run) << error;
    EXPECT_EQ(run->missing, "");
    EXPECT_EQ(run->drawn.ticks(), run->summary.ticks);
    EXPECT_EQ(run->drawn.last()->tick + 1, run->summary.ticks);
    EXPECT_EQ(run->procedure.title, "Opening a pedicle with an awl");
    EXPECT_FALSE(run->drawn.bone().is_empty());
    EXPECT_FALSE(report_html(run->summary, run->drawn, run->procedure).empty());
}

TEST_P(KeptSession, HasZonesFromTheirSchemaOn) {
    std::string error;
    const auto run = read_run(session_of(GetParam()), error);
    ASSERT_TRUE(run) << error;
    EXPECT_EQ(run->summary.zones.size(), GetParam() < first_schema_with_zones ? 0u : 1u);
}

TEST_P(KeptSession, GivesTheInputsOfAReplay) {
    std::string error;
    const auto inputs = read_session(session_of(GetParam()), error);
    ASSERT_TRUE(inputs) << error;
    EXPECT_EQ(inputs->rows, GetParam() < first_schema_with_checksum ? RecordCheck::unknown : RecordCheck::same);
    EXPECT_EQ(inputs->hash.size(), 16u);

    // The same run as in the oldest of them, bit by bit
    const auto oldest = read_session(session_of(oldest_readable_schema_version), error);
    ASSERT_TRUE(oldest) << error;
    EXPECT_EQ(inputs->hash, oldest->hash);
    EXPECT_EQ(inputs->procedure_text, oldest->procedure_text);
    ASSERT_EQ(inputs->device_from_handle.size(), oldest->device_from_handle.size());
    EXPECT_EQ(std::memcmp(inputs->device_from_handle.data(), oldest->device_from_handle.data(),
                          oldest->device_from_handle.size() * sizeof(Pose)),
              0);
}

TEST_P(KeptSession, HasTheSummaryOfTheOldestOne) {
    std::string error;
    const auto run = read_run(session_of(GetParam()), error),
               oldest = read_run(session_of(oldest_readable_schema_version), error);
    ASSERT_TRUE(run && oldest) << error;
    EXPECT_EQ(summary_json(run->summary), summary_json(oldest->summary));
}

INSTANTIATE_TEST_SUITE_P(OfSchema, KeptSession,
                         testing::Range(oldest_readable_schema_version, session_schema_version + 1));

}  // namespace
}  // namespace kerf::session
