// SPDX-License-Identifier: Apache-2.0
#include "app/plugin_folders.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace kerf {
namespace {

TEST(PluginFolders, AreThoseOfThePathAndThenItsOwn) {
    const test::TemporaryFolder a, b, own;
    const PluginFolders found = plugin_folders(a.path() + "::" + b.path() + ":", own.path());
    EXPECT_EQ(found.folders, (std::vector<std::string>{a.path(), b.path(), own.path()}));
    EXPECT_TRUE(found.complaints.empty());
}

TEST(PluginFolders, OneNamedTwiceIsSearchedOnce) {
    const test::TemporaryFolder a;
    const PluginFolders found = plugin_folders(a.path() + ":" + a.path() + "/.:" + a.path(), a.path());
    EXPECT_EQ(found.folders, std::vector<std::string>{a.path()});
}

TEST(PluginFolders, OneThatDoesNotExistIsSaidOnce) {
    const test::TemporaryFolder own;
    const PluginFolders found = plugin_folders("/nowhere:/nowhere", own.path());
    EXPECT_EQ(found.folders, std::vector<std::string>{own.path()});
    EXPECT_EQ(found.complaints, std::vector<std::string>{"KERF_PLUGIN_PATH names `/nowhere`, which does not exist: "
                                                         "no plugins come from there. Correct it or take it out."});
}

}  // namespace
}  // namespace kerf
