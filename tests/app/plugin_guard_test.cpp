// SPDX-License-Identifier: Apache-2.0
// Bad plugins, as the program meets them: each row is a plugin with one fault, a command, and what it must end with.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

using test::contents_of;
using test::Ended;
using test::TemporaryFolder;

/// One plugin alone in its folder, with a procedure that uses it.
class Zoo {
public:
    explicit Zoo(const std::string& how) : plugin_(folder_ / ("plugins/plugin_that_" + how + ".so")) {
        namespace fs = std::filesystem;
        fs::create_directory(folder_ / "plugins");
        fs::copy(KERF_BUILD_DIR "/tests/bad_plugins/plugin_that_" + how + ".so", plugin_);
        fs::copy(KERF_SOURCE_DIR "/procedures/anatomy", folder_ / "anatomy", fs::copy_options::recursive);
        std::ofstream(folder_ / "procedure.yaml") << R"(apiVersion: kerf/v1
kind: Procedure
metadata: {id: hostile, title: A burr of a stranger, version: 0.1.0, status: draft, authors: [Nobody]}
needs: {landmarks: [right_pedicle, midline], tissues: [cortical, cancellous]}
anatomy: anatomy/vertebra-phantom.yaml
accuracy: {spacing: 0.5 mm}
haptics: {device: premium-1.5-6dof}
time_limit: 20 s
instruments: {burr: {plugin: test.hostile, tool: burr, force: burring}}
steps:
  - id: groove
    title: Burr a hole
    instrument: burr
    axis: right_pedicle
    goals: [{entry: {}}, {depth: {at_least: 1 mm}}]
rehearsals:
  - id: expert
    title: Along the axis
    expect: pass
    hand: {feed: 5 mm/s, approach: 20 mm/s, push: 50 N, reaction: 150 ms}
    path: [{depth: -20 mm}, {depth: 2 mm}, {depth: -20 mm}]
)";
    }
    [[nodiscard]] Ended kerf(const std::string& command, const std::string& environment = "") const {
        return test::kerf(command, environment + " KERF_PLUGIN_PATH=" + (folder_ / "plugins"));
    }
    [[nodiscard]] Ended run() const { return kerf("run " + procedure() + " --out " + out()); }
    [[nodiscard]] std::string procedure() const { return folder_ / "procedure.yaml"; }
    [[nodiscard]] std::string out() const { return folder_ / "out"; }
    [[nodiscard]] const std::string& plugin() const { return plugin_; }

private:
    TemporaryFolder folder_;
    std::string plugin_;
};

