// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/loader.h"

#include <gtest/gtest.h>

#include <fstream>

namespace kerf {
namespace {

const std::string drilling = KERF_BUILD_DIR "/lib/kerf/kerf_drilling.so";

TEST(Loader, LoadsThePluginOfTheTree) {
    const PluginLoad load = load_plugin(drilling);
    ASSERT_TRUE(load.plugin) << load.refusal;
    EXPECT_STREQ(load.plugin->entry().plugin_id, "kerf.drilling");
}

TEST(Loader, SaysWhichFieldDiffersAndWhatToDo) {
    const PluginLoad load = load_plugin(drilling);
    ASSERT_TRUE(load.plugin);
    const kerf_entry good = load.plugin->entry();
    EXPECT_EQ(refusal_of(good, "libsaw.so"), "");

    kerf_entry bad = good;
    bad.abi = 7;
    EXPECT_EQ(refusal_of(bad, "libsaw.so"), "plugin libsaw.so (libsaw.so): ABI is 7, need 0: rebuild it against this Kerf.");
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

TEST(Loader, RefusesWhatIsNoPlugin) {
    EXPECT_NE(load_plugin("/nowhere/libsaw.so").refusal, "");
    EXPECT_EQ(load_plugin("/nowhere/libsaw.so").plugin, nullptr);

    const std::string text = testing::TempDir() + "notes.so";
    std::ofstream(text) << "not a library";
    EXPECT_NE(load_plugin(text).refusal.find("cannot be loaded"), std::string::npos);
}

TEST(Registry, DescribesEveryParameterWithItsSource) {
    PluginRegistry registry;
    registry.scan({KERF_BUILD_DIR "/lib/kerf", "/nowhere"});
    EXPECT_TRUE(registry.refusals().empty());
    ASSERT_FALSE(registry.catalog().empty());
    for (const auto& component : registry.catalog())
        for (const auto& parameter : component.parameters) {
            EXPECT_FALSE(parameter.help.empty()) << parameter.id;
            EXPECT_FALSE(parameter.source.empty()) << parameter.id;
        }
    EXPECT_NE(registry.find("kerf.drilling", KERF_KIND_TOOL, "twist_drill"), nullptr);
    EXPECT_EQ(registry.find("kerf.drilling", KERF_KIND_FORCE, "twist_drill"), nullptr);
}

TEST(Registry, TheSamePluginTwiceIsReportedWithBothPaths) {
    PluginRegistry registry;
    registry.scan({KERF_BUILD_DIR "/lib/kerf", KERF_BUILD_DIR "/lib/kerf"});
    ASSERT_EQ(registry.refusals().size(), registry.plugins().size());
    EXPECT_NE(registry.refusals()[0].find("found twice"), std::string::npos);
}

}  // namespace
}  // namespace kerf
