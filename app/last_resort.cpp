// SPDX-License-Identifier: Apache-2.0
#include "app/last_resort.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include "app/standard_streams.h"
#include "core/plugin/own_streams.h"
#include "core/plugin/process_notes.h"
#include "core/plugin/state_watch.h"
#include "text/system_reason.h"

namespace kerf::app {

namespace {

constexpr rlim_t min_stack = 512 * 1024;

void write_plain(const char* text) {
    for (std::size_t left = std::strlen(text); left > 0;) {
        const ssize_t count = write(own_error_file(), text, left);
        if (count <= 0) return;
        text += count;
        left -= static_cast<std::size_t>(count);
    }
}

// Written without the heap: there may be no memory left.
void write_out_of_memory() {
    if (const StateChange change = change_of_state(); change.has_happened()) {
        const ComponentName last = name_of(last_call().component);
        FixedText<6000> text;
        text << "kerf: out of memory: " << change.what.c_str() << " was changed from " << change.before.c_str()
             << " to " << change.after.c_str() << ". Kerf does not do this. The plugin that was called last is "
             << (last.is_known() ? last.plugin : "unknown") << " (" << (last.is_known() ? last.path : "of unknown path")
             << "). Mend it, or take it out of its folder.";
        text.end_line();
        write_plain("\n");
        return text.print(own_error_file());
    }
    write_plain("\nkerf: out of memory: a request for more was refused. Free some, raise the limit (`");
    write_plain(text::memory_limit_command());
    write_plain("`), or take a coarser `accuracy.spacing`.\n");
}

/// Prints the exception that is being handled. Returns false for one that is not of memory or of the system.
bool report_current_exception() {
    try {
        throw;
    } catch (const std::bad_alloc&) {
        write_out_of_memory();
    } catch (const std::length_error&) {
        write_out_of_memory();
    } catch (const std::system_error& error) {
        const bool is_thread = error.code() == std::errc::resource_unavailable_try_again;
        write_plain("\nkerf: the system refused ");
        write_plain(is_thread ? "a thread" : "a request");
        write_plain(": ");
        write_plain(error.what());
        write_plain(is_thread ? ". " : "");
        write_plain(is_thread ? text::thread_advice() : "");
        write_plain(".\n");
    } catch (...) {
        return false;
    }
    return true;
}

[[noreturn]] void end() {
    if (std::current_exception() != nullptr && report_current_exception()) {
        say_last_word(exit_fault);
        _exit(exit_fault);
    }
    std::abort();
}

}  // namespace

ExitCode run_guarded(const std::function<ExitCode()>& work) {
    try {
        return work();
    } catch (const std::exception& error) {
        if (!report_current_exception())
            print_error(std::string("\nkerf: this should not have happened: ") + error.what() + ".\n");
        return exit_fault;
    }
}

void install_terminate_handler() { std::set_terminate(&end); }

bool is_stack_large_enough() {
    rlimit limit{};
    if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= min_stack)
        return true;
    // A process may raise its own limit up to the hard limit.
    limit.rlim_cur =
        limit.rlim_max == RLIM_INFINITY || limit.rlim_max > 8 * 1024 * 1024 ? 8 * 1024 * 1024 : limit.rlim_max;
    if (limit.rlim_cur >= min_stack && setrlimit(RLIMIT_STACK, &limit) == 0) return true;
    std::fprintf(stderr, "kerf: the stack is limited to %lu kB, expected at least %lu kB. Write `ulimit -s 8192`.\n",
                 static_cast<unsigned long>(limit.rlim_cur / 1024), static_cast<unsigned long>(min_stack / 1024));
    return false;
}

}  // namespace kerf::app