int number_in(const std::string& session, const char* query) {
    sqlite3* database = nullptr;
    sqlite3_stmt* statement = nullptr;
    int number = -1;
    if (sqlite3_open_v2(session.c_str(), &database, SQLITE_OPEN_READONLY, nullptr) == SQLITE_OK &&
        sqlite3_prepare_v2(database, query, -1, &statement, nullptr) == SQLITE_OK &&
        sqlite3_step(statement) == SQLITE_ROW)
        number = sqlite3_column_int(statement, 0);
    sqlite3_finalize(statement);
    sqlite3_close(database);
    return number;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(PluginGuard, LetsASoundPluginPass) {
    const Zoo zoo("nothing_wrong");
    const Ended run = zoo.run();
    EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
}

struct InARun {
    const char *how, *says;
};
class EndsARun : public testing::TestWithParam<InARun> {};

TEST_P(EndsARun, NamesPluginAndCallAndKeepsTheRecord) {
    const auto& [how, says] = GetParam();
    const Zoo zoo(how);
    const Ended run = zoo.run();
    EXPECT_EQ(run.exit_code, 3) << run.out << run.err;
    EXPECT_TRUE(has(run.err, zoo.plugin())) << run.err;
    EXPECT_TRUE(has(run.err, says)) << run.err;

    const Ended report = zoo.kerf("report " + zoo.out() + "/session.db");
    EXPECT_EQ(report.exit_code, 0) << report.err;
    EXPECT_TRUE(has(report.err, std::string("A plugin ended the run. test.hostile: ") + says)) << report.err;
    const std::string page = contents_of(zoo.out() + "/report.html");
    EXPECT_TRUE(has(page, "Ticks")) << page.size();
    EXPECT_FALSE(has(contents_of(zoo.out() + "/session.db"), zoo.plugin())) << "no path in the record";
}

INSTANTIATE_TEST_SUITE_P(
    PluginGuard, EndsARun,
    testing::Values(InARun{"crashes_in_resist", "`resist` of `burring` crashed (SIGSEGV"},
                    InARun{"crashes_in_commit", "`commit` of `burring` crashed (SIGSEGV"},
                    InARun{"recurses_in_resist", "`resist` of `burring` crashed (SIGSEGV"},
                    InARun{"aborts_in_resist", "`resist` of `burring` aborted"},
                    InARun{"throws_in_resist", "`resist` of `burring` threw an exception: not today"},
                    InARun{"throws_an_int_in_commit", "`commit` of `burring` threw an exception"},
                    InARun{"exits_in_resist", "`resist` of `burring` ended the program (`exit`)"},
                    InARun{"exits_in_commit", "`commit` of `burring` ended the program (`exit`)"},
                    InARun{"quick_exits_in_resist", "`resist` of `burring` ended the program (`exit`)"},
                    InARun{"leaves_in_resist", "`resist` of `burring` ended the program (`_exit`)"},
                    InARun{"overruns_channels", "`resist` of `burring` touched memory beyond `channel`, which has 16"},
                    InARun{"overruns_note", "`resist` of `burring` touched memory beyond `note`"},
                    InARun{"overruns_actions", "`commit` of `burring` touched memory beyond `action`, which has 8"},
                    InARun{"overruns_signals", "`commit` of `burring` touched memory beyond `signal`"},
                    InARun{"overruns_state", "`commit` of `burring` touched memory beyond its state"},
                    InARun{"forks_in_resist", "`resist` of `burring` made a copy of the program (`fork`)"},
                    InARun{"interrupts_itself_in_resist", "`resist` of `burring` raised SIGINT, which is the user's"},
                    InARun{"drags_in_resist", "`resist` of `burring` took over 10 ms a call for 10 s"},
                    InARun{"loops_in_resist", "`resist` of `burring` did not come back within 5 s"},
                    InARun{"sleeps_in_commit", "`commit` of `burring` did not come back within 5 s"}),
    [](const auto& tested) { return std::string(tested.param.how); });

/// What a plugin changes of the process, and the words for it.
struct Change {
    const char *how, *what, *values;
};
class ChangesTheProcess : public testing::TestWithParam<Change> {};

TEST_P(ChangesTheProcess, EndsTheRunWithItsNameAndTheValues) {
    const auto& [how, what, values] = GetParam();
    const Zoo zoo(how);
    const Ended run = zoo.run();
    EXPECT_EQ(run.exit_code, 3) << run.out << run.err;
    EXPECT_FALSE(has(run.out, "verdict")) << run.out;
    EXPECT_TRUE(has(run.err, "plugin test.hostile (" + zoo.plugin() + "): `")) << run.err;
    EXPECT_TRUE(has(run.err, std::string("was the last call before Kerf found a change of ") + what + " from "))
        << run.err;
    EXPECT_TRUE(has(run.err, values)) << run.err;
    EXPECT_FALSE(std::filesystem::exists(zoo.out() + "/summary.json"));
}

INSTANTIATE_TEST_SUITE_P(
    PluginGuard, ChangesTheProcess,
    testing::Values(Change{"changes_the_folder_in_resist", "the working folder", " to /, which belongs to Kerf"},
                    Change{"closes_all_files_in_resist", "the descriptor of session.db", " from open to closed"},
                    Change{"lowers_the_file_size_in_resist", "the limit RLIMIT_FSIZE", " to 1000,"},
                    Change{"lowers_the_memory_in_resist", "the limit RLIMIT_AS", " from unlimited to 1048576,"},
                    Change{"takes_a_signal_in_resist", "the handler of SIGSEGV", " from a function to the default,"},
                    Change{"sets_an_alarm_in_resist", "a timer of SIGALRM", " from off to on,"}),
    [](const auto& tested) { return std::string(tested.param.how); });

TEST(PluginGuard, NamesThePluginThatWroteOverTheRecord) {
    const Zoo zoo("writes_over_the_record_in_resist");
    const Ended run = zoo.run();
    EXPECT_EQ(run.exit_code, 3) << run.out << run.err;
    EXPECT_TRUE(has(run.err, "called last: test.hostile (" + zoo.plugin() + ").")) << run.err;
}

TEST(PluginGuard, KeepsTextOfPluginsOutOfItsOwn) {
    const Zoo zoo("prints_in_resist");
    const Ended run = zoo.run();
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.out.find("verdict: pass"), run.out.rfind("verdict: pass")) << run.out;
    EXPECT_FALSE(has(run.err, "all is well")) << run.err;
    const std::string file = zoo.out() + "/plugins.log";
    EXPECT_TRUE(has(run.err, "kerf: plugin test.hostile (" + zoo.plugin() +
                                 ") or a library printed 32 bytes to stdout or stderr, "
                                 "which belong to Kerf: see " +
                                 file))
        << run.err;
    const std::string kept = contents_of(file);
    EXPECT_TRUE(kept.starts_with("For training and research; not for diagnosis")) << kept;
    EXPECT_TRUE(has(kept, "verdict: pass\n") && has(kept, "kerf: all is well\n")) << kept;
    EXPECT_EQ(zoo.run().exit_code, 0) << "the file is a run's and may be replaced";
}

