// SPDX-License-Identifier: Apache-2.0
// Level 3: what a law does between pose and force.
#include <sys/syscall.h>

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <string>
#include <vector>

#include "conformance/law_walk.h"
#include "conformance/test_groups.h"
#include "core/plugin/plugin_call.h"

namespace kerf::conformance {

namespace {

void never_calls(Examination& exam, Forbidden kind, const char* why) {
    if (!can_watch()) return exam.skip("a sanitizer is built in, with a heap and locks of its own");
    WalkSettings settings;
    settings.is_watched = true;
    const auto look = [&](LawWalk& law) {
        const Offence& offence = law.offence(kind);
        if (offence.function != nullptr)
            exam.fail("`" + offence.call + "` calls `" + offence.function + "` " + offence.where + ". " + why);
        return !exam.has_failed();
    };
    walk(exam, settings, eventful_path(), look, look);
}
void throws_nothing(Examination& exam) {
    never_calls(exam, Forbidden::exception, "An exception allocates and locks, also where it is caught.");
}
void initialises_nothing(Examination& exam) {
    never_calls(exam, Forbidden::initialisation,
                "A function's static object is made at its first use, with a lock. Make it constexpr, or do it in "
                "`shape`.");
}
void starts_no_thread(Examination& exam) {
    never_calls(exam, Forbidden::thread, "A law runs on the host's thread alone.");
}
void prints_nothing(Examination& exam) {
    never_calls(exam, Forbidden::output, "Report figures as signals, and what happens as events.");
}
void reads_no_clock(Examination& exam) {
    never_calls(exam, Forbidden::clock, "A replay could not repeat it. The tick has a number and `dt`.");
}
void draws_no_random_number(Examination& exam) {
    never_calls(exam, Forbidden::random, "A replay could not repeat it.");
}
void takes_no_lock(Examination& exam) {
    never_calls(exam, Forbidden::lock, "Another thread may hold it for longer than a tick.");
}
void allocates_nothing(Examination& exam) {
    never_calls(exam, Forbidden::allocation, "The heap may take a lock, or the kernel. Use fixed arrays.");
}

void makes_no_system_call(Examination& exam) {
    if (!can_watch_system_calls()) return exam.skip("this kernel cannot report system calls to their process");
    std::vector<Pose> path = eventful_path();
    LawWalk law(*exam.subject);
    if (!law.refusal().empty()) return exam.skip(law.refusal());
    const auto watched = [&](const char* call, const auto& work) {
        start_watching_system_calls();
        work();
        const long number_of_call = stop_watching_system_calls();
        if (number_of_call >= 0)
            exam.fail(std::string("`") + call + "` makes the system call number " + std::to_string(number_of_call) +
                      " " + law.where() + ". The kernel may take longer than a tick.");
        return !exam.has_failed();
    };
    if (!watched("begin", [&] { law.begin(path.front()); })) return;
    law.run_up();
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        if (!watched("resist", [&] { static_cast<void>(law.resist()); })) return;
        if (!watched("commit", [&] { static_cast<void>(law.commit(path[i + 1])); })) return;
    }
}

void leaves_rounding(Examination& exam) {
    const auto look = [&](LawWalk& law) {
        if (take_changed_floating_point(*exam.subject->force))
            exam.fail("It changes the control word of the floating-point unit, for all of the host, " + law.where() +
                      ".");
        return !exam.has_failed();
    };
    walk(exam, {}, short_path(), look, look);
}

// ---- time ---------------------------------------------------------------------------------------------------------

double processor_seconds() noexcept {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void is_fast_enough(Examination& exam) {
    constexpr int blocks = 20, calls = 20;
    constexpr double max_over = 5.0;  // times the budget: beyond that, no machine is to blame
    const double budget = 1e-9 * exam.subject->force->force->budget_ns;
    LawWalk law(*exam.subject);
    if (!law.refusal().empty()) return exam.skip(law.refusal());
    const std::vector<Pose> path = short_path();
    law.begin(path.front());
    law.run_up();
    for (std::size_t i = 0; i < 400; ++i) {  // well into the bone
        static_cast<void>(law.resist());
        static_cast<void>(law.commit(path[i]));
    }
    double least = 1e9;
    for (int block = 0; block < blocks; ++block) {
        const double begun = processor_seconds();
        for (int i = 0; i < calls; ++i) static_cast<void>(law.resist());
        least = std::min(least, (processor_seconds() - begun) / calls);
        if (least > max_over * budget && block > 2) break;
    }
    const std::string text =
        "One `resist` takes " + number(1e6 * least) + " µs in bone, the budget is " + number(1e6 * budget) + " µs";
    if (least > max_over * budget)
        exam.fail(text + ". Query fewer points, or declare a budget that is true.");
    else if (least > budget)
        exam.warn(text + ". This machine may be slow; see `kerf check --only law.time` on another.");
    else
        exam.note(number(1e6 * least) + " µs of " + number(1e6 * budget) + " µs declared");
}

constexpr Test tests[] = {
    {"law.no_exception", 3, Scope::law, "It throws no exception, not even within.", &throws_nothing, "law.answers"},
    {"law.no_first_use", 3, Scope::law, "It initialises nothing at its first use.", &initialises_nothing,
     "law.answers"},
    {"law.no_thread", 3, Scope::law, "It starts no thread.", &starts_no_thread, "law.answers"},
    {"law.no_output", 3, Scope::law, "It prints nothing and opens no file.", &prints_nothing, "law.answers"},
    {"law.no_clock", 3, Scope::law, "It reads no clock.", &reads_no_clock, "law.answers"},
    {"law.no_random", 3, Scope::law, "It draws no random number.", &draws_no_random_number, "law.answers"},
    {"law.no_lock", 3, Scope::law, "It takes no lock.", &takes_no_lock, "law.answers"},
    {"law.no_allocation", 3, Scope::law, "It allocates and frees no memory.", &allocates_nothing, "law.answers"},
    {"law.no_system_call", 3, Scope::law, "It makes no system call.", &makes_no_system_call, "law.answers"},
    {"law.rounding", 3, Scope::law, "It leaves the floating-point unit as it was.", &leaves_rounding, "law.answers"},
    {"law.time", 3, Scope::law, "It keeps to its time.", &is_fast_enough, "law.answers"},
};

}  // namespace

std::span<const Test> real_time_tests() { return tests; }

}  // namespace kerf::conformance
