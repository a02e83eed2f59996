// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/loader.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <utility>

#include "tests/support/temporary_folder.h"

namespace kerf {
namespace {

const std::string sound = KERF_BUILD_DIR "/tests/bad_plugins/plugin_that_nothing_wrong.so";  // and has everything

/// A folder with the sound plugin alone.
struct SoundFolder : test::TemporaryFolder {
    SoundFolder() { std::filesystem::copy(sound, *this / "sound.so"); }
};

TEST(Loader, LoadsASoundPlugin) {
    const PluginLoad load = load_plugin(sound);
    ASSERT_TRUE(load.plugin) << load.refusal;
    EXPECT_STREQ(load.plugin->entry().plugin_id, "test.hostile");
}

TEST(Loader, SaysWhichFieldDiffersAndWhatToDo) {
    const PluginLoad load = load_plugin(sound);
    ASSERT_TRUE(load.plugin);
    const kerf_entry good = load.plugin->entry();
    EXPECT_EQ(refusal_of(good, "libsaw.so"), "");

    kerf_entry bad = good;
    bad.abi = 7;
    EXPECT_EQ(refusal_of(bad, "libsaw.so"),
              "plugin libsaw.so (libsaw.so): ABI is 7, need 0: rebuild it against this Kerf.");
    bad = good;
    bad.magic = 0;
    EXPECT_NE(refusal_of(bad, "libsaw.so").find("magic"), std::string::npos);
    bad = good;
    bad.layout.force -= 8;
    EXPECT_NE(refusal_of(bad, "libsaw.so").find("size of kerf_force is"), std::string::npos);
    bad = good;
    bad.component_count = 0;
    EXPECT_NE(refusal_of(bad, "libsaw.so").find("components"), std::string::npos);
}

/// The first component of its kind of the sound plugin alone, to be changed.
template <std::uint32_t kind>
struct One {
    PluginLoad load = load_plugin(sound);
    kerf_entry entry = load.plugin->entry();
    kerf_component component = *std::find_if(entry.components, entry.components + entry.component_count,
                                             [](const auto& c) { return c.kind == kind; });

    One() {
        entry.components = &component;
        entry.component_count = 1;
    }
    One(const One&) = delete;
    One& operator=(const One&) = delete;
};
using OneTool = One<KERF_KIND_TOOL>;
using OneLaw = One<KERF_KIND_FORCE>;

TEST(Loader, RefusesAFeatureThatSetsWhatItMustNot) {
    OneTool one;
    auto& [load, entry, component] = one;
    kerf_feature feature = component.features[0];
    component.features = &feature;
    component.feature_count = 1;
    EXPECT_EQ(refusal_of(entry, "libsaw.so"), "");

    feature.off = component.params[feature.param].max + 1.0;
    EXPECT_NE(refusal_of(entry, "libsaw.so").find("outside the range of"), std::string::npos);
    feature = load.plugin->entry().components[0].features[0];
    feature.param = component.param_count;
    EXPECT_NE(refusal_of(entry, "libsaw.so").find("`param` is"), std::string::npos);
    feature = load.plugin->entry().components[0].features[0];
    feature.kind = 9;
    EXPECT_NE(refusal_of(entry, "libsaw.so").find("`kind` is 9, expected 1 (effect) or 2 (resolution)"),
              std::string::npos);
    component.features = nullptr;
    EXPECT_NE(refusal_of(entry, "libsaw.so").find("`feature_count` is 1 with a null table"), std::string::npos);
}

TEST(Loader, RefusesADriveAtWhichTheToolNeverTakesBone) {
    OneTool one;
    kerf_tool tool = *one.component.tool;
    one.component.tool = &tool;
    kerf_drive drive = tool.drives[0];
    tool.drives = &drive;
    tool.drive_count = 1;
    EXPECT_GT(drive.least, 0.0);
    EXPECT_EQ(refusal_of(one.entry, "libsaw.so"), "");

    for (const double least : {drive.max + 1.0, -1.0, std::nan("")}) {
        drive.least = least;
        EXPECT_NE(refusal_of(one.entry, "libsaw.so").find("drive `speed`"), std::string::npos) << least;
    }
}

TEST(Loader, RefusesAnEventOfAnothersNameOrOfNone) {
    OneLaw one;
    kerf_force law = *one.component.force;
    law.tools = nullptr;  // they are not in this entry
    law.tool_count = 0;
    one.component.force = &law;
    kerf_event event{};
    law.events = &event;
    law.event_count = 1;
    for (const char* own : {"hostile.stalled", "test.hostile.stalled"}) {
        event = {own, "It stands.", KERF_EVENT_NOTE, 0};
        EXPECT_EQ(refusal_of(one.entry, "libsaw.so"), "") << own;
    }
    for (const char* foreign : {"haptics.held_back", "stalled", "hostile.", "hostile", "hostiles.stalled"}) {
        event = {foreign, "It stands.", KERF_EVENT_NOTE, 0};
        EXPECT_NE(refusal_of(one.entry, "libsaw.so").find("its plugin's name before it. Write `hostile."),
                  std::string::npos)
            << foreign;
    }
    event = {"hostile.stalled", "It stands.", 2, 0};
    EXPECT_NE(refusal_of(one.entry, "libsaw.so").find("`effect` is 2, expected 0 (note) or 1 (damage)"),
              std::string::npos)
        << refusal_of(one.entry, "libsaw.so");
    event = {"hostile.stalled", nullptr, KERF_EVENT_NOTE, 0};
    EXPECT_NE(refusal_of(one.entry, "libsaw.so").find("event `hostile.stalled`: `help` is null"), std::string::npos);
    law.events = nullptr;
    EXPECT_NE(refusal_of(one.entry, "libsaw.so").find("event count` is 1 with a null table"), std::string::npos);
}

std::string bad(const std::string& how) { return KERF_BUILD_DIR "/tests/bad_plugins/plugin_that_" + how + ".so"; }

TEST(Loader, RefusesWhatIsNoPluginAndNamesItOnce) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "notes.so") << "not a library";
    std::ofstream(folder / "empty.so");
    std::ofstream(folder / "cut.so") << "\x7f"
                                        "ELF and no more";
    std::filesystem::create_directory(folder / "folder.so");
    ASSERT_EQ(mkfifo((folder / "pipe.so").c_str(), 0600), 0);
    std::filesystem::create_symlink("loop.so", folder / "loop.so");
    std::filesystem::create_symlink("nowhere.so", folder / "dangling.so");

