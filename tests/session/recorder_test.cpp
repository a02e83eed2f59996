// SPDX-License-Identifier: Apache-2.0
#include "session/recorder.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "session/content_hash.h"
#include "session/output_folder.h"
#include "session/read_session.h"
#include "session/report/drawn_run.h"
#include "session/report/read_run.h"
#include "synthetic_run.h"
#include "tests/support/loop_guard.h"
#include "tests/support/plain_session.h"
#include "tests/support/temporary_folder.h"

namespace kerf::session {
namespace {

using test::contents_of;
using test::TemporaryFolder;

/// One answer of one query, as text.
std::string ask(const std::string& path, const std::string& sql) {
    sqlite3* database = nullptr;
    sqlite3_stmt* statement = nullptr;
    std::string answer = "no answer";
    if (sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READWRITE, nullptr) == SQLITE_OK &&
        sqlite3_prepare_v2(database, sql.c_str(), -1, &statement, nullptr) == SQLITE_OK &&
        sqlite3_step(statement) == SQLITE_ROW) {
        const unsigned char* text = sqlite3_column_text(statement, 0);
        answer = text == nullptr ? "" : reinterpret_cast<const char*>(text);
    } else {
        answer = sqlite3_errmsg(database);
    }
    sqlite3_finalize(statement);
    sqlite3_close(database);
    return answer;
}

SessionHeader header() {
    SessionHeader header;
    header.procedure_text = "kind: Procedure\nid: pilot-hole\n";
    header.anatomy_hash = hash_of_text("kind: Anatomy\n");
    header.anatomy_notes = {"Mask: 7 voxels.", "Cortex: prescribed."};
    header.versions = {{"kerf", "0.1.0"}};
    header.envelope.uuid = "00000000-0000-4000-8000-000000000000";
    header.envelope.learner = "L17";
    header.conditions = {.device = "touch", .force_scale = 0.05, .assist = "", .coupling_stiffness = 700.0};
    header.signals = {{"chip.thickness", "uncut chip", "um", 1e-6}};
    header.tissues = {"cortical", "cancellous"};
    return header;
}

std::unique_ptr<Recorder> new_recorder(const std::string& path) {
    Recorder::Created created = Recorder::create(path, header());
    EXPECT_EQ(created.error, "");
    return std::move(created.recorder);
}

TickRow numbered_tick(std::uint64_t tick) {
    TickRow row;
    row.tick = tick;
    row.time = 1e-3 * static_cast<double>(tick);
    row.thrust = 0.5 * static_cast<double>(tick);
    row.signals[0] = 2e-6;
    return row;
}

/// A tick without zeros, which SQLite keeps in no space: 600 bytes in a file.
TickRow full_tick(std::uint64_t tick) {
    TickRow row = numbered_tick(tick);
    const double value = 0.1 + 1e-3 * static_cast<double>(tick);
    for (Vec6* wrench : {&row.modelled, &row.coupled, &row.limited, &row.commanded}) wrench->fill(value);
    row.device_from_handle = row.world_from_tool = {{value, value, value}, {0.5, 0.1, 0.2, 0.3}};
    for (double* number :
         {&row.thrust, &row.torque, &row.depth, &row.feed_rate, &row.power_hand, &row.power_drive, &row.removed})
        *number = value;
    return row;
}

TEST(Recorder, ASessionIsOneFileWithEveryRowPushed) {
    // Given a session in lock-step, faster than the disk if nobody waits
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    auto recorder = new_recorder(path);

    // When 30 000 ticks, some cuts and events are pushed
    for (std::uint64_t tick = 0; tick < 30'000; ++tick) {
        recorder->push(numbered_tick(tick));
        if (tick % 10 == 0) recorder->push_cut({.sequence = tick / 10, .tick = tick});
        if (tick % 1000 == 0) recorder->push_event({tick, 0.0, "entry", "first bone met"});
        ASSERT_TRUE(recorder->wait_for_capacity());
    }
    ASSERT_EQ(recorder->finish(test::synthetic_summary()), "");

    // Then all of them are there, in a file that stands alone
    EXPECT_FALSE(recorder->losses().any());
    EXPECT_EQ(ask(path, "PRAGMA integrity_check"), "ok");
    EXPECT_EQ(ask(path, "PRAGMA journal_mode"), "delete");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), std::filesystem::directory_iterator()),
              1);
    ASSERT_EQ(test::make_rows_plain(path), "");
    EXPECT_EQ(ask(path, "SELECT count(*) || ' ' || max(tick) || ' ' || sum(thrust) FROM ticks"),
              "30000 29999 224992500.0");
    EXPECT_EQ(ask(path, "SELECT count(*) || ' ' || max(sequence) || ' ' || max(tick) FROM cuts"), "3000 2999 29990");
    EXPECT_EQ(ask(path, "SELECT count(*) FROM events"), "30");
}

