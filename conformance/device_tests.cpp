// SPDX-License-Identifier: Apache-2.0
// Level 3: drivers of devices. No test needs a device: without one, those that read it are skipped.
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <limits>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "conformance/device_reports.h"
#include "conformance/device_trial.h"
#include "conformance/subject.h"
#include "conformance/test_groups.h"
#include "conformance/words.h"
#include "core/haptics/watch/watch.h"
#include "core/plugin/guarded_memory.h"
#include "core/plugin/plain_text.h"
#include "core/plugin/plugin_call.h"
#include "core/plugin/process_state.h"

namespace kerf::conformance {

namespace {

/// Time by the clock and of the processor [s].
struct Seconds {
    double wall, processor;

    static Seconds now() noexcept {
        const auto read = [](clockid_t clock) {
            timespec t{};
            clock_gettime(clock, &t);
            return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
        };
        return {read(CLOCK_MONOTONIC), read(CLOCK_PROCESS_CPUTIME_ID)};
    }
    [[nodiscard]] Seconds since(const Seconds& start) const noexcept {
        return {wall - start.wall, processor - start.processor};
    }
};

// ---- finding ------------------------------------------------------------------------------------------------------

constexpr std::uint32_t capacities[] = {0, 1, 8};

/// Calls `find` with memory for `capacity` devices that ends where a page ends.
std::vector<kerf_device_found> found_by(Examination& exam, std::uint32_t capacity) {
    const kerf_component& driver = *exam.subject->device;
    const std::vector<double> params = defaults_of(driver);
    GuardedMemory memory;
    auto* const found = static_cast<kerf_device_found*>(memory.allocate(
        capacity * sizeof(kerf_device_found), alignof(kerf_device_found), "it wrote more devices than `capacity`"));
    std::memset(found, 0xa5, capacity * sizeof *found);
    const std::uint32_t count = call_find(driver, params.data(), found, capacity);
    if (count > capacity) {
        exam.fail("`find` returns " + std::to_string(count) + " with a `capacity` of " + std::to_string(capacity) +
                  ". Return the number of devices that it wrote.");
        return {};
    }
    return {found, found + count};
}

std::string fault_of_found(const kerf_device_found& found) {
    if (std::string fault = fault_of_text(found.id); !fault.empty()) return "`id` " + fault;
    if (std::string fault = fault_of_id(found.id); !fault.empty()) return "`id` " + fault;
    if (std::string fault = fault_of_text(found.name); !fault.empty()) return "`name` " + fault;
    if (std::string fault = fault_of_text(found.problem); !fault.empty()) return "`problem` " + fault;
    return {};
}

std::vector<std::string> ids_of(const std::vector<kerf_device_found>& found) {
    std::vector<std::string> ids;
    for (const kerf_device_found& device : found) ids.emplace_back(device.id);
    return ids;
}

void finds_within_bounds(Examination& exam) {
    std::vector<std::string> ids;
    for (const std::uint32_t capacity : capacities) {
        const std::vector<kerf_device_found> found = found_by(exam, capacity);
        if (exam.has_failed()) return;
        for (std::size_t i = 0; i < found.size(); ++i)
            if (const std::string fault = fault_of_found(found[i]); !fault.empty())
                return exam.fail("Of device " + std::to_string(i) + " that `find` writes, the " + fault);
        ids = ids_of(found);
    }
    std::set<std::string> seen;
    for (const std::string& id : ids)
        if (!seen.insert(id).second)
            return exam.fail("`find` gives two devices the id " + quoted_plain(id) +
                             ". Add a serial number or a port, so that a station can name one of them.");
    const std::vector<kerf_device_found> again = found_by(exam, capacities[2]);
    if (exam.has_failed()) return;
    if (ids_of(again) != ids)
        exam.warn("`find` gives other devices when it is called again. Unless one was plugged in or out meanwhile, "
                  "sort them, and keep their ids from run to run.");
    exam.note(std::to_string(ids.size()) + (ids.size() == 1 ? " device" : " devices"));
}

// ---- opening ------------------------------------------------------------------------------------------------------

/// Closes what an `open` has opened.
void close_opened(const kerf_component& driver, const Opening& opening) {
    if (opening.out.device != nullptr) call_close(driver, opening.out.device);
}

/// Fails the test unless `open` gave either a device, or no device and a reason. The host escapes the reason, so it may
/// quote any setting.
void expect_device_or_reason(Examination& exam, const Opening& opening, const std::string& when) {
    const bool has_device = opening.out.device != nullptr;
    if (has_device != (opening.status == KERF_OK))
        return exam.fail(when + ", `open` " + name_of_status(opening.status) + " with " + (has_device ? "a" : "no") +
                         " `device`. Return KERF_OK with a device, KERF_FAILED without.");
    if (has_device) return;
    const auto& message = opening.out.message;
    if (std::memchr(message, 0, sizeof message) == nullptr)
        exam.fail(when + ", its `message` does not end with NUL. Cut it to the size of its array.");
    else if (message[0] == '\0')
        exam.fail(when + ", `open` opens nothing and writes no `message`. Write why, and what the user can do.");
}

void refuses_unknown_id(Examination& exam) {
    const kerf_component& driver = *exam.subject->device;
    const char* const id = "no-device-has-this-id";
    const Opening opening = open_device(driver, {.id = id});
    if (opening.out.device != nullptr)
        exam.fail(std::string("`open` opens a device for the id `") + id +
                  "`, which none has. Compare the id with those of `find`; only an empty one means any device.");
    else
        expect_device_or_reason(exam, opening, std::string("For the id `") + id + "`");
    close_opened(driver, opening);
}

void gives_up(Examination& exam) {
    constexpr double max_processor = 1.0, max_wall = 5.0;  // [s] the second for a machine under load
    const kerf_component& driver = *exam.subject->device;
    const Seconds start = Seconds::now();
    const Opening opening = open_device(driver, {.patience = 0.0});
    const Seconds taken = Seconds::now().since(start);
    close_opened(driver, opening);
    if (taken.processor > max_processor || taken.wall > max_wall)
        return exam.fail("With `is_cancelled` true from the beginning, `open` returns after " + number(taken.wall) +
                         " s, expected within 1 s. Call `is_cancelled` ten times a second while it waits.");
    expect_device_or_reason(exam, opening, "With `is_cancelled` true from the beginning");
}

void takes_any_setting(Examination& exam) {
    const kerf_component& driver = *exam.subject->device;
    const std::string texts[] = {"", std::string(1u << 16, 'x'), "\xff\xfe\x80 \x1b[2J", "/", "-1e999", "%n%s"};
    for (const std::string& text : texts) {
        const Opening opening = open_device(
            driver,
            {.settings = {{"peer", text}, {"key_file", text}, {"motion", text}, {text, text}}, .patience = 0.1});
        const std::string when = "With the settings " + quoted_plain(text);
        expect_device_or_reason(exam, opening, when);
        close_opened(driver, opening);
        if (exam.has_failed()) return;
    }
}

// ---- an open device -----------------------------------------------------------------------------------------------

void states_sound_facts(Examination& exam) {
    DeviceTrial device(*exam.subject->device);
    if (!device.is_open()) return exam.skip(device.reason());
    if (const std::string fault = fault_of_statement(device.facts()); !fault.empty())
        exam.fail("Of the facts of the open device, " + fault);
}

/// Which part of a tick is done: "Tick 12".
std::string at_tick(std::uint64_t tick) { return "At tick " + std::to_string(tick) + ", "; }

/// Reads a device once more and checks the report, also against the one before.
class Reports {
public:
    explicit Reports(const DeviceTrial& device) : device_(device) {}

