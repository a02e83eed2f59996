// SPDX-License-Identifier: Apache-2.0
#include "session/report/read_run.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "session/read_session.h"
#include "session/record_checksum.h"
#include "session/recorder.h"
#include "session/report/report.h"
#include "synthetic_run.h"
#include "tests/support/plain_session.h"
#include "tests/support/temporary_folder.h"
#include "text/write_file.h"

namespace kerf::session {
namespace {

namespace fs = std::filesystem;
using test::contents_of;
using test::TemporaryFolder;

SessionHeader header_of(const RunSummary& summary) {
    SessionHeader header;
    header.procedure = summary.procedure;
    header.procedure_version = summary.procedure_version;
    header.anatomy = summary.anatomy;
    header.rehearsal = summary.rehearsal;
    header.hand = summary.hand;
    header.versions = summary.versions;
    header.conditions = {summary.device, summary.force_scale, "", summary.coupling_stiffness, summary.variant};
    header.signals = summary.signals;
    header.tissues = summary.tissues;
    return header;
}

std::unique_ptr<Recorder> recorder_of(const std::string& path, const RunSummary& summary,
                                      const std::vector<TickRow>& ticks, const std::vector<EventRow>& events) {
    auto created = Recorder::create(path, header_of(summary));
    EXPECT_EQ(created.error, "");
    for (const TickRow& row : ticks) {
        created.recorder->push(row);
        created.recorder->wait_for_capacity();
    }
    for (const EventRow& event : events) created.recorder->push_event(event);
    return std::move(created.recorder);
}

enum class Rows { compressed, plain };

/// A finished session of the made-up run, changed by `sql`.
std::string session_after(const TemporaryFolder& folder, const std::string& sql, Rows rows = Rows::compressed) {
    std::string path = folder / "session.db";
    const RunSummary summary = test::synthetic_summary();
    EXPECT_EQ(recorder_of(path, summary, test::synthetic_ticks(50), test::synthetic_events())
                  ->finish(summary, drawn_surface(test::synthetic_bone(4))),
              "");
    if (rows == Rows::plain) {
        EXPECT_EQ(test::make_rows_plain(path), "");
    }
    EXPECT_EQ(test::run_sql(path, sql), "") << sql;
    return path;
}

std::string refusal_after(const std::string& sql, Rows rows = Rows::compressed) {
    const TemporaryFolder folder;
    std::string error;
    EXPECT_FALSE(read_run(session_after(folder, sql, rows), error)) << sql;
    return error;
}

/// The ticks with the numbers that a session keeps of them: inputs of a replay exactly, all others as float32.
std::vector<TickRow> as_kept(std::vector<TickRow> rows) {
    const auto narrow = [](double& number) { number = static_cast<double>(static_cast<float>(number)); };
    for (TickRow& row : rows) {
        auto& [p, q] = row.world_from_tool;
        for (double* number : {&p.x, &p.y, &p.z, &q.w, &q.x, &q.y, &q.z, &row.thrust, &row.torque, &row.depth,
                               &row.feed_rate, &row.power_hand, &row.power_drive, &row.removed})
            narrow(*number);
        for (Vec6* wrench : {&row.modelled, &row.coupled, &row.limited, &row.commanded})
            for (double& component : *wrench) narrow(component);
        for (double& signal : row.signals) narrow(signal);
    }
    return rows;
}

std::string page_of(const RecordedRun& run) { return report_html(run.summary, run.drawn); }

TEST(ReadRun, ThePageMadeOfASessionIsThePageOfTheRunByteForByte) {
    // Given a run with all that a database keeps otherwise than memory does
    RunSummary summary = test::synthetic_summary();
    summary.reasons.emplace_back("Two\nlines, <b>µ</b> and \"quotes\".");
    summary.variant = "left";
    summary.score = 100.0 * 2 / 3;
    summary.duration = 0.1 + 0.2;
    summary.metrics[1].value = std::numeric_limits<double>::quiet_NaN();
    summary.metrics[2].value = -0.0;
    auto ticks = test::synthetic_ticks();
    for (std::size_t i = 0; i < ticks.size(); i += 7) ticks[i].signals[1] = -0.0;
    ticks[20].torque = -std::numeric_limits<double>::quiet_NaN();
    ticks[21].thrust = std::numeric_limits<double>::infinity();
    for (TickRow& row : ticks) row.world_from_tool.rotation = {-0.0, 1.0, -0.0, 0.0};
    auto events = test::synthetic_events();
    events.push_back(Recorder::as_kept({12'200, 12.2, std::string(100, 'i'), std::string(300, 'd')}));
    const DrawnSurface bone = drawn_surface(test::synthetic_bone(300));  // more vertices than 16 bits count

    // When it is recorded, and read again
    const TemporaryFolder folder;
    ASSERT_EQ(recorder_of(folder / "session.db", summary, ticks, events)->finish(summary, bone), "");
    std::string error;
    const auto run = read_run(folder / "session.db", error);

    // Then
    ASSERT_TRUE(run) << error;
    EXPECT_EQ(run->missing, "");
    EXPECT_EQ(run->drawn.bone(), bone);
    EXPECT_TRUE(page_of(*run) == report_html(summary, test::drawn_run(as_kept(ticks), events, bone)));
}

RunSummary with_zones() {
    RunSummary summary = test::synthetic_summary();
    Mesh canal = test::synthetic_bone(4);
    canal.tissue.clear();  // a zone has none
    Mesh root = canal;
    for (Vec3& vertex : canal.vertices) vertex = vertex + Vec3{5e-3, -1e-3, 2e-3};
    summary.zones = {{"spinal-canal", drawn_surface(canal)}, {"nerve_root", drawn_surface(root)}};
    summary.approaches = {{"pilot-hole", "spinal-canal", -0.4e-3, 11.4, {1e-3, 2e-3, 3e-3}},
                          {"withdraw", "spinal-canal", 2e-3, 13.0, {1e-3, 2e-3, 4e-3}}};
    return summary;
}

TEST(ReadRun, ReadsZonesAndApproaches) {
    const TemporaryFolder folder;
    const RunSummary summary = with_zones();
    const DrawnSurface bone = drawn_surface(test::synthetic_bone(8));
    ASSERT_EQ(recorder_of(folder / "session.db", summary, {}, {})->finish(summary, bone), "");
    std::string error;
    const auto run = read_run(folder / "session.db", error);
    ASSERT_TRUE(run) << error;
    ASSERT_EQ(run->summary.zones.size(), 2u);
    EXPECT_EQ(run->summary.zones[0].id, "spinal-canal");
    EXPECT_EQ(run->summary.zones[0].surface, summary.zones[0].surface);
    EXPECT_EQ(run->summary.zones[1].surface, summary.zones[1].surface);
    ASSERT_EQ(run->summary.approaches.size(), 2u);
    EXPECT_EQ(run->summary.approaches[0].zone, "spinal-canal");
    EXPECT_EQ(run->summary.approaches[0].clearance, -0.4e-3);
    EXPECT_EQ(run->summary.approaches[0].at.z, 3e-3);
    EXPECT_TRUE(page_of(*run) == report_html(summary, test::drawn_run({}, {}, bone)));
}

TEST(ReadRun, RefusesAZoneWithoutItsVertices) {
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    const RunSummary summary = with_zones();
    ASSERT_EQ(recorder_of(path, summary, {}, {})->finish(summary, drawn_surface(test::synthetic_bone(8))), "");
    ASSERT_EQ(test::run_sql(path, "UPDATE zones SET positions=substr(positions,1,16), normals=substr(normals,1,8)"),
              "");
    std::string error;
    EXPECT_FALSE(read_run(path, error));
    EXPECT_NE(error.find("zone has triangles without vertices"), std::string::npos) << error;
}

TEST(ReadRun, ReadsTitlesFromTheRecordedProcedure) {
    const TemporaryFolder folder;
    const RunSummary summary = test::synthetic_summary();
    SessionHeader header = header_of(summary);
    header.procedure_text = "metadata: {title: Pilot hole}\nrehearsals: [{id: too-deep, title: A deep one}]\n";
    header.variant_title = "The left side";
    auto created = Recorder::create(folder / "session.db", header);
    ASSERT_EQ(created.recorder->finish(summary), "");

    std::string error;
    const auto run = read_run(folder / "session.db", error);
    ASSERT_TRUE(run) << error;
    EXPECT_EQ(run->procedure.title, "Pilot hole");
    EXPECT_EQ(run->procedure.rehearsal_title, "A deep one");
    EXPECT_EQ(run->procedure.variant_title, "The left side");
}

TEST(ReadRun, WhatWasCutShortHasAPageThatSaysSo) {
    const TemporaryFolder folder;
    recorder_of(folder / "session.db", test::synthetic_summary(), test::synthetic_ticks(50), test::synthetic_events())
        .reset();
    std::string error;
    const auto run = read_run(folder / "session.db", error);
    ASSERT_TRUE(run) << error;
    EXPECT_NE(run->missing.find("cut short"), std::string::npos);
    EXPECT_EQ(run->summary.verdict, Verdict::incomplete);
    EXPECT_EQ(run->summary.ticks, 50u);
    const std::string page = page_of(*run);
    for (const char* part :
         {"Pilot hole in a lumbar pedicle", "… Incomplete", "Score – of 100", "The run was cut short", "limit_broken"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
}

TEST(ReadRun, LostRowsAreSaid) {
    const TemporaryFolder folder;
    std::string error;
    const std::string path =
        session_after(folder,
                      "UPDATE session SET value='incomplete' WHERE key='state'; "
                      "UPDATE session SET value='17' WHERE key='lost_ticks'; DELETE FROM ticks WHERE tick=9",
                      Rows::plain);
    ASSERT_EQ(test::make_rows_plain(path), "");  // renews the checksum
    const auto run = read_run(path, error);
    ASSERT_TRUE(run) << error;
    EXPECT_EQ(run->drawn.ticks(), 49u);
    EXPECT_NE(page_of(*run).find("17 rows of it were lost"), std::string::npos);
}

TEST(ReadRun, WhatNoRunWritesIsRefused) {
    for (const auto& [sql, words] :
         {std::pair<const char*, const char*>{"PRAGMA user_version=1", "schema 1, need 2 to 5"},
          {"PRAGMA user_version=0", "schema 0, need 2 to 5"},
          {"PRAGMA user_version=6", "schema 6, need 2 to 5"},
          {"DROP TABLE reasons", "`reasons` cannot be read"},
          {"ALTER TABLE ticks RENAME COLUMN thrust TO push", "`ticks` cannot be read"},
          {"UPDATE surface SET triangles=x'ffffffffffff'", "triangles without vertices"},
          {"UPDATE surface SET positions=x'00'", "triangles without vertices"},
          {"UPDATE surface SET step=NULL", "triangles without vertices"},
          {"UPDATE surface SET half_x=9e999", "triangles without vertices"},
          {"INSERT INTO surface SELECT * FROM surface", "two surfaces"},
          {"WITH RECURSIVE n(i) AS (SELECT 2 UNION ALL SELECT i+1 FROM n WHERE i < 40) INSERT INTO signals SELECT i, "
           "'x', 'x', '', '', 1.0, '' FROM n",
           "more than"},
          {"ALTER TABLE metrics RENAME TO m; CREATE VIEW metrics AS SELECT * FROM m", "computes its table `metrics`"},
          {"ALTER TABLE events ADD COLUMN more AS (printf('%.*c', 9, 'x'))", "computes its table `events`"}})
        EXPECT_NE(refusal_after(sql).find(words), std::string::npos) << sql << ": " << refusal_after(sql);
}

TEST(ReadRun, PlainRowsThatNoRunWritesAreRefused) {
    for (const auto& [sql, words] :
         {std::pair<const char*, const char*>{"UPDATE ticks SET thrust='much' WHERE tick=7",
                                              "`ticks` has something else than a number"},
          {"UPDATE ticks SET tick=-1 WHERE tick=7", "tick -1"},
          {"UPDATE ticks SET tick=6 WHERE tick=7", "tick 6 is there twice"},
          {"DROP TABLE blocks", "`ticks` cannot be read"},
          {"ALTER TABLE blocks RENAME TO b; CREATE VIEW blocks AS SELECT * FROM b", "computes its table `blocks`"}})
        EXPECT_NE(refusal_after(sql, Rows::plain).find(words), std::string::npos)
            << sql << ": " << refusal_after(sql, Rows::plain);
}

TEST(ReadRun, BlocksThatNoRunWritesAreRefused) {
    const std::string thrust = " WHERE table_name='ticks' AND column_name='thrust'";
    for (const auto& [sql, words] : std::vector<std::pair<std::string, std::string>>{
             // The column's bytes: cut short, none, something else, far too many
             {"UPDATE blocks SET data=substr(data, 1, length(data) / 2)" + thrust, "damaged column `thrust`"},
             {"UPDATE blocks SET data=substr(data, 1, length(data) - 1)" + thrust, "damaged column `thrust`"},
             {"UPDATE blocks SET data=x''" + thrust, "damaged column `thrust`"},
             {"UPDATE blocks SET data=NULL" + thrust, "damaged column `thrust`"},
             {"UPDATE blocks SET data='much'" + thrust, "damaged column `thrust`"},
             {"UPDATE blocks SET data=data || x'00'" + thrust, "damaged column `thrust`"},
             {"UPDATE blocks SET data=zeroblob(50000000)" + thrust, "damaged column `thrust`"},
             {"UPDATE blocks SET differences=4" + thrust, "damaged column `thrust`"},
             {"UPDATE blocks SET differences=-9223372036854775808" + thrust, "damaged column `thrust`"},
             // Lengths that lie
             {"UPDATE blocks SET rows=51", "damaged column `tick`"},
             {"UPDATE blocks SET rows=49", "damaged column `tick`"},
             {"UPDATE blocks SET rows=4096", "damaged column `tick`"},
             {"UPDATE blocks SET rows=51" + thrust, "lacks its column `thrust`"},
             {"UPDATE blocks SET rows=0", "has 0 rows, and a block has 1 to 4096"},
             {"UPDATE blocks SET rows=-1", "has -1 rows"},
             {"UPDATE blocks SET rows=4097", "has 4097 rows"},
             {"UPDATE blocks SET rows=1000000000000", "has 1000000000000 rows"},
             // Columns and blocks that are missing, repeated or out of order
             {"DELETE FROM blocks" + thrust, "lacks its column `thrust`"},
             {"DELETE FROM blocks WHERE column_name LIKE 'signal%'", "block 0 of its table `ticks` is cut short"},
             {"UPDATE blocks SET column_name='push'" + thrust, "lacks its column `thrust`"},
             {"UPDATE blocks SET block=1", "lacks its column `tick`"},
             {"INSERT INTO blocks SELECT * FROM blocks WHERE table_name='ticks'", "lacks its column `tick`"},
             {"INSERT INTO blocks SELECT table_name, block + 1, rows, column_name, differences, data FROM blocks WHERE "
              "table_name='ticks'",
              "tick 0 is there twice"}})
        EXPECT_NE(refusal_after(sql).find(words), std::string::npos) << sql << ": " << refusal_after(sql);
}

TEST(ReadRun, ALengthThatLiesTakesNoMemory) {
    const TemporaryFolder folder;
    const std::string path = session_after(folder, "UPDATE blocks SET rows=9223372036854775807");
    const pid_t child = fork();
    if (child == 0) {
        rusage before{}, after{};
        getrusage(RUSAGE_SELF, &before);
        std::string error;
        const bool is_read = read_run(path, error).has_value() || read_session(path, error).has_value();
        getrusage(RUSAGE_SELF, &after);
        _exit(is_read || after.ru_maxrss - before.ru_maxrss > 20'000 /* kB */ ? 1 : 0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(ReadRun, ReadsBlocksAndThePlainRowsBehindThem) {
    // Given a run that was given up in its second block, whose rows stayed plain
    const TemporaryFolder folder;
    const std::string path = folder / "session.db";
    const auto ticks = test::synthetic_ticks(5000);
    ASSERT_EQ(recorder_of(path, test::synthetic_summary(), ticks, {})->finish(test::synthetic_summary()), "");
    ASSERT_EQ(test::make_rows_plain(path, 1), "");

    // Then both parts are read, in order
    std::string error;
    const auto run = read_run(path, error);
    ASSERT_TRUE(run) << error;
    EXPECT_EQ(run->drawn.ticks(), 5000u);
    EXPECT_EQ(run->drawn.last()->tick, 4999u);
    const auto inputs = read_session(path, error);
    ASSERT_TRUE(inputs) << error;
    ASSERT_EQ(inputs->device_from_handle.size(), 5000u);
    for (std::size_t tick : {0u, 4095u, 4096u, 4999u})
        EXPECT_EQ(inputs->device_from_handle[tick].position.z, ticks[tick].device_from_handle.position.z) << tick;
}

void expect_changed(const char* sql, Rows rows) {
    EXPECT_NE(refusal_after(sql, rows).find("not those that the run wrote"), std::string::npos)
        << sql << refusal_after(sql, rows);
    const TemporaryFolder folder;
    std::string error;
    const auto inputs = read_session(session_after(folder, sql, rows), error);
    ASSERT_TRUE(inputs) << sql << error;
    EXPECT_EQ(inputs->rows, RecordCheck::changed) << sql;
}

TEST(RecordChecksum, FindsAChangeInPlainRows) {
    for (const char* sql : {"UPDATE ticks SET thrust=1e6 WHERE tick=7", "UPDATE ticks SET removed=1e-9"})
        expect_changed(sql, Rows::plain);
}

TEST(RecordChecksum, FindsAChangeInABlock) {
    for (const char* sql :
         {// The thrust of another column, which unpacks
          "UPDATE blocks SET data=(SELECT data FROM blocks WHERE column_name='depth'), differences=(SELECT differences "
          "FROM blocks WHERE column_name='depth') WHERE column_name='thrust'",
          "UPDATE blocks SET differences=differences+1-2*(differences>0) WHERE column_name='thrust'",
          // A column that no page shows
          "UPDATE blocks SET data=x'00' WHERE column_name='feed_rate'",
          "UPDATE blocks SET data=NULL WHERE column_name='power_hand'",
          "INSERT INTO ticks(tick, device_from_handle_qw, device_from_handle_qx, device_from_handle_qy, "
          "device_from_handle_qz, device_from_handle_x, device_from_handle_y, device_from_handle_z) VALUES(50, 1, 0, "
          "0, "
          "0, 0, 0, 0)",
          "INSERT INTO blocks VALUES('cuts', 0, 1, 'sequence', 0, x'00')"})
        expect_changed(sql, Rows::compressed);
}

TEST(RecordChecksum, FindsAChangeInEveryTable) {
    for (const char* sql : {"UPDATE events SET detail='x'",
                            "UPDATE metrics SET value=0",
                            "UPDATE metrics SET status='ok'",
                            "DELETE FROM metrics WHERE rowid=1",
                            "UPDATE session SET value='pass' WHERE key='result.verdict'",
                            "UPDATE session SET value='100' WHERE key='result.score'",
                            "UPDATE session SET value='novice' WHERE key='run.rehearsal'",
                            "UPDATE envelope SET value='L18' WHERE key='learner'",
                            "UPDATE reasons SET reason='none'",
                            "DELETE FROM reasons",
                            "UPDATE removed SET volume=0",
                            "UPDATE steps SET done=1",
                            "UPDATE signals SET per_unit=1",
                            "UPDATE tissues SET id='x'",
                            "UPDATE columns SET unit='mm' WHERE name='thrust'",
                            "UPDATE notice SET text='For diagnosis'",
                            "INSERT INTO cuts VALUES(1,1,1,1,0,0,0,1,0,0,0,0,0,0,1,0,0,0)",
                            "INSERT INTO events VALUES(1,1.0,'x','y')",
                            "UPDATE surface SET half_x=half_x*1.01",
                            "UPDATE session SET value='2' WHERE key='result.ticks'",
                            "INSERT INTO session VALUES('more','x')",
                            "DELETE FROM session WHERE key='record_checksum'",
                            "UPDATE session SET value='0000000000000000' WHERE key='record_checksum'",
                            "UPDATE events SET detail=CAST(detail AS BLOB) WHERE rowid=1",
                            "CREATE TABLE more (a)",
                            "CREATE TRIGGER more AFTER INSERT ON ticks BEGIN DELETE FROM ticks; END"})
        expect_changed(sql, Rows::compressed);
}

TEST(RecordChecksum, HoldsForACopyAndAfterVacuum) {
    for (const char* sql : {"", "VACUUM", "PRAGMA journal_mode=WAL; PRAGMA journal_mode=DELETE"}) {
        const TemporaryFolder folder;
        std::string error;
        const auto inputs = read_session(session_after(folder, sql), error);
        ASSERT_TRUE(inputs) << error;
        EXPECT_EQ(inputs->rows, RecordCheck::same) << sql;
        EXPECT_EQ(inputs->rehearsal, "too-deep");
    }
}

TEST(RecordChecksum, OfAnOlderSessionIsUnknown) {
    const TemporaryFolder folder;
    const std::string path =
        session_after(folder, "DELETE FROM session WHERE key='record_checksum'; PRAGMA user_version=2", Rows::plain);
    std::string error;
    const auto run = read_run(path, error);
    EXPECT_TRUE(run) << error;
    const auto inputs = read_session(path, error);
    ASSERT_TRUE(inputs) << error;
    EXPECT_EQ(inputs->rows, RecordCheck::unknown);
    EXPECT_TRUE(inputs->is_old);
}

TEST(ReadRun, ASessionThatIsBeingWrittenIsLeftAlone) {
    const TemporaryFolder folder;
    const std::string path = session_after(folder, "");
    std::string error;
    {
        text::OutputLock lock;
        ASSERT_EQ(lock.take(folder.path()), "");
        EXPECT_FALSE(read_run(path, error));
        EXPECT_NE(error.find("a run is writing it. Wait"), std::string::npos) << error;
    }
    EXPECT_TRUE(read_run(path, error)) << error;
}

// ---- reading changes nothing --------------------------------------------------------------------------------------

std::map<std::string, std::string> all_in(const std::string& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder))
        files[entry.path().filename().string()] = contents_of(entry.path().string());
    return files;
}

/// Whether `reads` is true in a process that may write neither to the folder nor to what is in it, whoever runs the
/// tests.
bool holds_for_somebody_else(const std::string& folder, const std::function<bool()>& reads) {
    for (const auto& entry : fs::directory_iterator(folder)) fs::permissions(entry.path(), fs::perms(0444));
    fs::permissions(folder, fs::perms(0555));
    const pid_t child = fork();
    if (child == 0) {
        constexpr uid_t nobody = 65534;
        if (geteuid() == 0 && (setgid(nobody) != 0 || setuid(nobody) != 0)) _exit(3);
        if (access(folder.c_str(), W_OK) == 0) _exit(4);
        _exit(reads() ? 0 : 1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    fs::permissions(folder, fs::perms(0755));
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_NE(WEXITSTATUS(status), 3) << "no other user to be";
    EXPECT_NE(WEXITSTATUS(status), 4) << "the folder could be written to";
    return WEXITSTATUS(status) == 0;
}

/// A copy of a session while a run writes it, which is what a killed run leaves: session.db and its -wal. (-shm is
/// never needed.)
void leave_as_killed(const std::string& folder) {
    const TemporaryFolder living;
    auto recorder = recorder_of(living / "session.db", test::synthetic_summary(), test::synthetic_ticks(300),
                                test::synthetic_events());
    std::string error;
    for (int n = 0; n < 500; ++n) {  // until all rows are in the -wal, 5 s at most
        for (const char* name : {"session.db", "session.db-wal"}) {
            std::error_code not_yet;
            fs::copy_file(living / name, folder + "/" + name, fs::copy_options::overwrite_existing, not_yet);
        }
        if (const auto run = read_run(folder + "/session.db", error);
            run && run->drawn.ticks() == 300 && run->drawn.event_count() == 5)
            return;
        usleep(10'000);
    }
    FAIL() << error;
}

bool both_read(const std::string& path, std::size_t ticks) {
    std::string error;
    const auto run = read_run(path, error);
    if (run) page_of(*run);
    const auto inputs = read_session(path, error);
    return run && run->drawn.ticks() == ticks && inputs && inputs->device_from_handle.size() == ticks;
}

TEST(ReadingASession, NeedsNoRightToWriteAndLeavesEverythingAsItWas) {
    for (const bool is_killed : {false, true}) {
        const TemporaryFolder folder;
        fs::permissions(folder.path(), fs::perms(0755));
        if (is_killed)
            leave_as_killed(folder.path());
        else
            session_after(folder, "");
        const std::size_t ticks = is_killed ? 300 : 50;
        const std::string path = folder / "session.db";
        const auto before = all_in(folder.path());

        EXPECT_TRUE(holds_for_somebody_else(folder.path(), [&] { return both_read(path, ticks); })) << is_killed;
        EXPECT_TRUE(both_read(path, ticks)) << is_killed;  // with the right to write, too
        EXPECT_TRUE(all_in(folder.path()) == before) << is_killed;
    }
}

TEST(ReadingASession, WithoutTheWalOfAKilledRunReadsWhatTheFileHoldsAndAddsNothing) {
    const TemporaryFolder folder;
    leave_as_killed(folder.path());
    fs::remove(folder / "session.db-wal");
    const auto before = all_in(folder.path());
    std::string error;
    const auto run = read_run(folder / "session.db", error);
    ASSERT_TRUE(run) << error;
    EXPECT_EQ(run->drawn.ticks(), 0u);
    EXPECT_NE(run->missing, "");
    EXPECT_TRUE(all_in(folder.path()) == before);
}

TEST(ReadingASession, ANameWithSignsThatMeanSomethingElsewhereIsAName) {
    const TemporaryFolder folder;
    const std::string odd = folder / "a?b#c%41 d.db";
    fs::copy_file(session_after(folder, ""), odd);
    EXPECT_TRUE(both_read(odd, 50));
    // Seen from its own folder
    const fs::path here = fs::current_path();
    fs::current_path(folder.path());
    const bool is_read = both_read("session.db", 50);
    fs::current_path(here);
    EXPECT_TRUE(is_read);
}

}  // namespace
}  // namespace kerf::session