TEST(Recorder, CompressesAllRowsOfAFinishedSession) {
    // Given more rows than two blocks hold
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    auto recorder = new_recorder(path);
    for (std::uint64_t tick = 0; tick < 10'000; ++tick) {
        recorder->push(full_tick(tick));
        if (tick % 2 == 0) recorder->push_cut({.sequence = tick / 2, .tick = tick});
        ASSERT_TRUE(recorder->wait_for_capacity());
    }
    ASSERT_EQ(recorder->finish(test::synthetic_summary()), "");

    // Then there is no plain row, blocks begin at fixed rows, and the file has no free pages
    EXPECT_EQ(ask(path, "SELECT (SELECT count(*) FROM ticks) || ' ' || (SELECT count(*) FROM cuts)"), "0 0");
    EXPECT_EQ(ask(path, "SELECT group_concat(rows) FROM blocks WHERE table_name='ticks' AND column_name='tick'"),
              "4096,4096,1808");
    EXPECT_EQ(ask(path, "SELECT group_concat(rows) FROM blocks WHERE table_name='cuts' AND column_name='tick'"),
              "4096,904");
    EXPECT_EQ(ask(path, "PRAGMA freelist_count"), "0");
    EXPECT_LT(std::filesystem::file_size(path), 1u << 20) << "plain rows take 6 MB";
}