TEST(PluginGuard, BoundsTheTextOfPlugins) {
    const Zoo zoo("prints_for_ever_in_resist");
    const Ended run = zoo.run();
    EXPECT_TRUE(run.out.starts_with("verdict: pass")) << run.out.substr(0, 500);
    const std::string kept = contents_of(zoo.out() + "/plugins.log");
    EXPECT_GT(kept.size(), 1u << 20);
    EXPECT_LT(kept.size(), (1u << 20) + 500);
    EXPECT_TRUE(has(kept.substr(1 << 20), " bytes more.\n"));
}

TEST(PluginGuard, ShowsTextOfPluginsBehindItsOwnWithoutARecord) {
    const Zoo zoo("prints_in_shape");
    const Ended validated = zoo.kerf("validate " + zoo.procedure());
    EXPECT_FALSE(has(validated.out, "verdict")) << validated.out;
    EXPECT_TRUE(has(validated.err, "Text of plugins:\n")) << validated.err;
    EXPECT_TRUE(has(validated.err, "kerf: all is well\n")) << validated.err;
}

TEST(PluginGuard, NamesTheCallThatChangesTheProcess) {
    const Zoo zoo("changes_the_folder_in_shape");
    const Ended validated = zoo.kerf("validate " + zoo.procedure());
    EXPECT_EQ(validated.exit_code, 3) << validated.out;
    EXPECT_TRUE(has(validated.err, "`shape` of `burr` changed the working folder from ")) << validated.err;
}

TEST(PluginGuard, RefusesAPluginThatChangesTheProcessWhenLoaded) {
    for (const auto& [how, says] :
         {std::pair<const char*, const char*>{"changes_the_folder_in_load", ": changed the working folder from "},
          {"changes_rounding_in_load", ": changes the rounding of numbers, or other control words"},
          {"lowers_the_open_files_in_load", ": changed the limit RLIMIT_NOFILE from "},
          {"closes_stdout_in_load", ": changed the descriptor of stdout from open to closed while it was loaded"},
          {"closes_all_files_in_load", ": closed descriptors that are not its own"}}) {
        const Zoo zoo(how);
        const Ended listed = zoo.kerf("list");
        EXPECT_EQ(listed.exit_code, 0) << how;
        EXPECT_TRUE(has(listed.err, zoo.plugin() + ")" + says)) << how << listed.err;
        EXPECT_TRUE(has(listed.out, "kerf.drilling")) << listed.out;
    }
}

