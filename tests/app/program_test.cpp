// SPDX-License-Identifier: Apache-2.0
// The program as a user or a script sees it: exit codes, what it says and what it leaves behind.
#include "tests/support/program.h"

#include <gtest/gtest.h>
#include <pty.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <thread>
#include <utility>

#include "tests/support/json_schema.h"
#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

using test::contents_of;
using test::Ended;
using test::kerf;
using test::ran_operation;
using test::RanOperation;
using test::TemporaryFolder;

const std::string pedicle_screw = KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml";
const std::string few_rehearsals = " --patch " KERF_SOURCE_DIR "/tests/app/few-rehearsals.yaml";

/// The shipped procedure with `from` replaced, on a coarser grid, which is faster and as good for what is tested here.
std::string variant(const TemporaryFolder& folder, const std::string& from, const std::string& to) {
    std::filesystem::copy(KERF_SOURCE_DIR "/procedures/anatomy", folder / "anatomy",
                          std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing);
    std::string text = contents_of(pedicle_screw);
    for (const auto& [before, after] :
         {std::pair<std::string, std::string>{"spacing: 0.25 mm", "spacing: 0.5 mm"}, {from, to}}) {
        const std::size_t at = text.find(before);
        EXPECT_NE(at, std::string::npos) << before;
        if (at != std::string::npos) text.replace(at, before.size(), after);
    }
    std::ofstream(folder / "variant.yaml") << text;
    return folder / "variant.yaml";
}
/// Its expert gives up after a shallow hole, and the run soon ends.
std::string with_a_shallow_hole(const TemporaryFolder& folder) {
    const std::string whole = "{follow: starting-hole}\n      - {follow: opening}\n      - {follow: tapping}\n"
                              "      - {follow: taking-the-screw}\n"
                              "      - {depth: 35 mm, turn: {by: 13.5 turns, speed: 30 rpm}, do: release}\n";
    return variant(folder, whole,
                   "{depth: -5 mm, direction: surface}\n      - {depth: 5 mm, direction: surface}\n"
                   "      - {depth: -5 mm}\n");
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Program, WritesEveryFileAndNoneOfThemNamesAPath) {
    const TemporaryFolder own;
    const RanOperation run = ran_operation("pedicle-screw/expert", own);
    ASSERT_EQ(run.ended.exit_code, 0) << run.ended.err;
    for (const char* name : {"session.db", "summary.json", "report.html", "bone.stl"}) {
        const std::string bytes = contents_of(run.folder + "/" + name);
        EXPECT_GT(bytes.size(), 500u) << name;
        EXPECT_FALSE(has(bytes, KERF_SOURCE_DIR)) << name;
        EXPECT_FALSE(has(bytes, run.folder)) << name;
        EXPECT_TRUE(has(bytes, "not for diagnosis")) << name;
    }
    EXPECT_FALSE(std::filesystem::exists(run.folder + "/session.db-wal"));
}

/// Changes a session's file by one statement of SQL.
void change(const std::string& session, const std::string& sql) {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open_v2(session.c_str(), &database, SQLITE_OPEN_READWRITE, nullptr), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
    sqlite3_close(database);
}

TEST(Program, AReplayThatEndsInOtherBitsEndsWithThree) {
    // Given a recording of an operation that is not passed
    const TemporaryFolder folder;
    const std::string file = with_a_shallow_hole(folder), session = folder / "run/session.db";
    ASSERT_EQ(kerf("run " + file + " --out " + (folder / "run")).exit_code, 1);
    const std::string replay = "run " + file + " --replay " + session + " --out " + (folder / "again");

    // Then its replay ends as the operation does
    const Ended same = kerf(replay);
    EXPECT_EQ(same.exit_code, 1) << same.err;
    EXPECT_TRUE(has(same.out, "replay: the same bits\n")) << same.out;

    // And with another hash in the recording the replay says so, and ends as a fault
    change(session, "UPDATE session SET value='0123456789abcdef' WHERE key='hash'");
    const Ended other = kerf(replay);
    EXPECT_EQ(other.exit_code, 3) << other.err;
    EXPECT_TRUE(has(other.out, "replay: NOT the same bits\n")) << other.out;
}

