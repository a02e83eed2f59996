// SPDX-License-Identifier: Apache-2.0
// The program where the system or its user is not kind: outputs that are full or closed, no memory, hostile names,
// records that were changed.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/plain_session.h"
#include "tests/support/program.h"
#include "text/printable_lines.h"

namespace kerf::app {
namespace {

namespace fs = std::filesystem;
using test::changed;
using test::contents_of;
using test::Ended;
using test::kerf;
using test::TemporaryFolder;

const std::string pedicle_screw = KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml";
/// A run that is over soon, before anything is cut.
const std::string short_run = "run " + pedicle_screw + " --set 'accuracy.spacing=0.5 mm' --set 'time_limit=1 s'";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// ---- replays ------------------------------------------------------------------------------------------------------

TEST(Replay, FollowsTheRehearsalOfItsSession) {
    const TemporaryFolder folder;
    const std::string record = folder / "record",
                      replay = " --replay " + record + "/session.db --out " + (folder / "again");
    ASSERT_EQ(kerf(short_run + " --hand medial-breach --out " + record).exit_code, 1);

    const Ended same = kerf(short_run + replay);
    EXPECT_TRUE(has(same.out, "replay: the same bits\n")) << same.out << same.err;
    EXPECT_EQ(same.exit_code, 1);
    EXPECT_TRUE(has(contents_of(folder / "again/report.html"), "rehearsal medial-breach"));
    EXPECT_TRUE(has(kerf(short_run + " --hand medial-breach" + replay).out, "replay: the same bits\n"));
}

TEST(Replay, RefusesAnotherHandThanRecorded) {
    const TemporaryFolder folder;
    const std::string record = folder / "record/session.db";
    ASSERT_EQ(kerf(short_run + " --out " + (folder / "record")).exit_code, 1);

    const Ended other = kerf(short_run + " --hand medial-breach --replay " + record + " --out " + (folder / "again"));
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_EQ(other.err, "kerf: " + record +
                             ": was recorded with the rehearsal `expert`, and `--hand` is "
                             "`medial-breach`. Leave out `--hand`.\n");
    EXPECT_FALSE(fs::exists(folder / "again"));
}

/// A short run, recorded; then its record is changed.
struct ChangedRecord {
    TemporaryFolder folder;
    std::string record = folder / "record/session.db";

