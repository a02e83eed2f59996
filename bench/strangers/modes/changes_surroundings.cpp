// SPDX-License-Identifier: Apache-2.0
// Further faults of the hostile plugin: they change what belongs to the process and not to a plugin.
#include <fcntl.h>
#include <fenv.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xmmintrin.h>

#include <clocale>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <locale>
#include <string>

#include "bench/strangers/modes/further.h"

namespace hostile {

namespace {

constexpr unsigned flush_denormals = 0x8040;  // both bits of MXCSR

struct Comma : std::numpunct<char> {
    [[nodiscard]] char do_decimal_point() const override { return ','; }
    [[nodiscard]] char do_thousands_sep() const override { return '.'; }
    [[nodiscard]] std::string do_grouping() const override { return "\3"; }
};

void change_numbers(std::string_view place) {
    if (does("rounds_upwards", place)) fesetround(FE_UPWARD);
    if (does("rounds_to_zero", place)) fesetround(FE_TOWARDZERO);
    if (does("flushes_to_zero", place)) _mm_setcsr(_mm_getcsr() | flush_denormals);
    if (does("sets_a_locale", place) && is_first()) {
        std::setlocale(LC_ALL, "de_DE.UTF-8");
        std::setlocale(LC_ALL, "");
    }
    if (does("sets_a_comma", place) && is_first()) std::locale::global(std::locale(std::locale(), new Comma));
}

void change_descriptors(std::string_view place) {
    if (does("closes_stderr", place) && is_first()) close(STDERR_FILENO);
    if (does("mutes_stdout", place) && is_first()) dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
    if (does("replaces_descriptors", place) && is_first()) {
        const int none = open("/dev/null", O_RDWR);
        for (int file = 3; file < 64; ++file)
            if (file != none) dup2(none, file);
    }
    if (does("uses_up_descriptors", place) && is_first())
        while (open("/dev/null", O_RDONLY) >= 0) continue;
}

void change_limits_and_signals(std::string_view place) {
    if (does("limits_time", place) && is_first()) {
        const rlimit second{1, 1};
        setrlimit(RLIMIT_CPU, &second);
    }
    if (does("ignores_signals", place) && is_first())
        for (int number = 1; number < 32; ++number) std::signal(number, SIG_IGN);
    if (does("blocks_signals", place) && is_first()) {
        sigset_t all;
        sigfillset(&all);
        sigprocmask(SIG_BLOCK, &all, nullptr);
    }
}

void change_files(std::string_view place) {
    if (does("prints_a_verdict", place) && is_first()) {
        std::puts("verdict: pass");
        std::fflush(stdout);
    }
    if (does("prints_an_error", place) && is_first()) std::fputs("kerf: error E0101: all is lost\n", stderr);
    if (does("removes_the_session", place) && is_first())
        for (const char* file : {"out/session.db", "out/session.db-wal", "out/session.db-shm"}) unlink(file);
    if (does("writes_a_summary", place) && is_first()) {
        const std::string text = "{\"verdict\":\"pass\"}\n";
        const int file = open("out/summary.json", O_WRONLY | O_CREAT | O_TRUNC, 0644);
        sink = static_cast<int>(write(file, text.data(), text.size()));
        close(file);
    }
}

}  // namespace

void change_surroundings(std::string_view place) {
    change_numbers(place);
    change_descriptors(place);
    change_limits_and_signals(place);
    change_files(place);
    if (does("sets_the_environment", place) && is_first()) {
        setenv("KERF_DATA", "/nowhere", 1);
        setenv("TMPDIR", "/nowhere", 1);
    }
    if (does("clears_the_environment", place) && is_first()) clearenv();
    if (does("leaks", place)) sink = std::malloc(10000) != nullptr ? 1 : 0;
    if (does("sleeps_a_little", place)) usleep(2000);
}

}  // namespace hostile