    for (const auto& [path, says] :
         {std::pair<std::string, std::string>{folder / "missing.so", "there is no such file"},
          {folder / "notes.so", "is not a shared library, so it is no Kerf plugin"},
          {folder / "empty.so", "is not a shared library, so it is no Kerf plugin"},
          {folder / "cut.so", "is cut short: it has 16 bytes, and its headers need 64"},
          {folder / "folder.so", "so it is no Kerf plugin"},
          {folder / "pipe.so", "so it is no Kerf plugin"},
          {folder / "loop.so", "is a symbolic link that leads back to itself"},
          {folder / "dangling.so", "is a symbolic link to `nowhere.so`, which does not exist"},
          {bad("says_nothing"), "exports no `kerf_plugin_entry`. In a plugin, declare it visible"}}) {
        const PluginLoad load = load_plugin(path);
        EXPECT_EQ(load.plugin, nullptr);
        EXPECT_NE(load.refusal.find(says), std::string::npos) << load.refusal;
        EXPECT_NE(load.refusal.find(path), std::string::npos) << load.refusal;
        EXPECT_EQ(load.refusal.find(path), load.refusal.rfind(path)) << load.refusal;
    }
}

// With another thread there is no trial in a child, so the note names who ends the process.
void load_beside_a_thread(const std::string& path) {
    std::atomic<bool> is_done{false};
    std::thread other([&] {
        while (!is_done) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    });
    static_cast<void>(load_plugin(path));
    is_done = true;
    other.join();
}

TEST(LoaderDeath, APluginThatEndsTheProcessIsNamedFirst) {
    const auto ends_with_three = testing::ExitedWithCode(3);
    EXPECT_EXIT(load_beside_a_thread(bad("aborts")), ends_with_three,
                "while loading the plugin .*plugin_that_aborts.so: it aborted");
    EXPECT_EXIT(load_beside_a_thread(bad("crashes")), ends_with_three,
                "while loading the plugin .*plugin_that_crashes.so: it crashed");
    EXPECT_EXIT(load_beside_a_thread(bad("exits")), ends_with_three,
                "while loading the plugin .*plugin_that_exits.so: it ended the program");
    EXPECT_EXIT(load_beside_a_thread(bad("throws")), ends_with_three,
                "while loading the plugin .*plugin_that_throws.so: it aborted");
}

TEST(LoaderDeath, OnceItIsLoadedNobodyIsAccused) {
    EXPECT_EXIT((static_cast<void>(load_plugin(sound)), std::abort()), testing::KilledBySignal(SIGABRT), "^$");
    EXPECT_EXIT((static_cast<void>(load_plugin(sound)), std::exit(7)), testing::ExitedWithCode(7), "^$");
}

TEST(Registry, DescribesEveryParameterWithItsSource) {
    PluginRegistry registry;
    const SoundFolder folder;
    registry.scan({folder.path(), "/nowhere"});
    EXPECT_TRUE(registry.refusals().empty());
    ASSERT_FALSE(registry.catalog().empty());
    for (const auto& component : registry.catalog())
        for (const auto& parameter : component.parameters) {
            EXPECT_FALSE(parameter.help.empty()) << parameter.id;
            EXPECT_FALSE(parameter.source.empty()) << parameter.id;
        }
    EXPECT_NE(registry.find("test.hostile", KERF_KIND_TOOL, "burr"), nullptr);
    EXPECT_EQ(registry.find("test.hostile", KERF_KIND_FORCE, "burr"), nullptr);
}

TEST(Registry, TheSamePluginTwiceIsReportedWithBothPaths) {
    PluginRegistry registry;
    const SoundFolder folder;
    registry.scan({folder.path(), folder.path()});
    ASSERT_EQ(registry.refusals().size(), registry.plugins().size());
    EXPECT_NE(registry.refusals()[0].find("found twice"), std::string::npos);
}

}  // namespace
}  // namespace kerf
