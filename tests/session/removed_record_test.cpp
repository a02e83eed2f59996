// SPDX-License-Identifier: Apache-2.0
// A record that is removed, renamed or replaced during its run is reported as such.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>

#include "session/recorder.h"
#include "session/report/read_run.h"
#include "synthetic_run.h"
#include "tests/support/temporary_folder.h"

namespace kerf::session {
namespace {

namespace fs = std::filesystem;
using test::contents_of;
using test::TemporaryFolder;

SessionHeader header() {
    SessionHeader header;
    header.signals = test::synthetic_summary().signals;
    header.tissues = test::synthetic_summary().tissues;
    return header;
}

std::map<std::string, std::string> all_in(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder))
        files[entry.path().filename().string()] = contents_of(entry.path().string());
    return files;
}

/// A folder whose files have the names of a session that another run is writing.
void make_foreign(const fs::path& folder) {
    fs::create_directory(folder);
    for (const char* name : {"session.db", "session.db-wal", "session.db-shm"})
        std::ofstream(folder / name) << "foreign " << name;
}

struct Removal {
    const char* what;
    std::function<void(const fs::path& folder, const fs::path& elsewhere)> remove;
};

TEST(RemovedRecord, IsNeverCalledComplete) {
    const Removal removals[]{
        {"removed", [](const fs::path& folder, const fs::path&) { fs::remove_all(folder); }},
        {"renamed", [](const fs::path& folder, const fs::path& elsewhere) { fs::rename(folder, elsewhere); }},
        {"replaced by an empty folder",
         [](const fs::path& folder, const fs::path& elsewhere) {
             fs::rename(folder, elsewhere);
             fs::create_directory(folder);
         }},
        {"replaced by another session",
         [](const fs::path& folder, const fs::path& elsewhere) {
             fs::rename(folder, elsewhere);
             make_foreign(folder);
         }},
        {"session removed", [](const fs::path& folder, const fs::path&) { fs::remove(folder / "session.db"); }},
        {"session replaced", [](const fs::path& folder, const fs::path&) {
             fs::remove(folder / "session.db");
             std::ofstream(folder / "session.db") << "foreign";
         }}};
    for (const auto& [what, remove] : removals) {
        SCOPED_TRACE(what);
        const TemporaryFolder own;
        const fs::path folder = own / "run", elsewhere = own / "elsewhere";
        fs::create_directory(folder);
        auto created = Recorder::create((folder / "session.db").string(), header());
        ASSERT_EQ(created.error, "");
        for (const TickRow& row : test::synthetic_ticks(300)) created.recorder->push(row);
        usleep(300'000);  // until the rows are in the -wal
        EXPECT_FALSE(created.recorder->is_removed());

        remove(folder, elsewhere);
        const bool is_foreign = fs::exists(folder / "session.db-shm") && fs::exists(elsewhere);
        const auto before = is_foreign ? all_in(folder) : std::map<std::string, std::string>{};
        const std::string error = created.recorder->finish(test::synthetic_summary());

        EXPECT_TRUE(created.recorder->is_removed());
        EXPECT_EQ(error, (folder / "session.db").string() +
                             " is no longer there: it was removed, renamed or replaced during the run.");
        if (is_foreign) {
            EXPECT_TRUE(all_in(folder) == before);
        }
        if (fs::exists(folder / "session.db")) {
            EXPECT_TRUE(contents_of((folder / "session.db").string()).starts_with("foreign"));
        }
        if (fs::exists(elsewhere)) {
            std::string fault;
            const auto run = read_run((elsewhere / "session.db").string(), fault);
            ASSERT_TRUE(run) << fault;
            EXPECT_EQ(run->drawn.ticks(), 300u);
            EXPECT_TRUE(run->has_result);
        }
    }
}

}  // namespace
}  // namespace kerf::session