TEST(PluginGuard, KeepsEveryTickBeforeTheCrash) {
    const Zoo zoo("crashes_in_resist");
    ASSERT_EQ(zoo.run().exit_code, 3);
    EXPECT_FALSE(std::filesystem::exists(zoo.out() + "/session.db-wal")) << "closed to one file";
    EXPECT_EQ(number_in(zoo.out() + "/session.db", "SELECT count(*) FROM ticks"), 1000) << "the fault is in tick 1000";
    EXPECT_EQ(number_in(zoo.out() + "/session.db", "SELECT count(*) FROM events WHERE id='run.plugin_failed'"), 1);
}

/// Ends of the program that no handler in it sees.
class EndsSilently : public testing::TestWithParam<InARun> {};

TEST_P(EndsSilently, IsNamedByTheParentWithTheTicks) {
    const auto& [how, says] = GetParam();
    const Zoo zoo(how);
    const Ended run = zoo.run();
    EXPECT_EQ(run.exit_code, 3) << run.out << run.err;
    EXPECT_FALSE(has(run.out, "verdict")) << run.out;
    EXPECT_TRUE(has(run.err, "test.hostile (" + zoo.plugin() + ")")) << run.err;
    EXPECT_TRUE(has(run.err, says)) << run.err;
    EXPECT_TRUE(has(run.err, "kept in " + zoo.out() + "/session.db")) << run.err;
    EXPECT_GE(number_in(zoo.out() + "/session.db", "SELECT count(*) FROM ticks"), 500) << "0.5 s before tick 1000";

    const Ended report = zoo.kerf("report " + zoo.out() + "/session.db");
    EXPECT_EQ(report.exit_code, 0) << report.err;
    EXPECT_TRUE(has(contents_of(zoo.out() + "/report.html"), "Nothing was judged") ||
                has(contents_of(zoo.out() + "/report.html"), "nothing was judged"));
}

INSTANTIATE_TEST_SUITE_P(
    PluginGuard, EndsSilently,
    testing::Values(
        InARun{"leaves_by_a_system_call_in_resist", "`resist` of `burring` ended the program with exit code 0"},
        InARun{"becomes_another_program_in_resist", "`resist` of `burring` ended the program with exit code 0"},
        InARun{"kills_itself_in_commit", "`commit` of `burring` ended the program by SIGKILL"},
        InARun{"stops_itself_in_resist", "`resist` of `burring` stopped the program for 5 s"},
        InARun{"leaves_on_a_thread_in_resist", "`resist` of `burring` ended the program with exit code 0"},
        InARun{"crashes_on_a_thread_in_resist", "`resist` of `burring` ended the program by SIGSEGV"},
        InARun{"breaks_the_heap_in_resist", " of `burring`"}),
    [](const auto& tested) { return std::string(tested.param.how); });

TEST(PluginGuard, GivesNoExitCodeToWhatAPluginDoesAtTheEnd) {
    for (const char* how : {"leaves_at_exit_in_resist", "sleeps_at_exit_in_resist", "copies_itself_in_resist"}) {
        const Zoo zoo(how);
        const Ended run = zoo.run();
        EXPECT_EQ(run.exit_code, 0) << how << run.err;
        EXPECT_TRUE(has(run.out, "verdict: pass")) << how << run.out;
    }
}

