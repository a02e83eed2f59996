// SPDX-License-Identifier: Apache-2.0
// Each test of the kit notices its animal: a plugin with one fault, which fails that test before any other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "conformance/check.h"
#include "conformance/procedures.h"
#include "conformance/report.h"
#include "tests/support/temporary_folder.h"

namespace kerf::conformance {
namespace {

constexpr const char* child = KERF_BUILD_DIR "/libexec/kerf/kerf-check-child";

struct Animal {
    const char* name;   ///< of its file
    const char* test;   ///< that it fails first
    const char* cause;  ///< part of the text
    Status status = Status::failed;
};

std::ostream& operator<<(std::ostream& out, const Animal& animal) { return out << animal.name; }

std::string file_of(const std::string& name) {
    const bool is_hostile = name.starts_with("plugin_that_");
    return std::string(KERF_BUILD_DIR) + (is_hostile ? "/tests/bad_plugins/" : "/zoo/") + name + ".so";
}

int level_of(const std::string& test) {
    return test == "describe.constant"                                  ? 3
           : test.starts_with("load.") || test.starts_with("describe.") ? 1
           : test.starts_with("shape.")                                 ? 2
           : test.starts_with("physics.")                               ? 4
           : test == "remesh.removal" || test == "remesh.volume"        ? 4
           : test == "remesh.steps"                                     ? 4
                                                                        : 3;
}

const std::vector<Animal>& zoo() {
    static const std::vector<Animal> animals{
        {"is_cut_short", "load.file", "is cut short"},
        {"plugin_that_crashes", "load.opens", "SIGSEGV"},
        {"plugin_that_aborts", "load.opens", "SIGABRT"},
        {"plugin_that_exits", "load.opens", "`exit`"},
        {"plugin_that_throws", "load.opens", "SIGABRT"},
        {"plugin_that_leaves_in_load", "load.opens", "`_exit`"},
        {"plugin_that_loops_in_load", "load.opens", "did not return"},
        {"plugin_that_sleeps_in_load", "load.opens", "did not return"},
        {"plugin_that_says_nothing", "load.entry", "kerf_plugin_entry"},
        {"exports_a_helper", "load.one_export", "helper_of_a_plugin"},
        {"keeps_itself_loaded", "load.unloads", "stays loaded"},
        {"plugin_that_crashes_in_unload", "load.unloads", "SIGSEGV"},
        {"names_a_folder", "load.run_path", "/home/nobody/lib"},
        {"needs_an_executable_stack", "load.stack", "executable stack"},
        {"prints_while_loaded", "load.silent", "prints"},
        {"changes_rounding_while_loaded", "load.rounding", "control word"},
        {"ignores_a_signal", "load.signals", "signal 8"},
        {"leaves_a_file_open", "load.files", "/dev/null"},
        {"sets_the_environment", "load.surroundings", "HOSTILE"},
        {"sets_the_locale", "load.surroundings", "locale"},
        {"starts_a_thread_while_loaded", "load.threads", "1 thread"},
        {"plugin_that_wrong_abi", "describe.abi", "ABI is 7"},
        {"plugin_that_default_out_of_range", "describe.tables", "`size`"},
        {"plugin_that_dangling_parameters", "describe.tables", "SIGSEGV"},
        {"has_no_version", "describe.version", "`new`"},
        {"changes_its_tables", "describe.constant", "Something else"},
        {"plugin_that_fails_in_shape", "shape.default", "cannot be made"},
        {"plugin_that_nan_outline", "shape.default", "radius"},
        {"plugin_that_crashes_in_shape", "shape.default", "in `shape` of `burr`"},
        {"plugin_that_throws_in_shape", "shape.default", "not today"},
        {"plugin_that_exits_in_shape", "shape.default", "`exit`"},
        {"plugin_that_loops_in_shape", "shape.default", "in `shape` of `burr`"},
        {"has_a_nan_outline_at_the_end", "shape.range", "`diameter` 10 mm"},
        {"refuses_without_words", "shape.refusal", "without a word"},
        {"remembers_shapes", "shape.pure", "another outline"},
        {"ignores_the_capacity", "shape.capacity", "`profile_capacity`"},
        {"reads_beyond_its_parameters", "shape.parameters", "beyond the end of `params`"},
        {"thinks_in_kilometres", "shape.size", "mm long"},
        {"is_gripped_in_front", "shape.default", "`grip_z` is 90 mm"},
        {"weighs_too_much", "shape.mass", "12 kg"},
        {"plugin_that_crashes_in_begin", "law.answers", "in `begin` of `burring`"},
        {"plugin_that_crashes_in_resist", "law.answers", "in `resist` of `burring`"},
        {"plugin_that_crashes_in_commit", "law.answers", "in `commit` of `burring`"},
        {"plugin_that_recurses_in_resist", "law.answers", "SIGSEGV"},
        {"plugin_that_aborts_in_resist", "law.answers", "SIGABRT"},
        {"plugin_that_throws_in_resist", "law.answers", "not today"},
        {"plugin_that_throws_an_int_in_commit", "law.answers", "threw an exception"},
        {"plugin_that_exits_in_resist", "law.answers", "`exit`"},
        {"plugin_that_quick_exits_in_resist", "law.answers", "`exit`"},
        {"plugin_that_leaves_in_resist", "law.answers", "`_exit`"},
        {"plugin_that_loops_in_resist", "law.answers", "in `resist` of `burring`"},
        {"plugin_that_sleeps_in_commit", "law.answers", "did not return"},
        {"plugin_that_fails_in_resist", "law.answers", "KERF_FAILED"},
        {"plugin_that_nan_delta", "law.finite", "`delta` is nan"},
        {"plugin_that_nan_wrench", "law.finite", "`wrench[3]`"},
        {"plugin_that_negative_stiffness", "law.sound", "`k` is -5"},
        {"plugin_that_no_direction", "law.sound", "`d`"},
        {"plugin_that_narrow_onset", "law.sound", "`w`"},
        {"plugin_that_unknown_kind", "law.sound", "`kind` is 9"},
        {"plugin_that_too_many_channels", "law.sound", "17 channels"},
        {"has_twin_channels", "law.ids", "id 90"},
        {"pulls_in_air", "law.air", "a force of 1 N"},
        {"jumps_into_contact", "law.continuous", "jumps by"},
        {"plugin_that_nan_signal", "law.signals", "`load`"},
        {"plugin_that_unknown_event", "law.actions", "event number 99"},
        {"plugin_that_unknown_actions", "law.actions", "4000000000 actions"},
        {"strips_what_it_has_not", "law.actions", "the tool has none"},
        {"leaves_half_a_thread", "law.actions", "its `lead`"},
        {"moves_its_thread_away", "law.actions", "pointer `thread`"},
        {"declares_fewer_channels", "law.channels", "declares 1"},
        {"declares_fewer_points", "law.points", "declares 1"},
        {"declares_fewer_queries", "law.queries", "declares 1"},
        {"answers_in_turns", "law.pure", "another wrench"},
        {"plugin_that_writes_const_state", "law.state_kept", "byte"},
        {"remembers_the_densest_bone", "law.undisturbed", "another wrench"},
        {"counts_for_ever", "law.begins_again", "outlives `begin`"},
        {"leaves_garbage_in_its_state", "law.begins_whole", "before `begin`"},
        {"shares_between_instances", "law.instances", "second instance"},
        {"points_into_its_state", "law.moved", "pointer"},
        {"depends_on_the_thread", "law.threads", "thread"},
        {"writes_its_inputs", "law.inputs", "wrote to `drive`"},
        {"reads_beyond_its_inputs", "law.input_ends", "beyond the end of `force_params`"},
        {"writes_beyond_its_channels", "law.output_ends", "beyond the 16"},
        {"writes_beyond_its_state", "law.state_end", "its state"},
        {"keeps_a_pointer", "law.pointers", "kept a pointer"},
        {"throws_within", "law.no_exception", "__cxa_allocate_exception"},
        {"initialises_at_first_use", "law.no_first_use", "__cxa_guard_acquire"},
        {"starts_a_thread_in_a_tick", "law.no_thread", "pthread_create"},
        {"prints_in_a_tick", "law.no_output", "puts"},
        {"reads_the_clock", "law.no_clock", "time"},
        {"draws_random_numbers", "law.no_random", "rand"},
        {"locks", "law.no_lock", "pthread_mutex_lock"},
        {"plugin_that_allocates", "law.no_allocation", "malloc"},
        {"calls_the_system", "law.no_system_call", "system call number"},
        {"changes_rounding_in_a_tick", "law.rounding", "control word"},
        {"declares_too_little_time", "law.time", "the budget is 0.01 µs"},
        {"breaks_at_the_end_of_a_parameter", "range.parameters", "`chip` 5000 N/mm2"},
        {"breaks_with_a_thin_tool", "range.tools", "`diameter` 1 mm"},
        {"divides_by_the_speed", "range.drives", "at rest"},
        {"knows_one_tick", "range.ticks", "ticks of 4 ms"},
        {"knows_no_soft_bone", "range.bone", "0 kg/m³"},
        {"knows_no_leaps", "range.motion", "leaps"},
        {"touches_from_afar", "physics.touch", "above the bone"},
        {"gives_energy", "physics.passive", "it was never given"},
        {"pulls_to_one_side", "physics.mirror", "no mirror images"},
        {"cuts_at_rest", "physics.still", "it removes"},
        {"does_not_touch_at_rest", "physics.rest", "sinks"},
        {"chatters", "physics.settles", "does not settle"},
        {"pulls_itself_in", "physics.ledger", "pulls itself in"},
        {"pulls_itself_sideways", "physics.ledger_sideways", "sideways"},
        {"grows_blunt_in_air", "physics.idle", "five seconds in air"},
        {"prefers_dense_bone", "physics.density", "softer bone"},
        {"yields_to_speed", "physics.feed", "and more"},
        {"thinks_in_ticks", "physics.loop_rate", "1000 Hz"},
        {"thinks_in_voxels", "physics.spacing", "0.4 mm"},
        {"likes_the_grid", "physics.frame", "askew"},
        {"feels_ghosts", "physics.re_entry", "no longer there"},
        {"stops_at_once", "physics.switching", "Switched off"},
        {"cuts_nothing", "physics.removal", "Request `cut`"},
        {"ignores_its_least", "physics.least", "`least`"},
        {"invents_a_status", "remesh.status", "returned 77"},
        {"declines_without_a_word", "remesh.words", "plain UTF-8"},
        {"declines_everything", "remesh.cuts", "not today"},
        {"turns_a_face_over", "remesh.sound", "different sides"},
        {"scrapes_in_air", "remesh.air", "expected none"},
        {"counts_its_calls", "remesh.repeats", "the same request"},
        {"breaks_when_it_is_fine", "remesh.range", "tolerance"},
        {"writes_to_its_request", "remesh.reads", "which is the host's"},
        {"overruns_its_arena", "remesh.arena", "beyond the end of the result's arena"},
        {"ignores_that_it_is_cancelled", "remesh.cancel", "did not return from its work in `remesh` of `groove`"},
        {"leaves_another_rounding", "remesh.process", "rounding mode"},
        {"leaves_bone", "remesh.removal", "bone is left in the path"},
        {"is_a_little_shallow", "remesh.volume", "expected"},
        {"stumbles_over_its_walls", "remesh.steps", "on the surface that it has left"},
        {"finds_more_than_fit", "device.find_bounded", "more devices than `capacity`"},
        {"forgets_the_end_of_a_name", "device.find_bounded", "does not end with NUL"},
        {"spells_its_ids_freely", "device.find_bounded", "`left stylus`"},
        {"finds_two_of_one_id", "device.find_bounded", "two devices the id `left`"},
        {"finds_another_each_time", "device.find_bounded", "other devices", Status::warned},
        {"opens_whatever_is_asked", "device.refuses_unknown_id", "which none has"},
        {"is_silent_about_strangers", "device.refuses_unknown_id", "writes no `message`"},
        {"waits_in_vain", "device.gives_up", "Call `is_cancelled`"},
        {"reads_numbers_from_any_text", "device.takes_any_setting", "threw an exception in `open`"},
        {"weighs_no_number", "device.facts", "its mass must be"},
        {"has_forty_buttons", "device.facts", "32 buttons"},
        {"invents_an_ability", "device.facts", "unknown bits 256"},
        {"is_stronger_for_long", "device.facts", "continuous force"},
        {"twists_without_the_ability", "device.facts", "without KERF_DEVICE_TORQUE"},
        {"counts_backwards", "device.reports", "`reports` falls"},
        {"reports_before_it_is_born", "device.reports", "`age` is -0.001 s"},
        {"loses_its_position", "device.reports", "a position within 5 m"},
        {"stretches_its_rotation", "device.reports", "a unit quaternion"},
        {"turns_without_the_ability", "device.reports", "no KERF_DEVICE_ROTATION"},
        {"bends_without_the_ability", "device.reports", "`deflection[2]` is 0.5"},
        {"presses_a_button_too_many", "device.reports", "states 2 buttons"},
        {"invents_a_flag", "device.reports", "`flags` is 9"},
        {"integrates_any_force", "device.takes_any_command", "whose numbers are nan"},
        {"allocates_in_read", "device.no_allocation", "`read` calls"},
        {"locks_in_write", "device.no_lock", "`write` calls `pthread_mutex_lock`"},
        {"calls_the_system_in_read", "device.no_system_call", "`read` makes the system call number"},
        {"takes_long_to_close", "device.closes", "at most 0.2 s"},
        {"leaves_its_thread", "device.closes", "1 thread(s) running"},
        {"leaves_its_file", "device.closes", "/dev/null"},
        {"leaves_its_memory", "device.closes", "Free them in `close`"},
    };
    return animals;
}

/// Animals with a fault of physics that breaks other laws of physics, too: each runs its test alone.
const std::vector<Animal>& zoo_of_physics() {
    static const std::vector<Animal> animals{
        {"pulls_itself_along_y", "physics.opposes", "it helps with"},
        {"is_harder_on_one_side", "physics.sides", "half a turn"},
        {"turns_the_wrong_way", "physics.spin", "turns it onwards"},
        {"cuts_at_its_tip", "physics.lever", "r × F"},
        {"is_pulled_into_a_corner", "physics.contact", "pulls it in"},
        {"is_softer_on_one_side", "physics.rest_mirror", "on both sides"},
        {"rests_by_the_voxel", "physics.rest_spacing", "on grids of"},
        {"rests_at_its_tip", "physics.rest_lever", "r × F"},
        {"rests_on_its_tip", "physics.rest_sides", "Add contact on that side"},
        {"knows_one_body", "physics.bodies", "body 1"},
        {"knows_one_tissue", "physics.tissues", "mixture of tissue 1"},
        {"adds_tissues_up", "physics.mixture", "half of each"},
        {"takes_soft_bone_for_nothing", "physics.densities", "costs work"},
        {"remembers_bone", "physics.ends", "first tick in air"},
        {"ignores_gaps", "physics.gap", "a gap of 0.3 mm"},
        {"removes_sideways_for_nothing", "physics.work", "it removes bone for"},
        {"thinks_in_millimetres_if_wide", "physics.parameters", "expected no jump"},
        {"caps_a_parameter", "physics.ranges", "to the last bit"},
        {"does_not_feel_its_speed", "physics.drives", "driven less"},
        {"yields_to_fast_feed", "physics.feeds", "the faster feed"},
        {"counts_ticks_as_milliseconds", "physics.clock", "after its drive was switched on"},
        {"knows_no_second_body", "physics.bodies", "one on either side"},
        {"hardens_where_two_parameters_meet", "physics.sets", "expected no jump"},
        {"reports_torque_in_newton_millimetres", "physics.torque_signals", "`torque`"},
        {"forgets_two_pi_in_its_power", "physics.power_signals", "P = 2π n M"},
        {"reports_millinewtons", "physics.force_signals", "`thrust`"},
        {"reports_a_set_speed", "physics.speed_signals", "`speed`"},
        {"reports_its_largest_force", "physics.air_signals", "0.2 s in air"},
    };
    return animals;
}

/// Of whole procedures, which `kerf` runs: what the twin is, where there is one.
struct AnimalInAProcedure {
    const char *name, *twin, *test;
};
constexpr AnimalInAProcedure in_a_procedure[] = {
    {"cuts_nothing", "", "procedure.rehearsals"},
    {"differs_by_process", "", "procedure.replay"},
    {"saint", "thinks_in_voxels", "procedure.twin"},
    {"saint", "saint", ""},
};

/// All tests, in the order in which the child lists and reports them.
std::vector<std::string> listed_tests() {
    std::vector<std::string> ids;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen((std::string(child) + " --list").c_str(), "r"),
                                                               &pclose);
    char line[1000];
    while (pipe != nullptr && std::fgets(line, sizeof line, pipe.get()) != nullptr)
        ids.push_back(nlohmann::json::parse(line).value("test", ""));
    return ids;
}

/// The pattern of a test and all tests before it. A later test cannot be the first that fails.
std::string up_to(const std::string& test) {
    std::string ids;
    for (const std::string& id : listed_tests()) {
        ids += (ids.empty() ? "" : "|") + id;
        if (id == test) break;
    }
    return "^(" + ids + ")$";
}

class Zoo : public testing::TestWithParam<Animal> {};

TEST_P(Zoo, FailsItsTestFirst) {
    const auto& [name, test, cause, status] = GetParam();
    CheckRequest request{.child = child, .level = level_of(test)};
    if (status == Status::failed) request.only = up_to(test);  // after a warning all others must pass
    for (const Animal& other : zoo_of_physics())
        request.excluded.emplace_back(std::string("^") + other.test + "$", "its animal runs it alone");
    const PluginReport report = check_plugin(file_of(name), request, {});
    ASSERT_EQ(report.error, "");
    const auto first = std::find_if(report.results.begin(), report.results.end(), [](const TestResult& r) {
        return r.status == Status::failed || r.status == Status::warned;
    });
    ASSERT_NE(first, report.results.end()) << name << " is not noticed";
    if (first->status == Status::skipped) GTEST_SKIP() << first->text;
    EXPECT_EQ(first->id, test) << first->text;
    EXPECT_EQ(first->status, status) << first->text;
    EXPECT_NE(first->text.find(cause), std::string::npos) << first->text;
    EXPECT_EQ(is_conforming(report), status == Status::warned);
}

class ZooOfPhysics : public testing::TestWithParam<Animal> {};

TEST_P(ZooOfPhysics, FailsItsTest) {
    const auto& [name, test, cause, status] = GetParam();
    const CheckRequest request{.child = child, .level = 4, .only = std::string("^") + test + "$"};
    const PluginReport report = check_plugin(file_of(name), request, {});
    ASSERT_EQ(report.error, "");
    ASSERT_EQ(report.results.size(), 1u);
    EXPECT_EQ(report.results[0].status, status) << report.results[0].text;
    EXPECT_NE(report.results[0].text.find(cause), std::string::npos) << report.results[0].text;
}

INSTANTIATE_TEST_SUITE_P(Of, ZooOfPhysics, testing::ValuesIn(zoo_of_physics()),
                         [](const auto& tested) { return std::string(tested.param.name); });
INSTANTIATE_TEST_SUITE_P(Of, Zoo, testing::ValuesIn(zoo()),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(ZooOfTheKit, WholeProceduresNoticeTheirAnimals) {
    const test::TemporaryFolder folder;  // the installed example finds its anatomy among the shipped ones
    std::filesystem::copy(KERF_SOURCE_DIR "/procedures/anatomy", folder / "anatomy");
    std::filesystem::copy(KERF_SOURCE_DIR "/examples/02_round_burr/round_burr.yaml", folder / "round_burr.yaml");
    for (const auto& [name, twin, test] : in_a_procedure) {
        const CheckRequest request{.child = child,
                                   .level = 5,
                                   .only = "^procedure",
                                   .program = KERF_BUILD_DIR "/bin/kerf",
                                   .procedures = {folder / "round_burr.yaml"},
                                   .twin = *twin != '\0' ? file_of(twin) : std::string()};
        const PluginReport report = check_plugin(file_of(name), request, {});
        ASSERT_EQ(report.error, "");
        ASSERT_EQ(report.results.size(), procedure_tests().size());
        std::string failed;
        for (const TestResult& result : report.results)
            if (result.status == Status::failed) failed += result.id;
        EXPECT_EQ(failed, test) << name << "\n" << report.results.front().output;
    }
}

TEST(ZooOfTheKit, SkipsTestsThatNeedASkippedOne) {
    const PluginReport report = check_plugin(file_of("plugin_that_crashes"), {.child = child, .level = 1}, {});
    const auto result_of = [&](const char* id) {
        const auto found = std::find_if(report.results.begin(), report.results.end(),
                                        [&](const TestResult& result) { return result.id == id; });
        return found != report.results.end() ? *found : TestResult{};
    };
    EXPECT_EQ(result_of("load.opens").status, Status::failed);
    for (const auto& [id, needed] :
         {std::pair{"load.entry", "load.opens"}, {"describe.abi", "load.entry"}, {"describe.tables", "describe.abi"}}) {
        EXPECT_EQ(result_of(id).status, Status::skipped) << id;
        EXPECT_EQ(result_of(id).text, std::string(needed) + " must pass first");
    }
}

TEST(ZooOfTheKit, TheSaintsPass) {
    for (const char* saint : {"saint", "strategy_saint", "device_saint"}) {
        const PluginReport report = check_plugin(file_of(saint), {.child = child, .level = 4}, {});
        for (const TestResult& result : report.results)
            EXPECT_EQ(result.status, Status::passed) << text_of(result, report.path) << result.text;
        EXPECT_TRUE(is_conforming(report));
    }
}

TEST(ZooOfTheKit, SkipsWhatALawLeavesOutOnPurpose) {
    const std::string on_bone = "physics[.](rest|settles|touch|mirror|contact|rest_.*|still)$";
    const auto check = [&](const char* file) {
        return check_plugin(file_of(file), {.child = child, .level = 4, .only = on_bone}, {});
    };
    const PluginReport silent = check("does_not_touch_at_rest"), declares = check("declares_that_it_does_not_rest");
    EXPECT_FALSE(is_conforming(silent));
    EXPECT_EQ(silent.does_not, "");
    EXPECT_TRUE(is_conforming(declares));
    EXPECT_EQ(declares.does_not, "rest on bone (burring)");
    for (const TestResult& result : declares.results)
        EXPECT_EQ(result.text.find("the law does not rest on bone, as it declares") == 0, result.id != "physics.still")
            << result.id << " " << result.text;
    EXPECT_NE(summary_of(declares).find("It does not rest on bone (burring), as it declares."), std::string::npos);
}

TEST(ZooOfTheKit, FeedsAToolAsItDeclares) {
    const auto failed = [](const char* file) {
        std::set<std::string> ids;
        const PluginReport report = check_plugin(file_of(file), {.child = child, .level = 4}, {});
        for (const TestResult& result : report.results)
            if (result.status == Status::failed) ids.insert(result.id + ": " + result.text);
        return ids;
    };
    for (const auto& [declares, mute] :
         {std::pair{"side_file", "mute_file"}, std::pair{"turned_reamer", "mute_reamer"}}) {
        EXPECT_EQ(failed(declares), std::set<std::string>{});
        const std::set<std::string> wrong = failed(mute);
        EXPECT_TRUE(std::any_of(wrong.begin(), wrong.end(),
                                [](const std::string& f) { return f.starts_with("physics.removal"); }))
            << mute << ": fed tip first and not turned, it removes nothing";
    }
}

TEST(ZooOfTheKit, HasAnAnimalForEachTest) {
    const std::vector<std::string> all = listed_tests();
    std::set<std::string> without(all.begin(), all.end());
    for (const std::string& id : procedure_tests()) without.insert(id);
    for (const auto& animal : in_a_procedure) without.erase(animal.test);
    EXPECT_GE(without.size(), 60u);
    const std::set<std::string> listed = without;
    for (const std::vector<Animal>* animals : {&zoo(), &zoo_of_physics()})
        for (const Animal& animal : *animals) {
            EXPECT_TRUE(listed.contains(animal.test)) << animal.test << " is no test";
            without.erase(animal.test);
        }
    for (const std::string& id : without) ADD_FAILURE() << id << " has no animal that fails it";
}

}  // namespace
}  // namespace kerf::conformance
