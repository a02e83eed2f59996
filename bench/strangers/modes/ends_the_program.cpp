// SPDX-License-Identifier: Apache-2.0
// Further faults of the hostile plugin that end a program or a thread of it, or run next to it.
#include <pthread.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <thread>

#include "bench/strangers/modes/further.h"

namespace hostile {

void crash() { *reinterpret_cast<volatile int*>(static_cast<std::uintptr_t>(sink + 16)) = 1; }

namespace {

void crash_in_odd_ways(std::string_view place) {
    if (does("divides_by_zero", place)) sink = 7 / sink;
    if (does("frees_a_wild_pointer", place)) {
        void* volatile wild = reinterpret_cast<void*>(std::uintptr_t{0x10});
        std::free(wild);
    }
    if (does("jumps_to_null", place)) {
        void (*volatile nowhere)() = nullptr;
        nowhere();
    }
    if (does("executes_nonsense", place)) __builtin_trap();
    if (does("terminates", place)) std::terminate();
    if (does("has_its_own_terminate", place)) {
        std::set_terminate([] { _exit(0); });
        std::terminate();
    }
    if (does("handles_its_own_crash", place)) {
        std::signal(SIGSEGV, [](int) { _exit(0); });
        crash();
    }
    if (does("returns_from_its_own_crash", place)) {
        std::signal(SIGSEGV, [](int) {});
        crash();
    }
    if (does("ignores_signals_and_crashes", place)) {
        for (int number = 1; number < 32; ++number) std::signal(number, SIG_IGN);
        crash();
    }
    if (does("takes_handlers_away_and_crashes", place)) {
        for (const int number : {SIGSEGV, SIGABRT, SIGBUS}) std::signal(number, SIG_DFL);
        crash();
    }
    if (does("takes_the_signal_stack_and_falls", place)) {
        stack_t off{};
        off.ss_flags = SS_DISABLE;
        sigaltstack(&off, nullptr);
        sink = fall(0);
    }
    if (does("closes_stderr_and_crashes", place)) {
        close(STDERR_FILENO);
        crash();
    }
}

void send_signals(std::string_view place) {
    if (does("terminates_itself", place)) raise(SIGTERM);
    if (does("kills_its_parent", place) && is_first()) kill(getppid(), SIGKILL);
    if (does("stops_its_parent", place) && is_first()) kill(getppid(), SIGSTOP);
    if (does("sets_a_timer_that_kills", place) && is_first()) alarm(1);
}

void start_threads(std::string_view place) {
    if (does("ends_its_thread", place)) pthread_exit(nullptr);
    if (does("throws_on_a_thread", place)) std::thread([] { throw 7; }).join();
    if (does("exits_on_a_thread", place)) std::thread([] { std::exit(0); }).join();
    if (does("aborts_on_a_thread", place)) std::thread([] { std::abort(); }).join();
    if (does("leaves_a_busy_thread", place) && is_first())
        std::thread([] {
            for (;;) sink = sink + 1;
        }).detach();
    if (does("leaves_a_late_crash", place) && is_first())
        std::thread([] {
            usleep(300000);
            crash();
        }).detach();
    if (does("leaves_a_late_exit", place) && is_first())
        std::thread([] {
            usleep(300000);
            _exit(0);
        }).detach();
    if (does("destroys_a_running_thread", place)) std::thread thread([] { sleep(1000); });
}

void start_processes(std::string_view place) {
    if (does("forks_a_child_that_stays", place) && is_first() && fork() == 0) {
        sleep(20);
        _exit(0);
    }
    if (does("forks_a_child_that_exits", place) && is_first() && syscall(SYS_fork) == 0) std::exit(0);
    if (does("runs_a_shell", place) && is_first()) sink = std::system("true");
    if (does("crashes_at_exit", place) && is_first()) std::atexit(crash);
    if (does("throws_at_exit", place) && is_first()) std::atexit([] { throw 7; });
}

}  // namespace

void misbehave_further(std::string_view place) {
    crash_in_odd_ways(place);
    send_signals(place);
    start_threads(place);
    start_processes(place);
    change_surroundings(place);
}

}  // namespace hostile