TEST(PluginGuard, EndsOtherCommandsWithoutAResultLikewise) {
    const Zoo zoo("leaves_by_a_system_call_in_shape");
    for (const std::string command : {"validate ", "rehearse ", "run "}) {
        const Ended ended = zoo.kerf(command + zoo.procedure());
        EXPECT_EQ(ended.exit_code, 3) << command << ended.out;
        EXPECT_TRUE(has(ended.err, "`shape` of `burr` ended the program with exit code 0, without a result"))
            << ended.err;
    }
}

TEST(PluginGuard, EndsRehearseAndStabilityLikewise) {
    for (const char* how : {"exits_in_resist", "crashes_in_commit"}) {
        const Zoo zoo(how);
        const Ended rehearsed = zoo.kerf("rehearse " + zoo.procedure());
        EXPECT_EQ(rehearsed.exit_code, 3) << rehearsed.out;
        EXPECT_TRUE(has(rehearsed.err, zoo.plugin())) << rehearsed.err;
        const Ended stability = zoo.kerf("stability --quick --plugin test.hostile --out " + zoo.out() + "-stability");
        EXPECT_EQ(stability.exit_code, 3) << stability.out;
        EXPECT_TRUE(has(stability.err, zoo.plugin())) << stability.err;
    }
}

TEST(PluginGuard, EndsValidateWhereShapeDoes) {
    for (const auto& [how, says] : {std::pair<const char*, const char*>{"crashes_in_shape", "crashed (SIGSEGV"},
                                    {"throws_in_shape", "threw an exception: not today"},
                                    {"exits_in_shape", "ended the program (`exit`)"},
                                    {"loops_in_shape", "did not come back within 5 s"}}) {
        const Zoo zoo(how);
        const Ended validated = zoo.kerf("validate " + zoo.procedure());
        EXPECT_EQ(validated.exit_code, 3) << how << validated.out;
        EXPECT_TRUE(has(validated.err, zoo.plugin() + "): `shape` of `burr` " + says)) << validated.err;
    }
}

TEST(PluginGuard, NamesTheOutlineThatIsNoSolid) {
    for (const auto& [how, says] :
         {std::pair<const char*, const char*>{"empty_outline", "`profile_count` is 0, expected 2 … 64."},
          {"huge_outline", "`profile_count` is 2000000000, expected 2 … 64."},
          {"cuts_beyond_its_outline", "`cutting_count` is 9, expected 0, or 2 … 4."},
          {"has_an_empty_cutting_part",
           "`cutting_count` is 0 from point 2 on, expected 2 … 2: what cuts has two points"},
          {"begins_beyond_its_outline", "`cutting_first` is 7, expected 0 … 3."},
          {"has_a_bore_wider_than_itself", "`bore` is 2 mm, expected 0 mm: what cuts comes to a point."},
          {"has_a_negative_bore", "`bore` is -1 mm, expected 0 mm"},
          {"has_too_many_gaps", "`gap_count` is 99, expected 0 … 3."},
          {"has_a_gap_at_its_tip", "gap 0 reaches from point 0 to point 1, expected two of those between 0 and 2"},
          {"forward_outline", "point 2: `z` is 1 mm, expected less than -1 mm"},
          {"is_gripped_in_air", "`grip_z` is 60 mm, expected a point less than 1000 mm behind the tip at 0 mm."},
          {"nan_outline", "point 1: `radius` is nan mm, expected 0 mm … 100 mm."},
          {"negative_outline", "point 1: `radius` is -1 mm, expected 0 mm … 100 mm."}}) {
        const Zoo zoo(how);
        const Ended validated = zoo.kerf("validate " + zoo.procedure());
        EXPECT_EQ(validated.exit_code, 2) << how;
        EXPECT_TRUE(has(validated.out, std::string("gives an outline that is no solid: ") + says)) << validated.out;
    }
}

TEST(PluginGuard, NamesAShapeThatIsNoFunctionOfItsParameters) {
    const Zoo zoo("gives_another_outline_each_time");
    const Ended validated = zoo.kerf("validate " + zoo.procedure());
    EXPECT_EQ(validated.exit_code, 2) << validated.out;
    EXPECT_TRUE(has(validated.out, "tool `burr` gives two outlines for the same parameters")) << validated.out;
}