TEST(Program, BadInputEndsWithTwoAndWritesNothing) {
    const TemporaryFolder folder;
    const std::string out = folder / "bad";
    for (const std::string& what :
         {std::string("run /nowhere.yaml"),
          std::string("run " KERF_SOURCE_DIR "/procedures/anatomy/vertebra-phantom.yaml"),
          "run " + pedicle_screw + " --hand nobody", "run " + pedicle_screw + " --replay " KERF_SOURCE_DIR "/README.md",
          std::string("fly"), std::string("run")}) {
        const Ended bad = kerf(what + " --out " + out);
        EXPECT_EQ(bad.exit_code, 2) << what;
        EXPECT_NE(bad.err, "") << what;
        EXPECT_FALSE(std::filesystem::exists(out)) << what;
    }
    EXPECT_TRUE(has(kerf("run " + pedicle_screw + " --hand nobody").err,
                    "there is no rehearsal `nobody`. Write `expert`, `no-starting-hole`, `medial-breach`, "
                    "`backed-out`, `overtightened`, `slow`, `hasty`, `too-deep` or 3 more.\n"));
}

TEST(Program, WhatCannotBeRunIsSaidBeforeTheBoneIsMade) {
    // That an axis meets no bone is known once there is a bone
    const std::string run =
        "run " KERF_SOURCE_DIR "/tests/golden/W0712.yaml --anatomy " KERF_SOURCE_DIR "/tests/golden/E0610.yaml";
    const std::string made = kerf(run).err;
    ASSERT_TRUE(has(made, "E0610")) << made;
    const std::string hand = kerf(run + " --hand nobody").err,
                      replay = kerf(run + " --replay " KERF_SOURCE_DIR "/README.md").err;
    EXPECT_TRUE(has(hand, "there is no rehearsal `nobody`. Write `expert`.")) << hand;
    EXPECT_FALSE(has(hand, "E0610")) << hand;
    EXPECT_TRUE(has(replay, "README.md")) << replay;
    EXPECT_FALSE(has(replay, "E0610")) << replay;
}

TEST(Program, WhereNothingCanBeWrittenIsSaidBeforeTheWorkAndNoOtherFileIsWrittenOver) {
    const TemporaryFolder folder;
    const std::string file = folder / "notes.txt";
    std::ofstream(file) << "mine";
    for (const std::string& command :
         {"run " + pedicle_screw, "plan " + pedicle_screw, std::string("stability"), std::string("chart")})
        for (const std::string& out : {file, file + "/deeper"}) {
            const Ended ended = kerf(command + " --out " + out);
            EXPECT_EQ(ended.exit_code, 2) << command;
            EXPECT_EQ(ended.out, "") << command;
            EXPECT_EQ(ended.err, "kerf: `--out` is `" + out + "`, which cannot be written: `" + file +
                                     "` is a file. Give another folder.\n");
        }
    const Ended preview = kerf("preview " + pedicle_screw + " --out " + file);
    EXPECT_EQ(preview.exit_code, 2);
    EXPECT_EQ(preview.err, "kerf: `--out` is `" + file + "`, and must be an .html file. Write `--out page.html`.\n");
    EXPECT_EQ(contents_of(file), "mine");
}

TEST(Program, ReportsFromTheSessionAloneByteForByteAndIntoNoOtherFile) {
    const TemporaryFolder own, folder, elsewhere;
    const RanOperation run = ran_operation("pedicle-screw/expert", own);
    ASSERT_EQ(run.ended.exit_code, 0) << run.ended.err;
    const std::string page = contents_of(run.folder + "/report.html"),
                      session = contents_of(run.folder + "/session.db");

    // Alone in a folder, seen from there, and read without the right to write
    std::filesystem::copy_file(run.folder + "/session.db", elsewhere / "session.db");
    std::filesystem::permissions(elsewhere / "session.db", std::filesystem::perms(0444));
    const Ended made = kerf("report session.db --out " + (folder / "new/again.html"), "cd " + elsewhere.path() + " &&");
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_EQ(made.err, "");
    EXPECT_TRUE(contents_of(folder / "new/again.html") == page);
    EXPECT_TRUE(contents_of(elsewhere / "session.db") == session);
    EXPECT_EQ(
        std::distance(std::filesystem::directory_iterator(elsewhere.path()), std::filesystem::directory_iterator()), 1);
    const Ended replayed = kerf("run " + pedicle_screw + " --replay session.db --out " + (folder / "replay"),
                                "cd " + elsewhere.path() + " &&");
    EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
    EXPECT_TRUE(has(replayed.out, "replay: the same bits")) << replayed.out << replayed.err;
    EXPECT_TRUE(contents_of(elsewhere / "session.db") == session);
    EXPECT_EQ(kerf("report " + (elsewhere / "session.db")).exit_code, 0);
    EXPECT_TRUE(contents_of(elsewhere / "report.html") == page);

    // Never in place of a session, and of nothing else
    for (const std::string& wrong : {(elsewhere / "session.db") + " --out " + (elsewhere / "session.db"),
                                     (elsewhere / "none.db"), pedicle_screw, std::string()})
        EXPECT_EQ(kerf("report " + wrong).exit_code, 2) << wrong;
    EXPECT_TRUE(contents_of(elsewhere / "session.db") == session);
}

