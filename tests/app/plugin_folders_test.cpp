// SPDX-License-Identifier: Apache-2.0
#include "app/plugin_folders.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

namespace fs = std::filesystem;

TEST(PluginFolders, ListThePathThenTheOwnFolder) {
    const test::TemporaryFolder a, b, own;
    const PluginFolders found = plugin_folders(a.path() + "::" + b.path() + ":", own.path());
    EXPECT_EQ(found.folders, (std::vector<std::string>{a.path(), b.path(), own.path()}));
    EXPECT_TRUE(found.complaints.empty());
}

TEST(PluginFolders, ListEachFolderOnce) {
    const test::TemporaryFolder a;
    const PluginFolders found = plugin_folders(a.path() + ":" + a.path() + "/.:" + a.path(), a.path());
    EXPECT_EQ(found.folders, std::vector<std::string>{a.path()});
}

TEST(PluginFolders, ReportAMissingFolderOnce) {
    const test::TemporaryFolder own;
    const PluginFolders found = plugin_folders("/nowhere:/nowhere", own.path());
    EXPECT_EQ(found.folders, std::vector<std::string>{own.path()});
    EXPECT_EQ(found.complaints, std::vector<std::string>{"KERF_PLUGIN_PATH names `/nowhere`, which does not exist: "
                                                         "no plugins come from there. Correct it or take it out."});
}

TEST(PluginFolders, ReportAnUnreadableFolder) {
    const test::TemporaryFolder folder;
    fs::create_directory(folder / "locked");
    fs::permissions(folder / "locked", fs::perms(0));
    fs::permissions(folder.path(), fs::perms(0755));
    const pid_t child = fork();
    if (child == 0) {  // as somebody who may not read it, whoever runs the tests
        constexpr uid_t nobody = 65534;
        if (geteuid() == 0 && (setgid(nobody) != 0 || setuid(nobody) != 0)) _exit(3);
        const PluginFolders found = plugin_folders(folder / "locked", "/own");
        const bool is_said = found.complaints.size() == 1 &&
                             found.complaints[0].find("which may not be read: no plugins") != std::string::npos;
        _exit(is_said && found.folders == std::vector<std::string>{"/own"} ? 0 : 1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    fs::permissions(folder / "locked", fs::perms(0755));
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace kerf::app
