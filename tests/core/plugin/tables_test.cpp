// SPDX-License-Identifier: Apache-2.0
// Plugins with one fault in their tables: each is refused by name, and the others stay usable.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "core/plugin/loader.h"
#include "core/plugin/plain_text.h"
#include "tests/support/temporary_folder.h"

namespace kerf {
namespace {

std::string file_of(const std::string& how) { return KERF_BUILD_DIR "/tests/bad_plugins/plugin_that_" + how + ".so"; }

TEST(Tables, TakesAPluginWithoutAFault) {
    const PluginLoad load = load_plugin(file_of("nothing_wrong"));
    EXPECT_TRUE(load.plugin) << load.refusal;
}

struct Refused {
    const char* how;
    const char* says;  ///< component, field, value, what is expected
};

class RefusedTables : public testing::TestWithParam<Refused> {};

TEST_P(RefusedTables, NameComponentFieldValueAndRemedy) {
    const auto& [how, says] = GetParam();
    const PluginLoad load = load_plugin(file_of(how));
    EXPECT_FALSE(load.plugin);
    EXPECT_NE(load.refusal.find(" (" + file_of(how) + "): "), std::string::npos) << load.refusal;
    EXPECT_NE(load.refusal.find(says), std::string::npos) << load.refusal;
    EXPECT_TRUE(is_plain(load.refusal)) << load.refusal;
    EXPECT_EQ(load.refusal.find("trial"), std::string::npos) << "found before it did harm: " << load.refusal;
}

INSTANTIATE_TEST_SUITE_P(
    Loader, RefusedTables,
    testing::Values(
        Refused{"wrong_abi", "ABI is 7, need 0: rebuild it"}, Refused{"null_licence", "`licence` is null"},
        Refused{"null_toolchain", "`toolchain` is null"},
        Refused{"huge_component_count", "`component_count` is 1000000000, expected at most 256"},
        Refused{"huge_parameter_count", "component `burr`: `parameter count` is 1000000000, expected at most 256"},
        Refused{"null_parameters", "component `burr`: `parameter count` is 2 with a null table"},
        Refused{"null_component_id", "component 0: `id` is null"},
        Refused{"twin_components",
                "`id` is `burr` in components 0 and 1, expected each id once among the components of a kind"},
        Refused{"tool_of_another_version", "component `burr`: `version` is 2, expected 1, that of a tool of this Kerf"},
        Refused{"leaves_out_the_unknown",
                "component `burring`: `force.does_not` is 16, expected a sum of KERF_DOES_NOT_…, 0 to 15"},
        Refused{"is_fed_backwards", "component `burr`: `tool.feed` is 9, expected 0 (axis), 1 (side) or 2 (turn)"},
        Refused{"uses_what_is_reserved", "component `burr`: `reserved` is 1, expected 0"},
        Refused{"asks_for_more", "its `open` returned -1, expected KERF_OK"},
        Refused{"null_parameter_id", "component `burr`: parameter 0: `id` is null"},
        Refused{"twin_parameters", "component `burr`: parameter: `id` is `size` in rows 0 and 1"},
        Refused{"default_out_of_range",
                "parameter `size`: `def` is 500 mm, outside its range, expected 1 mm … 5 mm. Set it within"},
        Refused{"infinite_range", "parameter `size`: `min … max` is 1 mm … inf mm"},
        Refused{"null_help", "parameter `size`: `help` is null"},
        Refused{"null_source", "parameter `size`: `source` is null"},
        Refused{"null_unit", "parameter `size`: `display_unit` is null, expected a text, which may be empty"},
        Refused{"unknown_unit", "parameter `size`: `display_unit` is `furlong`, expected a unit that Kerf knows"},
        Refused{"unit_of_another_dimension", "`display_unit` is `N`, which is not of the row's `dimension`"},
        Refused{"length_without_unit", "parameter `size`: `display_unit` is ``, expected a unit"},
        Refused{"help_not_utf8", "`help` is `caf\\xe9.`, expected UTF-8"},
        Refused{"help_with_escape", "`help` is `\\x1b[2Jgone`, expected printable characters"},
        Refused{"null_drives", "component `burr`: `drive count` is 2 with a null table"},
        Refused{"null_drive_id", "component `burr`: drive 0: `id` is null"},
        Refused{"null_drive_unit", "drive `speed`: `display_unit` is null"},
        Refused{"twin_drives", "component `burr`: drive: `id` is `speed` in rows 0 and 1"},
        Refused{"drive_default_out_of_range",
                "drive `speed`: `def` is 300000 rpm, outside its range, expected 0 rpm … 6000 rpm"},
        Refused{"null_signals", "component `burring`: `signal count` is 2 with a null table"},
        Refused{"null_signal_id", "component `burring`: signal 0: `id` is null"},
        Refused{"twin_signals", "component `burring`: signal: `id` is `load`"},
        Refused{"twin_events", "component `burring`: event: `id` is `hostile.happened`"},
        Refused{"foreign_event", "expected its plugin's name before it. Write `hostile.held_back`"},
        Refused{"names_a_strategy_twice", "component `burr`: strategy 1: `id` is `example.burring.groove` again"},
        Refused{"names_a_strategy_it_lacks",
                "strategy 0: `id` is `test.hostile.grove`, expected the id of a strategy of this plugin"},
        Refused{"null_shape", "component `burr`: `tool.shape` is null"},
        Refused{"null_resist", "component `burring`: `force.resist` is null"},
        Refused{"huge_state", "`state_size` is 4294967295 bytes, expected at most 67108864 bytes"},
        Refused{"odd_alignment", "`state_align` is 3, expected a power of two"}),
    [](const auto& tested) { return std::string(tested.param.how); });

TEST(Registry, UsesTheOthersWhenOneIsRefused) {
    const test::TemporaryFolder folder;
    for (const char* how : {"crashes", "null_drive_id", "nothing_wrong", "throws"})
        std::filesystem::copy(file_of(how), folder.path());
    PluginRegistry registry;
    registry.scan({folder.path()});
    ASSERT_EQ(registry.plugins().size(), 1u);
    EXPECT_STREQ(registry.plugins().front()->entry().plugin_id, "test.hostile");
    EXPECT_EQ(registry.refusals().size(), 3u);
    EXPECT_NE(registry.find("test.hostile", KERF_KIND_FORCE, "burring"), nullptr);
}

TEST(Registry, LeavesOutAComponentOfAKindThatItDoesNotKnow) {
    const test::TemporaryFolder folder;
    std::filesystem::copy(file_of("component_of_another_world"), folder.path());
    PluginRegistry registry;
    registry.scan({folder.path()});
    EXPECT_TRUE(registry.refusals().empty());
    ASSERT_EQ(registry.notes().size(), 1u);
    EXPECT_EQ(
        registry.notes()[0],
        "plugin test.hostile: its component `other_burr` is of kind 77, which this Kerf does not know. It is left "
        "out.");
    EXPECT_NE(registry.find("test.hostile", KERF_KIND_TOOL, "burr"), nullptr);
}

TEST(Registry, ClosesALibraryThatHasStrategiesAlone) {
    PluginRegistry registry;
    registry.scan({KERF_BUILD_DIR "/lib/kerf-remesh-zoo"});
    EXPECT_TRUE(registry.refusals().empty());
    EXPECT_TRUE(registry.plugins().empty());
    const auto& all = registry.catalog();
    const auto dies = std::find_if(all.begin(), all.end(), [](const ComponentInfo& c) { return c.id == "dies"; });
    ASSERT_NE(dies, all.end());
    EXPECT_EQ(dies->full_id(), "test.animals.dies");
    EXPECT_EQ(dies->module, KERF_BUILD_DIR "/lib/kerf-remesh-zoo/kerf_remesh_animals.so");
    EXPECT_EQ(dlopen(dies->module.c_str(), RTLD_NOW | RTLD_NOLOAD), nullptr) << "it stays in the loop's process";
}

TEST(ComponentInfo, IsMeantByTheLastWordsOfItsId) {
    ComponentInfo strategy;
    strategy.plugin = "example.chisel";
    strategy.id = "groove";
    for (const char* word : {"groove", "chisel.groove", "example.chisel.groove"})
        EXPECT_TRUE(strategy.matches_id(word)) << word;
    for (const char* word : {"oove", "isel.groove", "example.chisel", ""})
        EXPECT_FALSE(strategy.matches_id(word)) << word;
}

TEST(PluginHost, PrintsTheLinesOfAPluginUnderItsName) {
    testing::internal::CaptureStderr();
    EXPECT_TRUE(load_plugin(file_of("talks_when_opened")).plugin);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "plugin test.hostile: warning: \\x1b[2Jit is cold\n");
}

TEST(PluginHost, StopsPrintingAfterAHundredLines) {
    testing::internal::CaptureStderr();
    EXPECT_TRUE(load_plugin(file_of("never_stops_talking")).plugin);
    const std::string printed = testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::count(printed.begin(), printed.end(), '\n'), 101);
    EXPECT_NE(printed.find("has printed 100 lines, and prints no more"), std::string::npos);
}

TEST(Registry, FindsTheRefusalByIdOrByFileName) {
    const test::TemporaryFolder folder;
    std::filesystem::copy(file_of("null_drive_id"), folder / "any.so");
    std::filesystem::copy(file_of("crashes"), folder / "kerf_peck.so");
    PluginRegistry registry;
    registry.scan({folder.path()});
    ASSERT_NE(registry.refusal_for("test.hostile"), nullptr);
    EXPECT_NE(registry.refusal_for("test.hostile")->why.find("`id` is null"), std::string::npos);
    ASSERT_NE(registry.refusal_for("stranger.peck"), nullptr);
    EXPECT_EQ(registry.refusal_for("stranger.peck")->why.find("crashed"), 0u);
    EXPECT_EQ(registry.refusal_for("kerf.sawing"), nullptr);
}

}  // namespace
}  // namespace kerf