/// A run in a process group of its own, stopped from the moment it has a session until the group gets SIGCONT.
pid_t begun_and_held(const std::string& out, const std::string& log) {
    const pid_t child = fork();
    if (child == 0) {
        setpgid(0, 0);
        if (std::freopen(log.c_str(), "w", stdout) == nullptr ||
            std::freopen((log + ".err").c_str(), "w", stderr) == nullptr)
            _exit(127);
        execl(KERF_BUILD_DIR "/bin/kerf", "kerf", "run", pedicle_screw.c_str(), "--out", out.c_str(), nullptr);
        _exit(127);
    }
    for (int i = 0; i < 12'000 && !std::filesystem::exists(out + "/session.db-wal"); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    kill(-child, SIGSTOP);
    return child;
}

int exit_code_of(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Waits until a text is in a file, at most a minute. Returns the file's text.
std::string text_with(const std::string& file, const std::string& wanted) {
    for (int i = 0; i < 600 && !has(contents_of(file), wanted); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return contents_of(file);
}

/// One value of a session's table of keys and values.
std::string stored(const std::string& session, const std::string& table, const std::string& key) {
    sqlite3* database = nullptr;
    sqlite3_stmt* statement = nullptr;
    std::string value = "none";
    const std::string sql = "SELECT value FROM " + table + " WHERE key='" + key + "'";
    if (sqlite3_open_v2(session.c_str(), &database, SQLITE_OPEN_READONLY, nullptr) == SQLITE_OK &&
        sqlite3_prepare_v2(database, sql.c_str(), -1, &statement, nullptr) == SQLITE_OK &&
        sqlite3_step(statement) == SQLITE_ROW)
        value = reinterpret_cast<const char*>(sqlite3_column_text(statement, 0));
    sqlite3_finalize(statement);
    sqlite3_close(database);
    return value;
}

TEST(Program, NamesTheLastCallWhenItsParentIsKilledOrStopped) {
    for (const auto& [signal, what] :
         {std::pair{SIGKILL, "parent process was killed"}, {SIGSTOP, "parent process was stopped"}}) {
        const TemporaryFolder folder;
        const pid_t child = begun_and_held(folder / "run", folder / "log");
        kill(-child, SIGCONT);
        kill(child, signal);  // the worker runs on
        const std::string err = text_with(folder / "log.err", what);
        EXPECT_TRUE(has(err, what) && has(err, "plugin kerf.")) << err;
        EXPECT_EQ(exit_code_of(child), signal == SIGKILL ? -1 : 3);
        EXPECT_EQ(kerf("report " + (folder / "run/session.db")).exit_code, 0) << "what was recorded is readable";
    }
}

TEST(Program, InterruptedARunWritesWhatWasDoneAndNobodyElseMayWriteThereMeanwhile) {
    const TemporaryFolder folder;
    const std::string out = folder / "run";
    const pid_t child = begun_and_held(out, folder / "log");
    ASSERT_TRUE(std::filesystem::exists(out + "/session.db-wal"));

    const Ended second = kerf("run " + variant(folder, "1 mm/s", "1 mm/s") + " --out " + out);
    EXPECT_EQ(second.exit_code, 2);
    EXPECT_TRUE(has(second.err, "is being written by another run")) << second.err;

    kill(-child, SIGINT);  // to the program and its worker, as a terminal does: this is one interruption
    kill(-child, SIGCONT);
    EXPECT_EQ(exit_code_of(child), 3);
    EXPECT_TRUE(has(contents_of(folder / "log.err"), "interrupted")) << contents_of(folder / "log.err");
    const std::string summary = contents_of(out + "/summary.json");
    EXPECT_TRUE(has(summary, "\"verdict\": \"incomplete\"")) << summary;
    EXPECT_TRUE(has(summary, "The run was interrupted.")) << summary;
    EXPECT_EQ(stored(out + "/session.db", "session", "state"), "finished");
    for (const char* name : {"report.html", "bone.stl"}) EXPECT_TRUE(std::filesystem::exists(out + "/" + name)) << name;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(out), std::filesystem::directory_iterator()), 4);
}

TEST(Program, TheSameRunTwiceDiffersInItsEnvelopeOnly) {
    const TemporaryFolder folder;
    const std::string file = with_a_shallow_hole(folder);
    for (const char* out : {"a", "b"})
        ASSERT_EQ(kerf("run " + file + " --learner L17 --out " + (folder / out)).exit_code, 1);
    for (const char* name : {"summary.json", "report.html", "bone.stl"})
        EXPECT_EQ(contents_of(folder / "a/" + name), contents_of(folder / "b/" + name)) << name;

    const std::string a = folder / "a/session.db", b = folder / "b/session.db";
    EXPECT_EQ(stored(a, "session", "hash"), stored(b, "session", "hash"));
    EXPECT_NE(stored(a, "envelope", "uuid"), stored(b, "envelope", "uuid"));
    EXPECT_TRUE(stored(a, "envelope", "start").ends_with('Z')) << stored(a, "envelope", "start");
    EXPECT_EQ(stored(a, "envelope", "station"), "");
    EXPECT_EQ(stored(a, "envelope", "learner"), "L17");
}

TEST(Program, WhatDoesNotFitIsSaidTheRestIsWrittenAndNothingIsHalf) {
    const TemporaryFolder folder;
    const std::string out = folder / "run";
    const Ended full = kerf("run " + with_a_shallow_hole(folder) + " --out " + out, "ulimit -f 800;");
    EXPECT_EQ(full.exit_code, 3) << full.err;
    EXPECT_TRUE(has(full.err, "session.db is incomplete")) << full.err;
    EXPECT_TRUE(has(full.err, "bone.stl could not be written")) << full.err;
    EXPECT_TRUE(has(contents_of(out + "/summary.json"), "could not be recorded any more"))
        << contents_of(out + "/summary.json");
    EXPECT_EQ(stored(out + "/session.db", "session", "state"), "incomplete");
    for (const auto& entry : std::filesystem::directory_iterator(out))
        EXPECT_NE(entry.path().extension(), ".part") << entry.path();
    EXPECT_FALSE(std::filesystem::exists(out + "/bone.stl"));
}

TEST(Program, AReplayDoesNotTakeThePlaceOfItsRecording) {
    const TemporaryFolder folder;
    const std::string file = with_a_shallow_hole(folder), out = folder / "run";
    ASSERT_EQ(kerf("run " + file + " --out " + out).exit_code, 1);
    const std::string before = contents_of(out + "/session.db");
    const Ended replay = kerf("run " + file + " --replay " + out + "/session.db --out " + out);
    EXPECT_EQ(replay.exit_code, 2);
    EXPECT_TRUE(has(replay.err, "would overwrite its recording")) << replay.err;
    EXPECT_EQ(contents_of(out + "/session.db"), before);
}

TEST(Program, ValidatesSeveralFilesAndEndsWithTwoIfOneIsWrong) {
    const Ended good = kerf("validate " + pedicle_screw);
    EXPECT_EQ(good.exit_code, 0) << good.out << good.err;
    EXPECT_EQ(good.out, pedicle_screw + ": no errors\n");

    const Ended one_bad = kerf("validate /nowhere.yaml " + pedicle_screw + " --format github");
    EXPECT_EQ(one_bad.exit_code, 2);
    EXPECT_EQ(one_bad.out,
              "::error file=/nowhere.yaml,title=E0101::The file does not exist. Check its name and its folder.\n");
}

TEST(Program, AVariantIsRecordedAndItsReplayRefusesAnother) {
    // Given a procedure with a variant that is over soon
    const TemporaryFolder folder;
    const std::string file = variant(folder, "variants:\n", "variants:\n  short: {patch: {time_limit: 1 s}}\n");
    const std::string record = folder / "record", again = " --out " + (folder / "again");
    ASSERT_EQ(kerf("run " + file + " --variant short --out " + record).exit_code, 1);

    // Then the session says so, and is a procedure by itself
    EXPECT_EQ(stored(record + "/session.db", "session", "condition.variant"), "short");
    EXPECT_TRUE(has(contents_of(record + "/summary.json"), "\"variant\": \"short\""));
    const std::string text = stored(record + "/session.db", "session", "procedure_text");
    EXPECT_TRUE(has(text, "time_limit: 1 s")) << text;
    EXPECT_FALSE(has(text, "variants")) << text;

    // And only the same variant replays it
    const std::string replay = " --replay " + record + "/session.db" + again;
    const Ended without = kerf("run " + file + replay);
    EXPECT_EQ(without.exit_code, 2);
    EXPECT_TRUE(has(without.err, "with the variant `short`. Write `--variant short`.")) << without.err;
    const Ended other = kerf("run " + file + " --variant short --set 'time_limit=2 s'" + replay);
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_TRUE(has(other.err, "another text of this procedure")) << other.err;
    const Ended same = kerf("run " + file + " --variant short" + replay);
    EXPECT_TRUE(has(same.out, "replay: the same bits")) << same.out << same.err;
}

TEST(Program, ExpandShowsWhereEveryValueComesFrom) {
    const TemporaryFolder folder;
    const std::string file = variant(folder, "variants:\n", "variants:\n  short: {patch: {time_limit: 1 s}}\n");
    const Ended shown = kerf("expand " + file + " --variant short --set haptics.device=touch");
    EXPECT_EQ(shown.exit_code, 0) << shown.err;
    EXPECT_TRUE(shown.out.starts_with("# For training and research")) << shown.out;
    const std::string text = contents_of(file), before = text.substr(0, text.find("  short:"));
    const std::string line = std::to_string(1 + std::count(before.begin(), before.end(), '\n'));
    EXPECT_TRUE(std::regex_search(shown.out, std::regex("time_limit: 1 s +# [^\n]*variant.yaml:" + line + "\n")))
        << shown.out;
    EXPECT_TRUE(std::regex_search(shown.out, std::regex("device: touch +# --set\n"))) << shown.out;
    EXPECT_EQ(kerf("expand " + file + " --variant none").exit_code, 2);
}

TEST(Program, ValidateLooksIntoEveryVariantAndMakesTheBoneWhenAsked) {
    const TemporaryFolder folder;
    const std::string file = variant(folder, "variants:\n", "variants:\n  short: {patch: {time_limit: 1}}\n");
    const Ended checked = kerf("validate " + file);
    EXPECT_EQ(checked.exit_code, 2);
    EXPECT_TRUE(
        has(checked.out, "In the variant `short`: time_limit has no unit: got `1`, expected a time in s. Write `1 s`."))
        << checked.out;
    EXPECT_EQ(kerf("validate " + file + " --set 'time_limit=2 s'").exit_code, 0);

    // The axis leaves the bone: nothing that the documents alone can tell
    std::string anatomy = contents_of(folder / "anatomy/vertebra-l3.yaml");
    const std::string end = "-10.11 -5.95 3.91 mm";
    anatomy.replace(anatomy.find(end), end.size(), "10.1 -96 4 mm");
    const std::string good = variant(folder, "1 mm/s", "1 mm/s");
    std::ofstream(folder / "anatomy/vertebra-l3.yaml") << anatomy;
    EXPECT_EQ(kerf("validate " + good).exit_code, 0);
    const Ended with_bone = kerf("validate --bone " + good);
    EXPECT_EQ(with_bone.exit_code, 2);
    EXPECT_TRUE(has(with_bone.out, "E0611")) << with_bone.out;
}

TEST(Program, DataThatAreNotThereAreMissedByTheFolderThatKerfDataNames) {
    const std::string l3 = "validate " + pedicle_screw + " --anatomy " KERF_SOURCE_DIR "/tests/real-data/l3.yaml";
    const Ended unset = kerf(l3, "unset KERF_DATA;"), elsewhere = kerf(l3, "KERF_DATA=/nowhere");
    EXPECT_EQ(unset.exit_code, 2);
    EXPECT_TRUE(has(unset.out, "KERF_DATA is not set")) << unset.out;
    EXPECT_TRUE(has(unset.out, "name the folder that holds `volumes`, as in `export KERF_DATA=/home/me/data`"))
        << unset.out;
    EXPECT_EQ(elsewhere.exit_code, 2);
    EXPECT_TRUE(has(elsewhere.out, "and in `/nowhere`, which KERF_DATA names")) << elsewhere.out;
}

TEST(Program, ExplainsEveryCodeItShows) {
    const Ended one = kerf("explain E0412");
    EXPECT_EQ(one.exit_code, 0);
    EXPECT_TRUE(one.out.starts_with("E0412  out of range\n")) << one.out;
    EXPECT_TRUE(has(kerf("explain").out, "\nE0413  spacing too fine\n"));
    const Ended unknown = kerf("explain E9999");
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_TRUE(has(unknown.err, "there is no code `E9999`")) << unknown.err;
}

TEST(Program, TheSchemaTakesTheShippedProcedureWithThePluginsThatAreThere) {
    const Ended printed = kerf("schema");
    EXPECT_EQ(printed.exit_code, 0) << printed.err;
    const test::JsonSchema schema(printed.out);
    const std::string text = contents_of(pedicle_screw);
    EXPECT_EQ(schema.breach(test::as_json(text)), "");
    std::string wrong = text;
    wrong.replace(wrong.find("diameter"), 8, "diametre");
    EXPECT_NE(schema.breach(test::as_json(wrong)), "");
}

TEST(Program, APluginFolderThatDoesNotExistIsSaidOnceAndHindersNobody) {
    const Ended listed = kerf("list", "KERF_PLUGIN_PATH=/nowhere:/nowhere");
    EXPECT_EQ(listed.exit_code, 0);
    EXPECT_TRUE(has(listed.out, "kerf.drilling/twist_drill"));
    EXPECT_TRUE(has(listed.err, "KERF_PLUGIN_PATH names `/nowhere`, which does not exist")) << listed.err;
    EXPECT_EQ(listed.err.find("/nowhere"), listed.err.rfind("/nowhere")) << listed.err;
}

TEST(Program, OnATerminalMakingTheBoneShowsASignOfLife) {
    // Given a terminal of its own
    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
    if (child < 0) GTEST_SKIP() << "there are no pseudo-terminals here";
    if (child == 0) {
        execl(KERF_BUILD_DIR "/bin/kerf", "kerf", "validate", "--bone", pedicle_screw.c_str(), nullptr);
        _exit(127);
    }
    std::string seen;
    char some[512];
    for (ssize_t count = 0; (count = read(terminal, some, sizeof some)) > 0;)
        seen.append(some, static_cast<std::size_t>(count));
    int status = 0;
    waitpid(child, &status, 0);
    close(terminal);

    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_TRUE(has(seen, "making the bone of")) << seen;
    EXPECT_TRUE(has(seen, "\r\033[KPhantom: ")) << seen;  // notes on a line of their own
    EXPECT_TRUE(has(seen, ": no errors")) << seen;
}

TEST(Program, RehearsingSaysWhatWasExpectedAndWhatHappened) {
    const Ended rehearsed = kerf("rehearse " + pedicle_screw + few_rehearsals + " --set 'accuracy.spacing=0.5 mm'");
    EXPECT_EQ(rehearsed.exit_code, 0) << rehearsed.err;
    EXPECT_TRUE(has(rehearsed.out, "expert: ended as expected\n  expected  pass\n  ended     pass, score 100\n"))
        << rehearsed.out;
    EXPECT_TRUE(has(rehearsed.out, "expected  fail by `canal`, and others may break\n  ended     fail, score 0\n      "
                                   "      Step `pilot-hole`: The drill "
                                   "entered"))
        << rehearsed.out;
    EXPECT_TRUE(has(rehearsed.out, "4 of 4 rehearsals ended as expected")) << rehearsed.out;
}

TEST(Program, ARehearsalThatEndsOtherwiseThanItSaysEndsWithOne) {
    const TemporaryFolder folder;
    const Ended rehearsed =
        kerf("rehearse" + few_rehearsals + " --set rehearsals.no-starting-hole=~ --set rehearsals.backed-out=~ " +
             variant(folder, "expect: pass", "expect: {fail: canal}"));
    EXPECT_EQ(rehearsed.exit_code, 1) << rehearsed.err;
    EXPECT_TRUE(has(rehearsed.out, "expert: NOT AS EXPECTED")) << rehearsed.out;
    EXPECT_TRUE(has(rehearsed.out, "1 of 2")) << rehearsed.out;
}

TEST(Program, ANewProcedureCoversItsLimitsAndNoBadHandPassesIt) {
    const TemporaryFolder folder;
    const std::string made = folder.path() + "/mine", file = made + "/my_hole.yaml";
    const Ended written = kerf("new procedure my_hole --out " + made);
    EXPECT_EQ(written.exit_code, 0) << written.err;
    EXPECT_TRUE(has(written.out, "kerf rehearse " + file + " --coverage\n")) << written.out;
    const Ended validated = kerf("validate --bone " + file);
    EXPECT_EQ(validated.exit_code, 0) << validated.err;
    EXPECT_TRUE(has(validated.out, ": no errors")) << validated.out;
    EXPECT_FALSE(has(validated.out + validated.err, "W0")) << validated.out << validated.err;
    const Ended rehearsed = kerf("rehearse --coverage " + file);
    EXPECT_EQ(rehearsed.exit_code, 0) << rehearsed.err;
    EXPECT_TRUE(
        has(rehearsed.out, "4 of 4 rehearsals ended as expected\n" + file + ": 0 steps and limits are not covered\n"))
        << rehearsed.out;
    const Ended cheated = kerf("rehearse --cheats " + file);
    EXPECT_EQ(cheated.exit_code, 0) << cheated.out;
    EXPECT_TRUE(has(cheated.out, "0 of 8 bad hands pass")) << cheated.out;
}

TEST(Program, CheatsAndCoverageExcludeEachOther) {
    const Ended both = kerf("rehearse --cheats --coverage " + pedicle_screw);
    EXPECT_EQ(both.exit_code, 2);
    EXPECT_TRUE(has(both.err, "`--coverage` is of the rehearsals")) << both.err;
}

TEST(Program, CoverageListsLimitsOfOneNameOneByOne) {
    const TemporaryFolder folder;
    EXPECT_EQ(kerf("new procedure my_hole --out " + folder.path() + "/mine").exit_code, 0);
    const std::string file = folder.path() + "/mine/my_hole.yaml";
    std::string text = contents_of(file);
    const std::string limit = "      - {depth: {at_most: 30 mm}";
    text.insert(text.find(limit), "      - {depth: {at_most: 90 mm}, severity: critical, reason: It is far behind.}\n");
    std::ofstream(file) << text;
    const Ended rehearsed = kerf("rehearse --coverage " + file);
    EXPECT_TRUE(has(rehearsed.out, "breaks the limit `depth` of the step `hole`: It is far behind.\n"))
        << rehearsed.out;
    EXPECT_TRUE(has(rehearsed.out, ": 1 steps and limits are not covered\n")) << rehearsed.out;
}

TEST(Program, CoverageListsGuardsApartAndReportsABrokenOne) {
    const TemporaryFolder folder;
    EXPECT_EQ(kerf("new procedure my_hole --out " + folder.path() + "/mine").exit_code, 0);
    const std::string file = folder.path() + "/mine/my_hole.yaml";
    std::string text = contents_of(file);
    const std::string limit = "      - {depth: {at_most: 30 mm}, ";
    text.insert(text.find(limit) + limit.size(), "guard: The chuck stops the drill., ");
    text.insert(text.find(limit),
                "      - {depth: {at_most: 90 mm}, guard: The bone ends., reason: It is far behind.}\n");
    std::ofstream(file) << text;
    const Ended rehearsed = kerf("rehearse --coverage " + file);
    EXPECT_TRUE(has(rehearsed.out, "a guard is the limit `depth` of the step `hole`: The bone ends.\n"))
        << rehearsed.out;
    EXPECT_TRUE(has(rehearsed.out, "a rehearsal breaks the limit `depth` of the step `hole`, so its `guard:`"))
        << rehearsed.out;
    EXPECT_TRUE(has(rehearsed.out, ": 1 steps and limits are not covered, 1 are guards\n")) << rehearsed.out;
}

TEST(Program, WithoutRehearsalsThereIsNothingToRehearse) {
    const TemporaryFolder folder;
    const std::string text = contents_of(pedicle_screw);
    const Ended rehearsed = kerf("rehearse " + variant(folder, text.substr(text.find("rehearsals:")), ""));
    EXPECT_EQ(rehearsed.exit_code, 2);
    EXPECT_TRUE(has(rehearsed.err, "has no rehearsals. Add one under `rehearsals:`.")) << rehearsed.err;
}

}  // namespace
}  // namespace kerf::app