TEST(Recorder, WritesTheSameBlocksForTheSameRows) {
    const TemporaryFolder folder;
    const auto blocks_of = [&](const std::string& name, bool is_slow) {
        auto recorder = new_recorder(folder / name);
        for (std::uint64_t tick = 0; tick < 9'000; ++tick) {
            recorder->push(full_tick(tick));
            recorder->wait_for_capacity();
            if (is_slow && tick % 1000 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(150));
        }
        EXPECT_EQ(recorder->finish(test::synthetic_summary()), "");
        return ask(folder / name,
                   "SELECT group_concat(block || column_name || rows || differences || hex(data)) FROM blocks");
    };
    const std::string fast = blocks_of("fast.db", false);
    EXPECT_GT(fast.size(), 10'000u);
    EXPECT_TRUE(fast == blocks_of("slow.db", true));
}

/// The pose that the device reported in a tick, as a replay reads it.
Pose read_back(const std::string& path, std::size_t tick) {
    std::string error;
    const auto inputs = read_session(path, error);
    EXPECT_TRUE(inputs) << error;
    return inputs && tick < inputs->device_from_handle.size() ? inputs->device_from_handle[tick] : Pose{};
}

TEST(Recorder, KeepsEachBitOfAReplaysInputs) {
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    auto recorder = new_recorder(path);
    TickRow row = numbered_tick(0);
    row.device_from_handle = {{-0.0, 0.1, std::nextafter(0.1, 1.0)}, {1.0, -0.0, 5e-324, -1e-17}};
    recorder->push(row);
    ASSERT_EQ(recorder->finish(test::synthetic_summary()), "");

    const auto bits = [](const Pose& pose) {
        const auto& [p, q] = pose;
        std::vector<std::uint64_t> all;
        for (const double number : {p.x, p.y, p.z, q.w, q.x, q.y, q.z})
            all.push_back(std::bit_cast<std::uint64_t>(number));
        return all;
    };
    EXPECT_EQ(bits(read_back(path, 0)), bits(row.device_from_handle));
}

TEST(Recorder, AFinishedSessionHoldsItsResult) {
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    ASSERT_EQ(new_recorder(path)->finish(test::synthetic_summary()), "");

    EXPECT_EQ(ask(path, "SELECT value FROM session WHERE key='state'"), "finished");
    EXPECT_EQ(ask(path, "SELECT value FROM session WHERE key='hash'"), "0123456789abcdef");
    EXPECT_EQ(ask(path, "SELECT json_extract(value, '$.verdict') FROM session WHERE key='summary'"), "fail");
    EXPECT_EQ(ask(path, "SELECT broken_limits FROM steps WHERE id='pilot-hole'"), "clearance to spinal-canal\ndepth");
    EXPECT_EQ(ask(path, "SELECT count(*) FROM metrics"), "4");
    EXPECT_EQ(ask(path, "SELECT uncertainty IS NULL FROM metrics WHERE id='pilot-hole.peak-thrust'"), "1");
}

TEST(Recorder, ASessionDescribesItself) {
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    new_recorder(path).reset();

    EXPECT_EQ(ask(path, "PRAGMA application_id"), std::to_string(0x4b455246));
    EXPECT_EQ(ask(path, "PRAGMA user_version"), std::to_string(session_schema_version));
    EXPECT_EQ(ask(path, "SELECT text FROM notice"),
              "For training and research; not for diagnosis, planning or deciding treatment");
    EXPECT_EQ(ask(path, "SELECT unit || ', ' || dimension || ', ' || frame FROM columns WHERE table_name='ticks' AND "
                        "name='modelled_fz'"),
              "N, force, world");
    EXPECT_EQ(ask(path, "SELECT column_name || ', ' || unit FROM signals WHERE id='chip.thickness'"),
              "signal_chip_thickness, m");
    EXPECT_EQ(ask(path, "SELECT group_concat(name || ' ' || format, ', ') FROM columns WHERE table_name='ticks' AND "
                        "name IN ('tick', 'device_from_handle_x', 'thrust')"),
              "tick int64, device_from_handle_x float64, thrust float32");
    EXPECT_EQ(ask(path, "SELECT like_column || ' ' || factor FROM columns WHERE name='commanded_mz'"),
              "coupled_mz 0.05");
    EXPECT_EQ(ask(path, "SELECT value FROM session WHERE key='anatomy_hash'"), hex16(hash_of_text("kind: Anatomy\n")));
    EXPECT_EQ(ask(path, "SELECT value FROM session WHERE key='anatomy_notes'"), "Mask: 7 voxels.\nCortex: prescribed.");
}

TEST(Recorder, EveryColumnOfEveryTableIsDescribed) {
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    new_recorder(path).reset();

    EXPECT_EQ(ask(path, "SELECT coalesce(group_concat(t.name || '.' || c.name), 'none missing') FROM sqlite_schema t, "
                        "pragma_table_info(t.name) c "
                        "WHERE t.type='table' AND NOT EXISTS (SELECT 1 FROM columns d WHERE d.table_name=t.name AND "
                        "d.name=c.name AND d.help<>'')"),
              "none missing");
}

TEST(Recorder, NamesTheUnitOfEachNumber) {
    // Given signals and metrics in all sorts of units
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    SessionHeader all = header();
    all.signals = {
        {"torque", "torque", "Nmm", 1e-3}, {"speed", "speed", "rpm", 1.0 / 60.0}, {"wear", "wear", "%", 1e-2}};
    ASSERT_EQ(Recorder::create(path, all).recorder->finish(test::synthetic_summary()), "");

    // Then each column of numbers names its unit, or says that its rows do
    EXPECT_EQ(
        ask(path, "SELECT group_concat(name || ' ' || unit, ', ') FROM columns WHERE name LIKE 'signal\\_%' ESCAPE "
                  "'\\'"),
        "signal_torque N*m, signal_speed 1/s, signal_wear ");
    EXPECT_EQ(ask(path, "SELECT group_concat(id || ' ' || unit, ', ') FROM signals"), "torque N*m, speed 1/s, wear ");
    EXPECT_EQ(
        ask(path, "SELECT group_concat(table_name || '.' || name, ', ') FROM columns WHERE unit='see column unit'"),
        "signals.per_unit, metrics.value, metrics.per_unit, metrics.uncertainty");
    EXPECT_EQ(ask(path, "SELECT group_concat(id || ' ' || unit, ', ') FROM metrics"),
              "pilot-hole.depth m, pilot-hole.clearance m, pilot-hole.peak-thrust N, pilot-hole.deviation rad");
    EXPECT_EQ(ask(path, "SELECT count(*) FROM columns WHERE unit LIKE '%SI%'"), "0");
}

TEST(Recorder, PushingNeverAllocates) {
    const TemporaryFolder folder;
    auto recorder = new_recorder(folder / "session.db");
    const TickRow row = numbered_tick(1);
    const EventRow event{1, 0.0, "entry", std::string(1000, 'x')};

    const std::size_t before = test::allocations_here();
    for (int i = 0; i < 10'000; ++i) {
        recorder->push(row);
        recorder->push_cut({});
        recorder->push_event(event);
    }
    EXPECT_EQ(test::allocations_here(), before);
}

TEST(Recorder, ATickThatFoundNoRoomIsCountedAndTheSessionIsIncomplete) {
    // Given a loop that runs away from the disk
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    auto recorder = new_recorder(path);

    // When it never waits
    constexpr std::uint64_t pushed = 200'000;
    for (std::uint64_t tick = 0; tick < pushed; ++tick) recorder->push(numbered_tick(tick));
    const std::uint64_t lost = recorder->losses().ticks;
    ASSERT_EQ(recorder->finish(test::synthetic_summary()), "");

    // Then what is missing is known, to the row
    ASSERT_GT(lost, 0u);
    EXPECT_EQ(test::row_count(path, "ticks"), static_cast<long long>(pushed - lost));
    EXPECT_EQ(ask(path, "SELECT value FROM session WHERE key='lost_ticks'"), std::to_string(lost));
    EXPECT_EQ(ask(path, "SELECT value FROM session WHERE key='state'"), "incomplete");
}

struct QueueCase {
    const char* table;
    std::function<void(Recorder&, std::uint64_t)> push;
    std::uint64_t RecorderLosses::*lost;
};

void PrintTo(const QueueCase& one, std::ostream* out) { *out << one.table; }

class RecorderQueue : public testing::TestWithParam<QueueCase> {};

TEST_P(RecorderQueue, OverrunAloneIsCountedAsItsOwnAlone) {
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    auto recorder = new_recorder(path);
    constexpr std::uint64_t pushed = 100'000;
    for (std::uint64_t i = 0; i < pushed; ++i) GetParam().push(*recorder, i);
    const RecorderLosses losses = recorder->losses();
    ASSERT_EQ(recorder->finish(test::synthetic_summary()), "");

    ASSERT_GT(losses.*GetParam().lost, 0u);
    EXPECT_EQ(losses.ticks + losses.events + losses.cuts, losses.*GetParam().lost) << "no other is lost";
    EXPECT_TRUE(losses.any());
    for (const char* table : {"ticks", "events", "cuts"}) {
        const bool is_this = table == std::string(GetParam().table);
        const std::uint64_t lost = is_this ? losses.*GetParam().lost : 0;
        EXPECT_EQ(ask(path, std::string("SELECT value FROM session WHERE key='lost_") + table + "'"),
                  std::to_string(lost));
        const std::string kept = table == std::string("events") ? ask(path, "SELECT count(*) FROM events")
                                                                : std::to_string(test::row_count(path, table));
        EXPECT_EQ(kept, std::to_string(is_this ? pushed - lost : 0));
    }
    EXPECT_EQ(ask(path, "SELECT value FROM session WHERE key='state'"), "incomplete");
}

INSTANTIATE_TEST_SUITE_P(
    Each, RecorderQueue,
    testing::Values(QueueCase{"ticks", [](Recorder& r, std::uint64_t i) { r.push(numbered_tick(i)); },
                              &RecorderLosses::ticks},
                    QueueCase{"events",
                              [](Recorder& r, std::uint64_t i) {
                                  r.push_event({i, 0.0, "entry", ""});
                              },
                              &RecorderLosses::events},
                    QueueCase{"cuts", [](Recorder& r, std::uint64_t i) { r.push_cut({.sequence = i, .tick = i}); },
                              &RecorderLosses::cuts}),
    [](const auto& one) { return std::string(one.param.table); });

TEST(Recorder, StoresEachValueInItsOwnColumn) {
    // Given rows whose numbers are all different
    TickRow row;
    row.tick = 41;
    row.time = 42;
    row.step = 43;
    row.device_from_handle = {{1, 2, 3}, {4, 5, 6, 7}};
    row.world_from_tool = {{8, 9, 10}, {11, 12, 13, 14}};
    row.modelled = {15, 16, 17, 18, 19, 20};
    row.coupled = {21, 22, 23, 24, 25, 26};
    row.limited = {27, 28, 29, 30, 31, 32};
    row.commanded = {33, 34, 35, 36, 37, 38};
    row.thrust = 44;
    row.torque = 45;
    row.depth = 46;
    row.feed_rate = 47;
    row.tissue = 48;
    row.iterations = 49;
    row.power_hand = 50;
    row.power_drive = 51;
    row.removed = 52;
    row.signals[0] = 53;
    const CutRow cut{61, 62, 63, 64, {{65, 66, 67}, {68, 69, 70, 71}}, {{72, 73, 74}, {75, 76, 77, 78}}};
    const EventRow event{81, 82.5, "entry", "first bone met"};

    // When they are recorded
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    auto recorder = new_recorder(path);
    recorder->push(row);
    recorder->push_cut(cut);
    recorder->push_event(event);
    ASSERT_EQ(recorder->finish(test::synthetic_summary()), "");
    ASSERT_EQ(test::make_rows_plain(path), "");

    // Then each is in the column of its name
    const auto expect_columns = [&](const std::string& table,
                                    const std::vector<std::pair<std::string, double>>& columns) {
        for (const auto& [name, value] : columns) {
            const std::string text = ask(path, "SELECT " + name + " FROM " + table);
            double stored = 0.0;  // read as in any locale
            std::from_chars(text.data(), text.data() + text.size(), stored);
            EXPECT_EQ(stored, value) << table << "." << name;
        }
    };
    const std::string pose[] = {"x", "y", "z", "qw", "qx", "qy", "qz"};
    const std::string wrench[] = {"fx", "fy", "fz", "mx", "my", "mz"};
    std::vector<std::pair<std::string, double>> ticks{{"tick", 41},
                                                      {"time", 42},
                                                      {"step", 43},
                                                      {"thrust", 44},
                                                      {"torque", 45},
                                                      {"depth", 46},
                                                      {"feed_rate", 47},
                                                      {"tissue", 48},
                                                      {"iterations", 49},
                                                      {"power_hand", 50},
                                                      {"power_drive", 51},
                                                      {"removed", 52},
                                                      {"signal_chip_thickness", 53}};
    double next = 1;
    for (const char* of : {"device_from_handle_", "world_from_tool_"})
        for (const auto& part : pose) ticks.emplace_back(of + part, next++);
    for (const char* of : {"modelled_", "coupled_", "limited_", "commanded_"})
        for (const auto& part : wrench) ticks.emplace_back(of + part, next++);
    expect_columns("ticks", ticks);
    std::vector<std::pair<std::string, double>> cuts{{"sequence", 61}, {"tick", 62}, {"body", 63}, {"solid", 64}};
    next = 65;
    for (const char* of : {"from_", "to_"})
        for (const auto& part : pose) cuts.emplace_back(of + part, next++);
    expect_columns("cuts", cuts);
    expect_columns("events", {{"tick", 81}, {"time", 82.5}});
    EXPECT_EQ(ask(path, "SELECT id || '|' || detail FROM events"), "entry|first bone met");
}

TEST(Recorder, StoresEachHeaderEntryUnderItsOwnKey) {
    SessionHeader full = header();
    full.procedure = "p1";
    full.procedure_version = "p2";
    full.anatomy = "p3";
    full.rehearsal = "p4";
    full.hand = "p5";
    full.envelope = {"e1", "e2", "e3", "exam", "e5", "e6", "e7"};
    full.conditions = {
        .device = "c1", .force_scale = 0.25, .assist = "c3", .coupling_stiffness = 700.5, .variant = "c5"};
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    Recorder::create(path, full).recorder.reset();

    for (const auto& [key, value] : std::map<std::string, std::string>{{"run.procedure", "p1"},
                                                                       {"run.procedure_version", "p2"},
                                                                       {"run.anatomy", "p3"},
                                                                       {"run.rehearsal", "p4"},
                                                                       {"run.hand", "p5"},
                                                                       {"version.kerf", "0.1.0"},
                                                                       {"condition.device", "c1"},
                                                                       {"condition.force_scale", "0.25"},
                                                                       {"condition.assist", "c3"},
                                                                       {"condition.coupling_stiffness", "700.5"},
                                                                       {"condition.variant", "c5"}})
        EXPECT_EQ(ask(path, "SELECT value FROM session WHERE key='" + key + "'"), value) << key;
    for (const auto& [key, value] : std::map<std::string, std::string>{{"uuid", "e1"},
                                                                       {"learner", "e2"},
                                                                       {"cohort", "e3"},
                                                                       {"mode", "exam"},
                                                                       {"station", "e5"},
                                                                       {"start", "e6"},
                                                                       {"consent", "e7"}})
        EXPECT_EQ(ask(path, "SELECT value FROM envelope WHERE key='" + key + "'"), value) << key;
    EXPECT_EQ(ask(path, "SELECT group_concat(position || id) FROM tissues"), "0cortical,1cancellous");
    EXPECT_EQ(ask(path, "SELECT position || id || '|' || column_name || '|' || unit || '|' || display_unit || '|' || "
                        "per_unit || '|' "
                        "|| help FROM signals"),
              "0chip.thickness|signal_chip_thickness|m|um|1.0e-06|uncut chip");
}

TEST(Recorder, ASessionGivenUpIsIncompleteButWhole) {
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    {
        auto recorder = new_recorder(path);
        for (std::uint64_t tick = 0; tick < 100; ++tick) recorder->push(numbered_tick(tick));
    }
    EXPECT_EQ(ask(path, "SELECT value FROM session WHERE key='state'"), "incomplete");
    EXPECT_EQ(test::row_count(path, "ticks"), 100);
}

TEST(Recorder, AnEventTooLongIsCutBetweenLetters) {
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    auto recorder = new_recorder(path);
    std::string id(62, 'a');
    id += "é";  // two bytes, of which one would fit
    recorder->push_event({1, 0.0, id, ""});
    recorder.reset();
    EXPECT_EQ(ask(path, "SELECT id FROM events"), std::string(62, 'a'));
}

TEST(Recorder, SaysWhyAFileCannotBeMade) {
    const TemporaryFolder folder;
    const Recorder::Created created = Recorder::create(folder / "missing/session.db", {});
    EXPECT_EQ(created.recorder, nullptr);
    EXPECT_NE(created.error.find("session.db could not be made"), std::string::npos) << created.error;
}

TEST(Recorder, WritesNeitherThePathNorTheUserNorTheHost) {
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    auto recorder = new_recorder(path);
    recorder->push(numbered_tick(1));
    ASSERT_EQ(recorder->finish(test::synthetic_summary()), "");

    const std::string bytes = contents_of(path);
    char host[256]{};
    gethostname(host, sizeof host - 1);
    EXPECT_EQ(bytes.find(folder.path()), std::string::npos);
    const char* user = std::getenv("USER");
    for (const std::string& name : {std::string(host), std::string(user != nullptr ? user : "")}) {
        const bool is_telling = name.size() > 3;  // shorter ones stand in any file by chance
        EXPECT_FALSE(is_telling && bytes.find(name) != std::string::npos) << name;
    }
}

bool has_every_tick_up_to_its_last(const std::string& path) {
    std::string error;
    const auto run = read_run(path, error);
    EXPECT_TRUE(run) << error;
    return run && run->drawn.last() && run->drawn.last()->tick + 1 == run->drawn.ticks();
}

/// Records in a child process that `prepare` has put under a limit, until the file takes no more. The answer of
/// `finish`.
std::string recorded_until_full(const std::string& path, const std::function<bool()>& prepare) {
    int ends[2];
    if (pipe(ends) != 0) return "no pipe";
    const pid_t child = fork();
    if (child == 0) {
        if (!prepare()) _exit(1);
        auto recorder = new_recorder(path);
        bool has_room = recorder != nullptr;
        for (std::uint64_t tick = 0; has_room && tick < 60'000; ++tick) {
            recorder->push(numbered_tick(tick));
            has_room = recorder->wait_for_capacity();
        }
        const std::string error = recorder == nullptr ? "no recorder" : recorder->finish(test::synthetic_summary());
        // What a later look at the file finds, while the limit and the mount still are there
        const std::string answer = error + "|" + ask(path, "SELECT value FROM session WHERE key='state'") + "|" +
                                   ask(path, "PRAGMA integrity_check") + "|" +
                                   (has_every_tick_up_to_its_last(path) ? "1" : "0");
        _exit(write(ends[1], answer.data(), answer.size()) < 0);
    }
    close(ends[1]);
    std::string answer;
    char some[512];
    for (ssize_t count = 0; (count = read(ends[0], some, sizeof some)) > 0;)
        answer.append(some, static_cast<std::size_t>(count));
    close(ends[0]);
    waitpid(child, nullptr, 0);
    return answer;
}

TEST(Recorder, AFileThatMayNotGrowEndsIncompleteAndWhole) {
    const TemporaryFolder folder;
    const std::string answer = recorded_until_full(folder / "session.db", [] {
        signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{2'000'000, 2'000'000};  // [byte]
        return setrlimit(RLIMIT_FSIZE, &limit) == 0;
    });
    EXPECT_NE(answer.find("session.db is incomplete: the limit of file size is 1953 kB. Raise it"), std::string::npos)
        << answer;
    EXPECT_TRUE(answer.ends_with("|incomplete|ok|1")) << answer;
}

TEST(Recorder, AFullDiskIsSaidAndTheSessionIsIncompleteAndWhole) {
    const TemporaryFolder folder;
    const std::string answer = recorded_until_full(folder / "session.db", [&] {
        // A disk of our own, seen by nobody else and gone with the process
        if (unshare(CLONE_NEWNS) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
        mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr);
        return mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=3m") == 0;
    });
    if (answer.empty()) GTEST_SKIP() << "no disk of our own can be mounted here";
    EXPECT_TRUE(answer.starts_with((folder / "session.db") + " is incomplete: the disk is full. Free some space"))
        << answer;
    EXPECT_TRUE(answer.ends_with("|incomplete|ok|1")) << answer;
}

TEST(Recorder, ThatCannotBeMadeLeavesNothing) {
    const TemporaryFolder folder;
    const pid_t child = fork();
    if (child == 0) {
        signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{0, 0};
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(2);
        _exit(Recorder::create(folder / "session.db", header()).error.empty() ? 1 : 0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Recorder, ThatIsKilledWhileItIsMadeLeavesAFolderForTheNext) {
    // Given a child that makes sessions one after the other, killed at odd moments
    for (int delay = 0; delay < 40; ++delay) {
        const TemporaryFolder folder;
        const pid_t child = fork();
        if (child == 0)
            for (;;) {
                text::OutputLock lock;
                text::MadeFolders made;
                if (!prepare_output(folder.path(), lock, made).empty()) _exit(1);
                auto recorder = Recorder::create(folder / "session.db", header()).recorder;
            }
        usleep(static_cast<useconds_t>(3000 + 577 * delay));
        kill(child, SIGKILL);
        int status = 0;
        waitpid(child, &status, 0);
        ASSERT_TRUE(WIFSIGNALED(status)) << "its own folder was refused";

        // Then the next run takes the folder, and what is there is a session or nothing
        EXPECT_TRUE(!std::filesystem::exists(folder / "session.db") ||
                    ask(folder / "session.db", "PRAGMA application_id") == std::to_string(session_application_id));
        text::OutputLock lock;
        text::MadeFolders made;
        EXPECT_EQ(prepare_output(folder.path(), lock, made), "");
    }
}

TEST(Recorder, KeepsItsWalShort) {
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    auto recorder = new_recorder(path);
    std::uintmax_t longest = 0, largest = 0;
    bool is_long = false;
    for (std::uint64_t tick = 0; tick < 120'000; ++tick) {  // over 50 MB
        recorder->push(full_tick(tick));
        ASSERT_TRUE(recorder->wait_for_capacity());
        if (is_long) usleep(1000);  // as slow as a run: on a busy machine the merge needs its time
        if (tick % 1000 != 0) continue;
        std::error_code not_there;
        const auto bytes = std::filesystem::file_size(path + "-wal", not_there);
        is_long = !not_there && bytes > (20u << 20);
        if (!not_there) longest = std::max(longest, bytes);
        largest = std::max(largest, std::filesystem::file_size(path));
    }
    ASSERT_EQ(recorder->finish(test::synthetic_summary()), "");
    EXPECT_EQ(test::row_count(path, "ticks"), 120'000);
    EXPECT_LT(longest, 40u << 20);
    EXPECT_LT(largest, 20u << 20) << "pages of compressed rows are used again";
}

TEST(Recorder, SaysThatACompleteSessionCouldNotBeFolded) {
    // Given a file that may not grow any more, and rows that are in the -wal alone
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    const pid_t child = fork();
    if (child == 0) {
        signal(SIGXFSZ, SIG_IGN);
        auto recorder = new_recorder(path);
        std::uint64_t tick = 0;
        const auto push = [&](std::uint64_t count) {
            for (const std::uint64_t end = tick + count; tick < end; ++tick) {
                recorder->push_event({tick, 0.0, "entry", std::string(255, 'x')});  // never compressed
                if (!recorder->wait_for_capacity()) _exit(3);
            }
        };
        // The -wal must have room below the file's length: wait until it has been folded in and begun anew.
        while (std::filesystem::file_size(path) < 14u << 20 && tick < 100'000) push(1);
        while (std::filesystem::file_size(path + "-wal") > 4u << 20 && tick < 200'000) {
            push(1);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        const rlim_t length = std::filesystem::file_size(path);
        const rlimit limit{length, length};
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(2);
        push(1000);
        const std::string said = recorder->finish(test::synthetic_summary());
        _exit(said.find("is complete together with session.db-wal") != std::string::npos ? 0 : said.empty() ? 5 : 6);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 0);

    // Then it is read with its -wal, whole
    std::string error;
    const auto run = read_run(path, error);
    ASSERT_TRUE(run) << error;
    EXPECT_EQ(run->missing, "");
}

/// A tick that no compression shortens by much.
TickRow noisy_tick(std::uint64_t tick) {
    TickRow row = full_tick(tick);
    std::uint64_t noise = tick + 1;
    const auto next = [&] {
        noise = noise * 6364136223846793005u + 1442695040888963407u;
        return 1e-3 * static_cast<double>(noise >> 11);
    };
    for (Vec6* wrench : {&row.modelled, &row.coupled, &row.limited, &row.commanded})
        for (double& component : *wrench) component = next();
    return row;
}

TEST(Recorder, KeepsAllRowsWhereTheDiskIsFullForTheirCompression) {
    // Given plain rows, and a file that may grow by what the result takes, but not by a block
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    const pid_t child = fork();
    if (child == 0) {
        signal(SIGXFSZ, SIG_IGN);
        auto recorder = new_recorder(path);
        for (std::uint64_t tick = 0; tick < 4000; ++tick) recorder->push(noisy_tick(tick));
        std::uintmax_t bytes = 0;  // of the -wal, until it grows no more
        for (int quiet = 0; quiet < 5; ++quiet) {
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
            if (const auto now = std::filesystem::file_size(path + "-wal"); now != bytes) quiet = 0, bytes = now;
        }
        const rlimit limit{bytes + 150'000, bytes + 150'000};
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(2);
        const std::string said = recorder->finish(test::synthetic_summary());
        const bool is_said =
            said.find("is complete, and larger than it needs to be: some rows could not be compressed") !=
            std::string::npos;
        if (!is_said) std::fputs((said + "\n").c_str(), stderr);
        _exit(is_said ? 0 : 3);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 0);

    // Then the session is finished and has each row, plain
    EXPECT_EQ(ask(path, "PRAGMA integrity_check"), "ok");
    EXPECT_EQ(ask(path, "SELECT value FROM session WHERE key='state'"), "finished");
    EXPECT_EQ(ask(path, "SELECT count(*) FROM ticks"), "4000");
    EXPECT_EQ(ask(path, "SELECT count(*) FROM blocks"), "0");
    std::string error;
    const auto run = read_run(path, error);
    ASSERT_TRUE(run) << error;
    EXPECT_EQ(run->missing, "");
}

TEST(Recorder, LosesNoRowWhereverTheDiskBecomesFull) {
    // Given limits that end a run within rows, within a block, and within what follows it
    for (rlim_t limit = 2'000'000; limit < 6'000'000; limit += 250'000) {
        const TemporaryFolder folder;
        const std::string path = folder / "session.db";
        const pid_t child = fork();
        if (child == 0) {
            signal(SIGXFSZ, SIG_IGN);
            const rlimit both{limit, limit};
            if (setrlimit(RLIMIT_FSIZE, &both) != 0) _exit(2);
            auto recorder = new_recorder(path);
            bool has_room = true;
            for (std::uint64_t tick = 0; has_room && tick < 20'000; ++tick) {
                recorder->push(noisy_tick(tick));
                has_room = recorder->wait_for_capacity();
            }
            const std::string said = recorder->finish(test::synthetic_summary());
            const bool is_finished = ask(path, "SELECT value FROM session WHERE key='state'") == "finished";
            const bool has_lost = recorder->losses().any();
            _exit(said.empty() || is_finished == has_lost || !has_every_tick_up_to_its_last(path) ? 1 : 0);
        }
        int status = 0;
        waitpid(child, &status, 0);
        EXPECT_EQ(WEXITSTATUS(status), 0) << limit;
        EXPECT_EQ(ask(path, "PRAGMA integrity_check"), "ok") << limit;
    }
}

TEST(DrawnRun, TakesNoMoreMemoryForMoreTicks) {
    const pid_t child = fork();
    if (child == 0) {
        DrawnRun run(1'000'000);  // 650 MB, if they were kept
        rusage usage{};
        for (std::uint64_t tick = 0; tick < 1'000'000; ++tick) run.add(numbered_tick(tick));
        for (std::uint64_t tick = 0; tick < 1'000'000; ++tick) run.add(EventRow{tick, 0.0, "event", "detail"});
        getrusage(RUSAGE_SELF, &usage);
        _exit(usage.ru_maxrss < 150'000 /* kB */ && run.plotted().size() > 1'000 && run.event_count() == 1'000'000 ? 0
                                                                                                                   : 1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

/// In a child process: pushes at 1 kHz, tells the parent after each push, until it is killed.
[[noreturn]] void push_until_killed(const std::string& path, int pipe_to_parent) {
    auto recorder = new_recorder(path);
    auto next = std::chrono::steady_clock::now();
    for (std::uint64_t tick = 0; tick < 60'000; ++tick) {
        recorder->push(numbered_tick(tick));
        if (write(pipe_to_parent, &tick, sizeof tick) < 0) break;
        next += std::chrono::milliseconds(1);
        std::this_thread::sleep_until(next);
    }
    _exit(1);
}

class KilledRecorder : public testing::TestWithParam<std::uint64_t> {};

TEST_P(KilledRecorder, LosesAtMostAQuarterOfASecond) {
    // Given a child that records in real time
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) push_until_killed(path, ends[1]);
    close(ends[1]);

    // When it is killed, and cannot know
    std::uint64_t last = 0;
    while (read(ends[0], &last, sizeof last) == sizeof last)
        if (last == GetParam()) kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    close(ends[0]);
    ASSERT_TRUE(WIFSIGNALED(status));

    // Then the file opens, is sound, and has all but the last quarter second
    EXPECT_EQ(ask(path, "PRAGMA integrity_check"), "ok");
    EXPECT_EQ(ask(path, "SELECT value FROM session WHERE key='state'"), "running");
    const auto kept = test::row_count(path, "ticks");
    EXPECT_GE(kept - 1 + 250, static_cast<long long>(last));
    EXPECT_TRUE(has_every_tick_up_to_its_last(path));
}

// The third falls into the first checkpoint, 5 s after the start; the fourth into the compression of the first block.
INSTANTIATE_TEST_SUITE_P(AtTick, KilledRecorder, testing::Values(333u, 1250u, 5000u, 4150u));

}  // namespace
}  // namespace kerf::session