    explicit ChangedRecord(const char* sql, bool is_plain = false) {
        EXPECT_EQ(kerf(short_run + " --out " + (folder / "record")).exit_code, 1);
        if (is_plain) {
            EXPECT_EQ(test::make_rows_plain(record), "");
        }
        EXPECT_TRUE(changed(record, sql));
    }
    [[nodiscard]] Ended replayed() const {
        return kerf(short_run + " --replay " + record + " --out " + (folder / "again"));
    }
};

TEST(Replay, ReportsAChangedRecording) {
    const ChangedRecord run("UPDATE metrics SET value=0; UPDATE session SET value='pass' WHERE key='result.verdict'");
    const Ended replayed = run.replayed();
    EXPECT_EQ(replayed.exit_code, 3);
    EXPECT_TRUE(has(replayed.out, "replay: the same bits\n")) << replayed.out << replayed.err;
    EXPECT_TRUE(has(replayed.out, "was CHANGED after its run wrote it")) << replayed.out;
    const Ended page = kerf("report " + run.record + " --out " + (run.folder / "page/again.html"));
    EXPECT_EQ(page.exit_code, 2);
    EXPECT_TRUE(has(page.err, "not those that the run wrote")) << page.err;
    EXPECT_FALSE(fs::exists(run.folder / "page"));
}

TEST(Replay, EndsWithAFaultWhereTheBitsDiffer) {
    // Sessions of version 2 have plain rows and no checksum: the hash alone decides.
    const ChangedRecord run("UPDATE session SET value='0123456789abcdef' WHERE key='hash'; DELETE FROM session "
                            "WHERE key='record_checksum'; PRAGMA user_version=2",
                            true);
    const Ended replayed = run.replayed();
    EXPECT_EQ(replayed.exit_code, 3) << replayed.out << replayed.err;
    EXPECT_TRUE(has(replayed.out, "replay: NOT the same bits\n")) << replayed.out << replayed.err;
    EXPECT_FALSE(has(replayed.out, "CHANGED")) << replayed.out;
}

TEST(Replay, ReportsThatNothingCouldBeCompared) {
    const ChangedRecord run("UPDATE session SET value='running' WHERE key='state'; DELETE FROM session WHERE key "
                            "IN ('hash', 'record_checksum', 'summary') OR key LIKE 'result.%'");
    const Ended replayed = run.replayed();
    EXPECT_EQ(replayed.exit_code, 1);
    EXPECT_TRUE(has(replayed.out, "replay: nothing to compare with")) << replayed.out << replayed.err;
}

// ---- signals ------------------------------------------------------------------------------------------------------

TEST(Signal, IgnoredAtTheStartStaysIgnored) {
    const TemporaryFolder folder;
    for (const std::string signal : {"HUP", "INT", "TERM"}) {
        const std::string out = folder / signal, run = KERF_BUILD_DIR "/bin/kerf " + short_run + " --out " + out;
        const Ended ended = kerf("--version", "trap '' " + signal + "; " + run + " & child=$!; i=0; while [ ! -e " +
                                                  out + "/session.db ] && [ $i -lt 600 ]; do kill -" + signal +
                                                  " $child; i=$((i+1)); sleep 0.05; done; kill -" + signal +
                                                  " $child; wait $child; echo ended $?;");
        EXPECT_TRUE(has(ended.out, "ended 1\n")) << signal << ended.out << ended.err;
        EXPECT_FALSE(has(ended.err, "interrupted")) << ended.err;
    }
}

// ---- stdout -------------------------------------------------------------------------------------------------------

const std::vector<std::string> commands{"list",
                                        "schema",
                                        "schema anatomy",
                                        "explain",
                                        "explain E0412",
                                        "describe",
                                        "expand " + pedicle_screw,
                                        "validate " + pedicle_screw,
                                        "validate --format json " + pedicle_screw,
                                        "--help",
                                        "run --help",
                                        "--version",
                                        "privacy " + pedicle_screw};

TEST(Stdout, ThatIsFullIsAnErrorOfEveryCommand) {
    for (const std::string& command : commands) {
        const Ended ended = kerf(command + " > /dev/full");
        EXPECT_EQ(ended.exit_code, 3) << command;
        EXPECT_EQ(ended.err, "kerf: stdout could not be written: No space left on device. The output is "
                             "incomplete. Write it to another file.\n")
            << command;
    }
}

TEST(Stdout, ThatIsClosedIsAnErrorOfEveryCommand) {
    for (const std::string& command : commands) {
        const Ended ended = kerf(command + " >&-");
        EXPECT_EQ(ended.exit_code, 3) << command;
        EXPECT_TRUE(ended.err.starts_with("kerf: stdout could not be written: it is closed.")) << command << ended.err;
    }
    EXPECT_EQ(kerf("explain E9999 >&-").exit_code, 2);  // which prints nothing there
}

TEST(Stdout, ThatEndsEarlyIsAnError) {
    const TemporaryFolder folder;
    const Ended cut = kerf("schema > " + (folder / "schema.json"), "ulimit -f 8;");  // blocks of 512 or 1024 bytes
    EXPECT_EQ(cut.exit_code, 3);
    EXPECT_TRUE(has(cut.err, "stdout could not be written: File too large")) << cut.err;
}

TEST(Stdout, ClosedWithAllOthersNeverGetsIntoAFile) {
    const TemporaryFolder folder;
    const Ended ended = kerf(short_run + " --out " + (folder / "run") + " <&- >&- 2>&-");
    EXPECT_EQ(ended.exit_code, 3);
    EXPECT_TRUE(contents_of(folder / "run/session.db").starts_with("SQLite format 3"));
    EXPECT_TRUE(contents_of(folder / "run/summary.json").starts_with("{"));
    EXPECT_EQ(kerf("report " + (folder / "run/session.db") + " --out " + (folder / "a.html")).exit_code, 0);
}

// ---- hostile names ------------------------------------------------------------------------------------------------

TEST(Printed, NeverHoldsAControlCharacter) {
    // Given documents, folders and words with escape sequences in them
    const TemporaryFolder folder;
    const std::string escape = "\033]0;owned\a\033[2J\u009b31m\u202e";
    const std::string odd = folder / ("odd" + escape + ".yaml");
    std::string text = contents_of(pedicle_screw);
    text.insert(text.find("steps:"), "\"\\e]0;owned\\a\\e[2J\\x9b\\u202e\": 1\n");
    std::ofstream(odd) << text;
    std::ofstream(folder / ("lib" + escape + ".so")) << "no plugin";
    const std::string quoted = "'" + odd + "'", hostile = "'" + escape + "'";

    for (const std::string& command : {"validate " + quoted,
                                       "validate --format json " + quoted,
                                       "validate --format github " + quoted,
                                       "expand " + quoted,
                                       "run " + quoted,
                                       "run " + pedicle_screw + " --hand " + hostile,
                                       "run " + pedicle_screw + " --replay " + hostile,
                                       "run " + pedicle_screw + " --set " + hostile,
                                       "run " + pedicle_screw + " --out /dev/null/" + hostile,
                                       "explain " + hostile,
                                       "describe " + hostile,
                                       "report " + hostile,
                                       "import " + hostile,
                                       "privacy " + hostile,
                                       "privacy " + quoted,
                                       "schema " + hostile,
                                       hostile,
                                       "run --" + hostile,
                                       "preview " + quoted,
                                       "anatomy check " + quoted + " --for " + pedicle_screw}) {
        const Ended ended = kerf(command, "KERF_PLUGIN_PATH='" + folder.path() + ":/nowhere" + escape + "'");
        EXPECT_EQ(ended.out, text::printable_lines(ended.out)) << command;
        EXPECT_EQ(ended.err, text::printable_lines(ended.err)) << command;
        EXPECT_TRUE(has(ended.err + ended.out, "\\x1b]0;owned\\x07\\x1b[2J\\x9b31m\\u202e")) << command << ended.err;
    }
}

// ---- memory, threads, stack ---------------------------------------------------------------------------------------

TEST(OutOfMemory, EndsWithASentenceWhateverTheLimit) {
    const TemporaryFolder folder;
    bool is_said = false;
    for (const int megabytes : {60, 70, 80, 90})
        for (const std::string& command :
             {short_run + " --out " + (folder / "run"), "validate --bone " + pedicle_screw}) {
            const Ended ended = kerf(command, "ulimit -v " + std::to_string(megabytes * 1024) + ";");
            EXPECT_TRUE(ended.exit_code >= 0 && ended.exit_code <= 3)
                << megabytes << " " << ended.exit_code << ended.err;
            EXPECT_TRUE(ended.exit_code <= 1 || !ended.err.empty()) << megabytes;
            EXPECT_FALSE(has(ended.err, "terminate")) << ended.err;
            is_said = is_said || (ended.exit_code == 3 && has(ended.err, "kerf: out of memory: "));
        }
    EXPECT_TRUE(is_said);
}

TEST(OutOfMemory, NamesTheLimitWhereNoPictureCanBeDrawn) {
    const TemporaryFolder folder;
    for (const char* limit : {"ulimit -v 100000", "ulimit -d 16000"}) {  // kB
        const Ended ended =
            kerf("view " KERF_SOURCE_DIR "/tests/sessions/schema-5.db --recorded --screenshot " + (folder / "v.png"),
                 std::string(limit) + ";");
        EXPECT_EQ(ended.exit_code, 3) << ended.err;
        EXPECT_TRUE(has(ended.err, "`" + std::string(limit, 9) + "`")) << ended.err;
    }
}

TEST(SmallStack, IsRaisedOrRefused) {
    EXPECT_EQ(kerf("validate --bone " + pedicle_screw, "ulimit -S -s 256;").exit_code, 0);
    const Ended refused = kerf("validate --bone " + pedicle_screw, "ulimit -s 256;");
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_TRUE(has(refused.err, "the stack is limited to 256 kB")) << refused.err;
}

// ---- folders ------------------------------------------------------------------------------------------------------

TEST(Out, TooLongLeavesNoFolder) {
    const TemporaryFolder folder;
    std::string deep = folder / "a";
    while (deep.size() < 3900) deep += "/aaaaaaaaa";
    for (const std::string& out :
         {deep, folder / ("b/" + std::string(300, 'c')), folder / ("d/e/" + std::string(470, 'f'))}) {
        const Ended ended = kerf(short_run + " --out " + out);
        EXPECT_EQ(ended.exit_code, 2) << ended.err;
        EXPECT_TRUE(fs::is_empty(folder.path())) << out.substr(0, 100);
    }
    EXPECT_EQ(kerf(short_run + " --out " + (folder / "g/h")).exit_code, 1);
}

TEST(Out, OfADeletedWorkingFolderIsRefused) {
    const TemporaryFolder folder;
    const std::string gone =
        "mkdir " + (folder / "gone") + "; cd " + (folder / "gone") + "; rmdir " + (folder / "gone") + ";";
    for (const std::string& command : {short_run + " --out run", std::string("report x.db --out page.html")}) {
        const Ended ended = kerf(command, gone);
        EXPECT_EQ(ended.exit_code, 2);
        EXPECT_TRUE(has(ended.err, "the working folder no longer exists")) << ended.err;
    }
}

TEST(Out, IsUsableAfterARunThatFoundNoRoom) {
    const TemporaryFolder folder;
    const std::string out = folder / "run";
    EXPECT_EQ(kerf(short_run + " --out " + out, "ulimit -f 0;").exit_code, 3);
    EXPECT_EQ(kerf(short_run + " --out " + out).exit_code, 1);
}

TEST(Outputs, OfARunPassPrivacy) {
    const TemporaryFolder folder;
    ASSERT_EQ(kerf(short_run + " --out " + (folder / "run")).exit_code, 1);
    const std::string run = folder / "run";
    const Ended checked =
        kerf("privacy " + run + "/session.db " + run + "/summary.json " + run + "/report.html " + run + "/bone.stl");
    EXPECT_EQ(checked.exit_code, 0) << checked.out;
}

}  // namespace
}  // namespace kerf::app
