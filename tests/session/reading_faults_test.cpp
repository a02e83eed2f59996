// SPDX-License-Identifier: Apache-2.0
// A sound session is not called damaged because the system cannot read it now.
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "session/read_session.h"
#include "session/recorder.h"
#include "session/report/read_run.h"
#include "session/session_file.h"
#include "synthetic_run.h"
#include "tests/support/plain_session.h"
#include "tests/support/temporary_folder.h"
#include "text/write_file.h"

namespace kerf::session {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

/// Records a finished session with all kinds of rows. Returns its path.
std::string recorded_session(const TemporaryFolder& folder) {
    const RunSummary summary = test::synthetic_summary();
    SessionHeader header;
    header.procedure = summary.procedure;
    header.signals = summary.signals;
    header.tissues = summary.tissues;
    std::string path = folder / "session.db";
    auto created = Recorder::create(path, header);
    EXPECT_EQ(created.error, "");
    for (const TickRow& row : test::synthetic_ticks(5000)) {
        created.recorder->push(row);
        created.recorder->wait_for_capacity();
    }
    for (const EventRow& event : test::synthetic_events()) created.recorder->push_event(event);
    EXPECT_EQ(created.recorder->finish(summary, drawn_surface(test::synthetic_bone(40))), "");
    return path;
}

/// Returns both readers' errors; empty texts if they can read the session.
std::vector<std::string> errors_of_readers(const std::string& path) {
    std::string of_run, of_inputs;
    if (read_run(path, of_run)) of_run.clear();
    if (read_session(path, of_inputs)) of_inputs.clear();
    return {of_run, of_inputs};
}

/// While this lives, files of SQLite can be read `reads` times. Then each read returns `code`.
class FailingReads {
public:
    FailingReads(int code, int reads) : real_(sqlite3_vfs_find(nullptr)), failing_(*real_) {
        code_ = code;
        left_ = reads;
        real = real_;
        failing_.zName = "failing";
        failing_.xOpen = &open;
        sqlite3_vfs_register(&failing_, 1);
    }
    ~FailingReads() {
        sqlite3_vfs_unregister(&failing_);
        sqlite3_vfs_register(real_, 1);
    }
    FailingReads(const FailingReads&) = delete;
    FailingReads& operator=(const FailingReads&) = delete;

private:
    static int open(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* out) {
        const int code = real->xOpen(real, name, file, flags, out);
        if (code != SQLITE_OK || (flags & SQLITE_OPEN_MAIN_DB) == 0) return code;
        methods = file->pMethods;
        failing_methods = *methods;
        failing_methods.iVersion = 2;  // without memory maps
        failing_methods.xRead = &read;
        file->pMethods = &failing_methods;
        return code;
    }
    static int read(sqlite3_file* file, void* bytes, int count, sqlite3_int64 at) {
        return left_-- > 0 ? methods->xRead(file, bytes, count, at) : code_;
    }

    static inline sqlite3_vfs* real = nullptr;
    static inline const sqlite3_io_methods* methods = nullptr;
    static inline sqlite3_io_methods failing_methods{};
    static inline int code_ = 0, left_ = 0;