TEST(PluginGuard, NamesWhatWasUnsoundInAThread) {
    for (const auto& [how, says] :
         {std::pair<const char*, const char*>{"thread_in_its_core", "`thread_radius` is 0.1 mm, expected 0 mm, or"},
          {"thread_without_lead", "`thread_lead` is 0 mm, expected more than 0 mm and less than 100 mm."},
          {"stays_without_thread", "`stay_count` is 1, expected 0: without a thread nothing holds it in bone."}}) {
        const Zoo zoo(how);
        const Ended validated = zoo.kerf("validate " + zoo.procedure());
        EXPECT_EQ(validated.exit_code, 2) << validated.out;
        EXPECT_TRUE(has(validated.out, std::string("gives a thread that cannot be: ") + says)) << validated.out;
    }
}

TEST(PluginGuard, NamesWhatWasUnsoundInALaw) {
    for (const auto& [how, says] :
         {std::pair<const char*, const char*>{"nan_delta",
                                              "channel 0 (id 7): `delta` is nan, expected a finite number."},
          {"nan_wrench", "`wrench[3]` is nan, expected a number from -1e+05 to 1e+05."},
          {"pushes", "`wrench[0]` is 1e+06, expected a number from -1e+05 to 1e+05."},
          {"follows_by_far", "channel 0 (id 7): `follow[1]` is 1e+09, expected a number from -1e+06 to 1e+06."},
          {"underruns_channels", "a call wrote in front of `channel`, expected no write outside of it."},
          {"underruns_state", "a call wrote in front of `state`, expected no write outside of it."},
          {"counts_in_static_data", "two calls of `resist` with the same inputs gave two laws, expected one."},
          {"fails_in_commit", "`commit` returned -1 (KERF_FAILED), expected 0 (KERF_OK)."},
          {"nan_signal", "signal `load` is nan, expected a finite number."},
          {"changes_rounding", "a call left another rounding mode, or other traps, of the floating-point unit"},
          {"turns_traps_on_in_resist", "a call left another rounding mode, or other traps, of the floating-point unit"},
          {"negative_stiffness", "channel 0 (id 7): `k` is -5, expected a finite number, 0 or more."},
          {"no_direction", "channel 0 (id 7): `d` is 0, expected a direction"},
          {"narrow_onset", "channel 0 (id 7): `w` is 1e-09, expected 1e-06 or more"},
          {"unknown_kind", "channel 0 (id 7): `kind` is 9, expected 0 (cut)"},
          {"too_many_channels", "its law's `count` is 17, expected at most 16."},
          {"fails_in_resist", "`resist` returned -1 (KERF_FAILED), expected 0 (KERF_OK)."}}) {
        const Zoo zoo(how);
        const Ended run = zoo.run();
        EXPECT_EQ(run.exit_code, 1) << how << run.err;
        const std::string named = "`burring` of test.hostile (plugin_that_" + std::string(how) + ".so): " + says;
        EXPECT_TRUE(has(run.out, named)) << run.out;
        EXPECT_TRUE(has(contents_of(zoo.out() + "/summary.json"), named)) << how;
        const std::string session = contents_of(zoo.out() + "/session.db");
        EXPECT_TRUE(has(session, "haptics.quarantined" + named)) << how << ": the event's detail follows its id";
    }
}