    [[nodiscard]] bool read(Examination& exam, const std::string& when) {
        const kerf_device_state state = device_.read();
        if (const std::string fault = fault_of_report(device_.facts(), state); !fault.empty()) exam.fail(when + fault);
        if (state.reports < newest_.reports)
            exam.fail(when + "`reports` falls from " + std::to_string(newest_.reports) + " to " +
                      std::to_string(state.reports) + ". Count on, also when the device comes back.");
        newest_ = state;
        return !exam.has_failed();
    }
    [[nodiscard]] const kerf_device_state& newest() const noexcept { return newest_; }

private:
    const DeviceTrial& device_;
    kerf_device_state newest_{};
};

void reports_soundly(Examination& exam) {
    constexpr std::uint64_t ticks = 2000, ticks_on_the_clock = 500;  // for a device with a thread of its own
    DeviceTrial device(*exam.subject->device);
    if (!device.is_open()) return exam.skip(device.reason());
    Reports reports(device);
    auto next = std::chrono::steady_clock::now();
    for (std::uint64_t tick = 0; tick < ticks; ++tick) {
        if (!reports.read(exam, at_tick(tick))) return;
        device.write(gentle_command(tick, reports.newest()));
        if (tick < ticks_on_the_clock) std::this_thread::sleep_until(next += std::chrono::milliseconds(1));
    }
    exam.note(std::to_string(reports.newest().reports) + " reports in " + std::to_string(ticks) + " ticks");
}

void takes_any_command(Examination& exam) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    constexpr int repeats = 20;
    DeviceTrial device(*exam.subject->device);
    if (!device.is_open()) return exam.skip(device.reason());
    Reports reports(device);
    std::uint64_t tick = 0;
    for (const double value : {nan, inf, -inf, 1e308, -1e308, 5e-324})
        for (int i = 0; i < repeats; ++i) {
            kerf_device_command command = gentle_command(tick++, reports.newest());
            command.force = command.torque = {value, value, value};
            command.device_from_tool = {{value, value, value}, {value, value, value, value}};
            if (i % 2 == 1) command.flags = ~0u;
            if (i == repeats - 1) command.tick = std::numeric_limits<std::uint64_t>::max();
            device.write(command);
            if (!reports.read(exam, "After a command whose numbers are " + number(value) + ", ")) return;
        }
    for (int i = 0; i < repeats; ++i) {
        device.write(gentle_command(tick++, reports.newest()));
        if (!reports.read(exam, "After commands with any numbers and a sound one, ")) return;
    }
}

// ---- real time ----------------------------------------------------------------------------------------------------

constexpr std::uint64_t watched_ticks = 1000;

/// Calls `read` and `write` of each tick through `watch(call, work)`, until the test has failed.
template <class Watch>
void run_watched(Examination& exam, const Watch& watch) {
    DeviceTrial device(*exam.subject->device);
    if (!device.is_open()) return exam.skip(device.reason());
    for (std::uint64_t tick = 0; tick < watched_ticks && !exam.has_failed(); ++tick) {
        kerf_device_state state{};
        watch("read", tick, [&] { state = device.read(); });
        const kerf_device_command command = gentle_command(tick, state);
        watch("write", tick, [&] { device.write(command); });
    }
}

void never_calls(Examination& exam, std::initializer_list<Forbidden> kinds, const char* why) {
    if (!can_watch()) return exam.skip("a sanitizer is built in, with a heap and locks of its own");
    run_watched(exam, [&](const char* call, std::uint64_t tick, const auto& work) {
        start_watching();
        work();
        const Watched seen = stop_watching();
        for (const Forbidden kind : kinds)
            if (seen.of(kind) != nullptr)
                exam.fail(at_tick(tick) + "`" + call + "` calls `" + seen.of(kind) + "`. " + why);
    });
}
void allocates_nothing(Examination& exam) {
    never_calls(exam, {Forbidden::allocation, Forbidden::exception, Forbidden::initialisation},
                "The heap may take a lock, or the kernel. Allocate in `open`.");
}
void takes_no_lock(Examination& exam) {
    never_calls(exam, {Forbidden::lock, Forbidden::thread},
                "The driver's thread may hold it for longer than a tick. Pass values as kerf/newest.hpp does.");
}
void makes_no_system_call(Examination& exam) {
    const char* const why = "The kernel may take longer than a tick. Do it on a thread of the driver.";
    if (!can_watch_system_calls()) return exam.skip("this kernel cannot report system calls to their process");
    never_calls(exam, {Forbidden::output}, why);
    if (exam.has_failed() || exam.status() == Status::skipped) return;
    run_watched(exam, [&](const char* call, std::uint64_t tick, const auto& work) {
        start_watching_system_calls();
        work();
        if (const long made = stop_watching_system_calls(); made >= 0)
            exam.fail(at_tick(tick) + "`" + call + "` makes the system call number " + std::to_string(made) + ". " +
                      why);
    });
}

// ---- closing ------------------------------------------------------------------------------------------------------

/// Bytes that the process has allocated and not freed, on the heap and in pages of their own.
std::size_t allocated_bytes() noexcept {
    const struct mallinfo2 heap = mallinfo2();
    return heap.uordblks + heap.hblkhd;
}

void closes(Examination& exam) {
    constexpr int rounds = 20, first_rounds = 4;  // in the first ones, a library may keep what it needs again
    constexpr double max_close = 0.2, max_close_once = 5.0;  // [s] by the clock: of the fastest close, and of any
    constexpr std::size_t kept_per_round = 1024;             // [B] more is growth
    const kerf_component& driver = *exam.subject->device;
    const ProcessState before = process_state();
    double fastest = max_close_once;
    std::size_t allocated = 0;
    for (int round = 0; round < rounds; ++round) {
        DeviceTrial device(driver);
        if (!device.is_open()) return exam.skip(device.reason());
        const kerf_device_state state = device.read();
        device.write(gentle_command(0, state));
        const Seconds start = Seconds::now();
        device.close();
        const double taken = Seconds::now().since(start).wall;
        fastest = taken > max_close_once ? taken : std::min(fastest, taken);
        if (taken > max_close_once) break;
        if (round + 1 == first_rounds) allocated = allocated_bytes();
    }
    if (fastest > max_close)
        return exam.fail("`close` takes " + number(fastest) +
                         " s or more, expected at most 0.2 s. Wait at most 0.1 s for "
                         "the device to take a zero force.");
    const std::size_t still_allocated = allocated_bytes();
    const ProcessState after = process_state();
    const std::string times = std::to_string(rounds) + " times";
    if (after.threads > before.threads)
        return exam.fail("Opened and closed " + times + ", it leaves " +
                         std::to_string(after.threads - before.threads) + " thread(s) running. Join them in `close`.");
    if (const auto more = further(before.files, after.files); !more.empty())
        return exam.fail("Opened and closed " + times + ", it leaves " + std::to_string(more.size()) +
                         " file(s) open, one of them " + quoted_plain(more.front()) + ". Close them in `close`.");
    if (still_allocated > allocated + (rounds - first_rounds) * kept_per_round)
        return exam.fail("Each time it is opened and closed, it keeps " +
                         std::to_string((still_allocated - allocated) / (rounds - first_rounds)) +
                         " bytes. Free them in `close`.");
    exam.note("closes within " + number(1e3 * fastest) + " ms");
}

constexpr Test tests[] = {
    {"device.find_bounded", 3, Scope::device, "It finds no more devices than fit, with ids that a station can name.",
     &finds_within_bounds, "describe.tables", 5},
    {"device.refuses_unknown_id", 3, Scope::device, "It opens no device for an id that none has, and says why.",
     &refuses_unknown_id, "describe.tables", 5},
    {"device.gives_up", 3, Scope::device, "It stops opening when the user no longer waits.", &gives_up,
     "describe.tables", 5},
    {"device.takes_any_setting", 3, Scope::device, "It takes or refuses any text as a setting.", &takes_any_setting,
     "describe.tables", 5},
    {"device.facts", 3, Scope::device, "The facts that it states are sound.", &states_sound_facts, "describe.tables",
     5},
    {"device.reports", 3, Scope::device, "Its reports are sound, tick after tick.", &reports_soundly, "device.facts",
     5},
    {"device.takes_any_command", 3, Scope::device, "Its reports stay sound whatever force it gets.", &takes_any_command,
     "device.reports", 5},
    {"device.no_allocation", 3, Scope::device, "`read` and `write` allocate and free no memory.", &allocates_nothing,
     "device.facts", 5},
    {"device.no_lock", 3, Scope::device, "`read` and `write` take no lock.", &takes_no_lock, "device.facts", 5},
    {"device.no_system_call", 3, Scope::device, "`read` and `write` make no system call.", &makes_no_system_call,
     "device.facts", 5},
    {"device.closes", 3, Scope::device, "It closes soon, and leaves no thread, file or memory.", &closes,
     "device.facts", 5},
};

}  // namespace

std::span<const Test> device_tests() { return tests; }

}  // namespace kerf::conformance