    sqlite3_vfs* const real_;
    sqlite3_vfs failing_;
};

TEST(ReadingFaults, NamesTheReasonInsteadOfDamage) {
    const TemporaryFolder folder;
    const std::string path = recorded_session(folder);
    const struct {
        int code;
        const char* reason;
    } faults[]{{SQLITE_IOERR_READ, "the disk reports an error"},
               {SQLITE_FULL, "the disk is full. Free some space"},
               {SQLITE_CANTOPEN, "a file could not be opened"},
               {SQLITE_BUSY, "another program has locked the file"},
               {SQLITE_IOERR_NOMEM, "out of memory"}};
    for (const auto& [code, reason] : faults) {
        int failures = 0;
        for (int reads = 0; reads < 400; reads += 1 + reads / 4) {
            const FailingReads failing(code, reads);
            for (const std::string& error : errors_of_readers(path)) {
                if (error.empty()) continue;
                ++failures;
                EXPECT_TRUE(error.starts_with(path + ": cannot be read: " + reason)) << code << " " << reads << error;
            }
        }
        EXPECT_GT(failures, 10) << code;
    }
    EXPECT_EQ(errors_of_readers(path), (std::vector<std::string>{"", ""}));
}

TEST(ReadingFaults, NamesALackOfMemory) {
    const TemporaryFolder folder;
    const std::string path = recorded_session(folder);
    int failures = 0;
    for (sqlite3_int64 limit = 10'000; limit < 1'000'000; limit += limit / 3) {
        sqlite3_hard_heap_limit64(limit);
        const auto errors = errors_of_readers(path);
        sqlite3_hard_heap_limit64(0);
        for (const std::string& error : errors) {
            if (error.empty()) continue;
            ++failures;
            EXPECT_NE(error.find("out of memory"), std::string::npos) << limit << error;
        }
    }
    EXPECT_GT(failures, 3);
}

/// Statements of all connections since `trace` was called.
std::vector<std::string> statements;

int trace(sqlite3* database, char** /*error*/, const sqlite3_api_routines* /*unused*/) {
    return sqlite3_trace_v2(
        database, SQLITE_TRACE_STMT,
        [](unsigned, void*, void*, void* text) {
            statements.emplace_back(static_cast<const char*>(text));
            return 0;
        },
        nullptr);
}

/// Returns the plan of a query in one line.
std::string plan_of(const std::string& path, const std::string& query) {
    SessionFile file;
    EXPECT_EQ(file.open(path, {}), "");
    std::string plan;
    for (SessionQuery steps(file.handle(), "EXPLAIN QUERY PLAN " + query); steps.next();) plan += steps.text(3) + "; ";
    return plan;
}

TEST(ReadingFaults, NoReaderSortsATable) {
    const TemporaryFolder folder;
    const std::string path = recorded_session(folder);
    statements.clear();
    sqlite3_auto_extension(reinterpret_cast<void (*)()>(&trace));
    const auto errors = errors_of_readers(path);
    sqlite3_cancel_auto_extension(reinterpret_cast<void (*)()>(&trace));
    ASSERT_EQ(errors, (std::vector<std::string>{"", ""}));

    std::erase_if(statements, [](const std::string& text) { return !text.starts_with("SELECT"); });
    ASSERT_GT(statements.size(), 20u);
    for (const std::string& query : statements) {
        const bool is_list_of_tables = query.find("FROM sqlite_master") != std::string::npos;  // a few rows
        EXPECT_TRUE(is_list_of_tables || plan_of(path, query).find("TEMP B-TREE") == std::string::npos) << query;
    }
}

// ---- files next to a session --------------------------------------------------------------------------------------

void make_odd_file(const std::string& kind, const std::string& path) {
    if (kind == "FIFO") {
        ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
    }
    if (kind == "folder") fs::create_directory(path);
    if (kind == "link") fs::create_symlink("/dev/zero", path);
    if (kind == "socket") {
        const int bound = socket(AF_UNIX, SOCK_STREAM, 0);
        sockaddr_un name{};
        name.sun_family = AF_UNIX;
        ASSERT_LT(path.size(), sizeof name.sun_path);
        std::copy(path.begin(), path.end(), name.sun_path);
        ASSERT_EQ(bind(bound, reinterpret_cast<const sockaddr*>(&name), sizeof name), 0);
        close(bound);
    }
}

TEST(SideFiles, RefusesAnythingButRegularFiles) {
    for (const char* suffix : {"-wal", "-journal", "-shm"})
        for (const char* kind : {"FIFO", "folder", "link", "socket"}) {
            const TemporaryFolder folder;
            const std::string path = recorded_session(folder);
            make_odd_file(kind, path + suffix);
            for (const std::string& error : errors_of_readers(path)) {
                EXPECT_TRUE(error.starts_with(path + suffix + ": this is ")) << error;
                EXPECT_NE(error.find(kind), std::string::npos) << error;
            }
        }
}

TEST(SideFiles, BelongToTheTargetOfALink) {
    const TemporaryFolder folder, elsewhere;
    const std::string path = recorded_session(folder), link = elsewhere / "linked.db";
    fs::create_symlink(path, link);
    fs::create_symlink("linked.db", elsewhere / "again.db");
    EXPECT_EQ(errors_of_readers(link), (std::vector<std::string>{"", ""}));

    for (const char* suffix : {"-wal", "-journal", "-shm"}) {
        make_odd_file("FIFO", path + suffix);
        for (const std::string& name : {link, elsewhere / "again.db"})
            for (const std::string& error : errors_of_readers(name)) {
                EXPECT_TRUE(error.starts_with(name + ": is a link to ")) << error;
                EXPECT_NE(error.find("/session.db" + std::string(suffix) + ": this is a FIFO"), std::string::npos)
                    << error;
            }
        fs::remove(path + suffix);
    }
}

TEST(SideFiles, ReadTheRowsOfTheWalThroughALink) {
    // Given a session whose result is in its -wal file, as a killed run leaves it
    const TemporaryFolder folder, elsewhere;
    const std::string path = recorded_session(folder), killed = folder / "killed.db", link = elsewhere / "linked.db";
    sqlite3* writer = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &writer), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(writer,
                           "PRAGMA journal_mode=WAL; UPDATE session SET value='variant-in-wal' WHERE "
                           "key='condition.variant'",
                           nullptr, nullptr, nullptr),
              SQLITE_OK);
    fs::copy_file(path, killed);
    fs::copy_file(path + "-wal", killed + "-wal");
    sqlite3_close(writer);

    fs::create_symlink(killed, link);
    std::string error;
    const auto inputs = read_session(link, error);
    ASSERT_TRUE(inputs) << error;
    EXPECT_EQ(inputs->variant, "variant-in-wal");
}

