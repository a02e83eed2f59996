// SPDX-License-Identifier: Apache-2.0
// A parent reads what a child noted before it ended.
#include "core/plugin/process_notes.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace kerf {
namespace {

/// A plugin's table with some components.
struct Table {
    explicit Table(const std::vector<const char*>& ids) : components(ids.size()) {
        for (std::size_t i = 0; i < ids.size(); ++i) components[i].id = ids[i];
        entry.plugin_id = "test.noted";
        entry.components = components.data();
        entry.component_count = static_cast<std::uint32_t>(ids.size());
    }
    std::vector<kerf_component> components;
    kerf_entry entry{};
};

/// Runs `work` in a child whose notes this process can read.
void in_a_child(const std::function<void()>& work) {
    ASSERT_TRUE(begin_common_notes());
    const pid_t child = fork();
    if (child == 0) {
        allow_last_word(getpid());
        work();
        _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
}

TEST(ProcessNotes, NameTheCallInWhichAChildEnded) {
    in_a_child([] {
        const Table first({"burr"}), second({"saw", "sawing"});
        register_components(first.entry, "/somewhere/first.so");
        register_components(second.entry, "/somewhere/second.so");
        const CallNote note(PluginCall::resist, second.components[1]);
        _exit(0);
    });
    const CallInProgress call = call_in_progress();
    EXPECT_EQ(call.call, PluginCall::resist);
    const ComponentName name = name_of(call.component);
    EXPECT_STREQ(name.plugin, "test.noted");
    EXPECT_STREQ(name.file, "second.so");
    EXPECT_STREQ(name.path, "/somewhere/second.so");
    EXPECT_STREQ(name.component, "sawing");
    EXPECT_FALSE(last_word());
}

TEST(ProcessNotes, NameTheLastCallOfTheBusiestThread) {
    in_a_child([] {
        const Table table({"saw", "sawing"});
        register_components(table.entry, "/somewhere/saw.so");
        { const CallNote note(PluginCall::shape, table.components[0]); }
        { const CallNote note(PluginCall::commit, table.components[1]); }
    });
    EXPECT_EQ(call_in_progress().call, PluginCall::none);
    EXPECT_EQ(last_call().call, PluginCall::commit);
    EXPECT_EQ(last_call().count, 2u);
    EXPECT_STREQ(name_of(last_call().component).component, "sawing");
}

TEST(ProcessNotes, OfOneChildAreNotThoseOfTheNext) {
    in_a_child([] {
        const Table table({"saw"});
        register_components(table.entry, "/somewhere/saw.so");
        const CallNote note(PluginCall::shape, table.components[0]);
        note_record("out/session.db");
        say_last_word(1);
        _exit(0);
    });
    EXPECT_EQ(last_word(), 1);
    EXPECT_STREQ(noted_record(), "out/session.db");
    in_a_child([] {});
    EXPECT_EQ(last_call().call, PluginCall::none);
    EXPECT_FALSE(last_word());
    EXPECT_STREQ(noted_record(), "");
}

TEST(ProcessNotes, TakeNoWordFromACopyOfTheChild) {
    in_a_child([] {
        const pid_t copy = fork();
        if (copy == 0) {
            say_last_word(0);
            _exit(0);
        }
        waitpid(copy, nullptr, 0);
    });
    EXPECT_FALSE(last_word());
}

TEST(ProcessNotes, KeepTheNameOfAPluginThatIsLoadedAgainAndAgain) {
    ASSERT_TRUE(begin_common_notes());
    for (int time = 0; time < 20'000; ++time) {  // more rows and texts than fit
        const Table table({"saw", "sawing"});
        register_components(table.entry, "/somewhere/saw.so");
        ASSERT_STREQ(name_of(&table.components[1]).component, "sawing") << time;
        unregister_components(&table.entry);
        ASSERT_FALSE(name_of(&table.components[1]).is_known()) << time;
    }
}

TEST(ProcessNotes, LeaveOutTheNamesThatDoNotFit) {
    ASSERT_TRUE(begin_common_notes());
    std::vector<Table> tables;
    for (int plugin = 0; plugin < 1200; ++plugin) tables.emplace_back(std::vector<const char*>{"saw"});
    for (std::size_t i = 0; i < tables.size(); ++i)
        register_components(tables[i].entry, "/somewhere/" + std::string(2000, 'x') + std::to_string(i));
    EXPECT_TRUE(name_of(&tables[0].components[0]).is_known());
    EXPECT_FALSE(name_of(&tables[1199].components[0]).is_known());
    for (const Table& table : tables) unregister_components(&table.entry);
}

}  // namespace
}  // namespace kerf
