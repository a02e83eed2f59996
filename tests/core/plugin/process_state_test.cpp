// SPDX-License-Identifier: Apache-2.0
// What a host compares of its process.
#include "core/plugin/process_state.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <functional>
#include <string>

#include "core/plugin/own_files.h"
#include "core/plugin/state_watch.h"
#include "tests/support/temporary_folder.h"

namespace kerf {
namespace {

SharedState sound() {
    SharedState state = shared_state();
    state.limits.fill({1000, 2000});
    state.timers = {};
    state.handlers = {};
    state.folder = {"/home"};
    state.decimal_point = {"."};
    state.mask = 022;
    state.streams.fill({1, 2});
    return state;
}

TEST(ProcessState, NamesEachChangeWithItsValues) {
    struct Row {
        std::function<void(SharedState&)> change;
        const char* text;
    };
    for (const Row& row : {
             Row{[](SharedState& s) { s.streams[1] = {}; }, "the descriptor of stdout from open to closed"},
             Row{[](SharedState& s) {
                     s.streams[2] = {3, 4};
                 },
                 "the descriptor of stderr from open to another file"},
             Row{[](SharedState& s) { s.limits[RLIMIT_AS].rlim_cur = 999; }, "the limit RLIMIT_AS from 1000 to 999"},
             Row{[](SharedState& s) { s.limits[RLIMIT_CPU].rlim_cur = 1; }, "the limit RLIMIT_CPU from 1000 to 1"},
             Row{[](SharedState& s) { s.timers[ITIMER_PROF].it_value.tv_usec = 1; },
                 "a timer of SIGPROF from off to on"},
             Row{[](SharedState& s) { s.handlers[SIGCHLD] = 1; },
                 "the handler of SIGCHLD from the default to none: ignored"},
             Row{[](SharedState& s) { s.folder = {"/"}; }, "the working folder from /home to /"},
             Row{[](SharedState& s) { s.decimal_point = {","}; }, "the decimal point of the locale from `.` to `,`"},
             Row{[](SharedState& s) { s.mask = 0777; }, "the mask of new files (umask) from 022 to 777"},
         }) {
        SharedState after = sound();
        row.change(after);
        const StateChange change = change_between(sound(), after);
        EXPECT_TRUE(change.has_happened());
        EXPECT_EQ(change.text(), row.text);
    }
}

TEST(ProcessState, IgnoresHarmlessChanges) {
    EXPECT_FALSE(change_between(shared_state(), shared_state()).has_happened());
    SharedState after = sound();
    after.limits[RLIMIT_NOFILE].rlim_cur = 2000;  // raised
    after.limits[RLIMIT_RTPRIO].rlim_cur = 0;
    after.handlers[SIGUSR1] = 77;
    after.mask = -1;  // it could not be read
    EXPECT_FALSE(change_between(sound(), after).has_happened()) << change_between(sound(), after).text();
}

TEST(StateWatch, FindsATimerThatIsOffAgain) {
    begin_watching_state([](const StateChange&) {});
    EXPECT_FALSE(change_of_state().has_happened());
    note_timer_signal(SIGALRM);
    EXPECT_TRUE(has_timer_signal());
    EXPECT_EQ(change_of_state().text(), "a timer of SIGALRM from off to on");
    begin_watching_state([](const StateChange&) {});
    EXPECT_FALSE(change_of_state().has_happened()) << "the state at the beginning is the right one";
    end_watching_state();
}

TEST(OwnFiles, NamesTheDescriptorThatWasClosedOrReplaced) {
    const test::TemporaryFolder folder;
    const std::string path = folder / "record";
    const auto open_record = [&] { return open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600); };
    const int own = open_record(), other = open("/dev/null", O_RDONLY | O_CLOEXEC);
    OwnFiles files;
    files.watch({path, folder / "none"});
    EXPECT_FALSE(change_of_own_files().has_happened());
    const int of_a_library = open_record();
    close(of_a_library);
    EXPECT_FALSE(change_of_own_files().has_happened()) << "only those that were open are watched";

    dup2(other, own);
    EXPECT_EQ(change_of_own_files().text(), "the descriptor of record from open to another file");
    close(own);
    EXPECT_EQ(change_of_own_files().text(), "the descriptor of record from open to closed");
    files.release();
    EXPECT_FALSE(change_of_own_files().has_happened());
    close(other);
}

}  // namespace
}  // namespace kerf