TEST(SideFiles, NamesAWalThatMayNotBeRead) {
    const TemporaryFolder folder;
    const std::string path = recorded_session(folder);
    std::ofstream(path + "-wal") << "rows";
    fs::permissions(path + "-wal", fs::perms::none);
    fs::permissions(folder / "", fs::perms::all);
    const bool was_root = geteuid() == 0 && seteuid(65534) == 0;  // root may read any file
    const std::vector<std::string> errors = errors_of_readers(path);
    ASSERT_TRUE(!was_root || seteuid(0) == 0);
    for (const std::string& error : errors)
        EXPECT_TRUE(error.starts_with(path + "-wal: cannot be read, and the last rows are in it.")) << error;
}

TEST(SideFiles, AreInUseAlsoBehindALink) {
    const TemporaryFolder folder, elsewhere;
    const std::string path = recorded_session(folder), link = elsewhere / "linked.db";
    fs::create_symlink(path, link);
    text::OutputLock run;
    ASSERT_EQ(run.take(folder / ""), "");
    for (const std::string& error : errors_of_readers(link))
        EXPECT_EQ(error, link + ": a run is writing it. Wait until that has ended.");
}

// ---- edited sessions ----------------------------------------------------------------------------------------------

TEST(EditedSession, WithAResultButWithoutAChecksumIsChanged) {
    // As a forger would do it: the session looks like one of a killed run, which has no checksum
    const std::string killed = "DELETE FROM session WHERE key='record_checksum';"
                               "UPDATE session SET value='running' WHERE key='state';";
    for (const char* kept : {"result.verdict", "result.score", "hash", "summary"}) {
        const TemporaryFolder folder;
        const std::string path = recorded_session(folder);
        ASSERT_EQ(test::run_sql(path, killed +
                                          "DELETE FROM session WHERE (key LIKE 'result.%' OR key IN ('hash', "
                                          "'summary')) AND key <> '" +
                                          kept + "'"),
                  "");
        std::string error;
        EXPECT_FALSE(read_run(path, error)) << kept;
        EXPECT_NE(error.find("was edited"), std::string::npos) << error;
        const auto inputs = read_session(path, error);
        ASSERT_TRUE(inputs) << error;
        EXPECT_EQ(inputs->rows, RecordCheck::changed) << kept;
    }
}

// An old schema has no checksum, so its number must not excuse one that is missing.
TEST(EditedSession, OfAnOlderSchemaHasNoBlocks) {
    for (const char* schema : {"2", "3"}) {
        const TemporaryFolder folder;
        const std::string path = recorded_session(folder);
        ASSERT_EQ(test::run_sql(path, std::string("DELETE FROM session WHERE key='record_checksum';"
                                                  "UPDATE session SET value='pass' WHERE key='result.verdict';"
                                                  "PRAGMA user_version=") +
                                          schema),
                  "");
        std::string error;
        EXPECT_FALSE(read_run(path, error)) << schema;
        EXPECT_NE(error.find("was edited"), std::string::npos) << error;
    }
}

TEST(EditedSession, WithoutAResultShowsNoPartOfIt) {
    const TemporaryFolder folder;
    const std::string path = recorded_session(folder);
    ASSERT_EQ(test::run_sql(path, "DELETE FROM session WHERE key LIKE 'result.%' OR key IN ('hash', 'summary', "
                                  "'record_checksum'); UPDATE session SET value='running' WHERE key='state'"),
              "");
    std::string error;
    const auto run = read_run(path, error);
    ASSERT_TRUE(run) << error;
    EXPECT_FALSE(run->has_result);
    EXPECT_EQ(run->summary.verdict, Verdict::incomplete);
    EXPECT_TRUE(run->summary.metrics.empty());
    EXPECT_TRUE(run->summary.steps.empty());
    EXPECT_TRUE(run->drawn.bone().is_empty());
}

TEST(EditedSession, WithoutItsStateIsRefused) {
    for (const char* sql : {"DELETE FROM session", "DELETE FROM session WHERE key='state'",
                            "UPDATE session SET value='done' WHERE key='state'"}) {
        const TemporaryFolder folder;
        const std::string path = recorded_session(folder);
        ASSERT_EQ(test::run_sql(path, sql), "");
        for (const std::string& error : errors_of_readers(path))
            EXPECT_NE(error.find("has no valid state"), std::string::npos) << sql << error;
    }
}

}  // namespace
}  // namespace kerf::session