TEST(PluginGuard, MakesTheVerdictOfAnOddLawInvalid) {
    struct Odd {
        const char *how, *event, *says;
    };
    for (const auto& [how, event, says] :
         {Odd{"ratchets", "haptics.law_made_energy", ": within a second it gave the tool "},
          {"flips_its_stiffness", "haptics.law_made_energy", " mJ that it had never taken; its work in all was "},
          {"pushes_along", "haptics.law_made_energy", ": within a second it gave the tool "},
          {"cuts_without_force", "bone.went_without_force", ": it removed "}}) {
        const Zoo zoo(how);
        const Ended run = zoo.run();
        EXPECT_EQ(run.exit_code, 1) << how << run.out << run.err;
        EXPECT_TRUE(has(run.out, "verdict: invalid")) << how << run.out;
        EXPECT_TRUE(has(contents_of(zoo.out() + "/summary.json"), std::string("The force law is unsound. "))) << how;
        EXPECT_TRUE(has(contents_of(zoo.out() + "/summary.json"), says)) << how;
        EXPECT_TRUE(has(contents_of(zoo.out() + "/session.db"), event)) << how;
    }
}

TEST(PluginGuard, NamesALawThatIsSlowerThanItDeclares) {
    const Zoo zoo("slow");
    const Ended run = zoo.run();
    EXPECT_TRUE(has(run.err, "`burring` of test.hostile (plugin_that_slow.so): ")) << run.err;
    EXPECT_TRUE(has(run.err, " calls of `resist` took longer than its budget of 20 us: 99.9 % within ")) << run.err;
}

TEST(PluginGuard, ShowsARefusalWhereThePluginIsMissed) {
    const Zoo zoo("null_drive_id");
    const Ended validated = zoo.kerf("validate " + zoo.procedure());
    EXPECT_EQ(validated.exit_code, 2);
    EXPECT_TRUE(has(validated.out, "E0301")) << validated.out;
    EXPECT_TRUE(has(validated.out, "because of " + zoo.plugin() + ": component `burr`: drive 0: `id` is null"))
        << validated.out;
}

TEST(PluginGuard, RefusesANameOfKerfsOwnElsewhereUnlessItIsAllowed) {
    const Zoo zoo("bears_a_name_of_kerf");
    const Ended refused = zoo.kerf("list");
    EXPECT_EQ(refused.exit_code, 0);
    EXPECT_TRUE(has(refused.err, "plugin kerf.drilling (" + zoo.plugin() + "): its id begins with `kerf.`"))
        << refused.err;
    EXPECT_TRUE(has(refused.err, "write `KERF_PLUGIN_ALLOW=kerf.drilling`")) << refused.err;

    const std::string procedure = zoo.procedure();
    std::string text = contents_of(procedure);
    text.replace(text.find("test.hostile"), 12, "kerf.drilling");
    std::ofstream(procedure) << text;
    EXPECT_EQ(zoo.run().exit_code, 2) << "the shipped plugin has no burr";
    const Ended run = zoo.kerf("run " + procedure + " --out " + zoo.out(), "KERF_PLUGIN_ALLOW=kerf.drilling");
    EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
    EXPECT_TRUE(has(contents_of(zoo.out() + "/summary.json"),
                    "\"kerf.drilling\": \"0.1.0 of another folder, allowed for this run\""));
    EXPECT_TRUE(
        has(contents_of(zoo.out() + "/report.html"), "kerf.drilling 0.1.0 of another folder, allowed for this run"));
    EXPECT_TRUE(has(zoo.kerf("list", "KERF_PLUGIN_ALLOW=kerf.sawing").err, "names `kerf.sawing`, which has no effect"));
}

TEST(PluginGuard, ListGoesOnWithoutAPluginThatCrashes) {
    for (const char* how : {"crashes", "exits", "null_signal_id", "null_parameters"}) {
        const Zoo zoo(how);
        const Ended listed = zoo.kerf("list");
        EXPECT_EQ(listed.exit_code, 0) << how;
        EXPECT_TRUE(has(listed.out, "kerf.drilling")) << listed.out;
        EXPECT_TRUE(has(listed.err, zoo.plugin())) << listed.err;
        EXPECT_EQ(zoo.kerf("validate " KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml").exit_code, 0) << how;
    }
}

}  // namespace
}  // namespace kerf::app
