// SPDX-License-Identifier: Apache-2.0
// `kerf devices`.
#include <sys/resource.h>
#include <sys/utsname.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "app/commands.h"
#include "app/interruption.h"
#include "app/own_device.h"
#include "app/program.h"
#include "app/standard_streams.h"
#include "app/station_file.h"
#include "run/clock/realtime_thread.h"
#include "run/device/opened_device.h"
#include "session/recorder.h"

namespace kerf::app {

namespace {

std::string name_of(const run::ListedDevice& device) {
    return device.id.empty() ? device.driver : device.driver + "/" + device.id;
}

void print_devices(const PluginRegistry& plugins) {
    const std::vector<run::ListedDevice> devices = run::find_devices(plugins);
    for (const run::ListedDevice& device : devices) {
        if (device.id.empty()) {
            print(device.driver + "  no device found. " + device.help + "\n");
            continue;
        }
        print(name_of(device) + "  " + device.name + "\n");
        print(device.problem.empty() ? "    kerf run PROCEDURE.yaml --device " + name_of(device) + "\n"
                                     : "    cannot be opened: " + device.problem + "\n");
    }
    if (devices.empty()) print("no plugin has a driver for devices\n");
}

// ---- test --------------------------------------------------------------------------------------------------------

/// What a device reported in some seconds.
struct Reports {
    std::uint64_t count = 0;
    double seconds = 0.0, longest_gap = 0.0;                // [s]
    std::array<double, 3> low, high;                        // [m]
    double rest = std::numeric_limits<double>::infinity();  // [m] least range along an axis within 0.2 s
    std::uint32_t buttons = 0;                              // that were pressed

    Reports() {
        low.fill(std::numeric_limits<double>::infinity());
        high.fill(-std::numeric_limits<double>::infinity());
    }
};

Reports watch_reports(run::OpenedDevice& device, double seconds, const Interruption& interruption) {
    constexpr auto period = std::chrono::milliseconds(1);
    constexpr std::size_t window = 200;  // samples
    Reports reports;
    std::vector<Vec3> recent;
    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t first = device.read().reports;
    auto next = start;
    while (reports.seconds < seconds && !interruption.has_come()) {
        next += period;
        std::this_thread::sleep_until(next);
        reports.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        const kerf_device_state state = device.read();
        reports.count = state.reports - first;
        reports.longest_gap = std::max(reports.longest_gap, state.age);
        if ((state.flags & KERF_DEVICE_VALID) == 0) continue;
        reports.buttons |= state.buttons;
        const Vec3 p = state.device_from_handle.position;
        const std::array<double, 3> at{p.x, p.y, p.z};
        for (std::size_t i = 0; i < 3; ++i) {
            reports.low[i] = std::min(reports.low[i], at[i]);
            reports.high[i] = std::max(reports.high[i], at[i]);
        }
        recent.push_back(p);
        if (recent.size() < window) continue;
        Vec3 low = recent.front(), high = low;
        for (const Vec3& q : recent) {
            low = {std::min(low.x, q.x), std::min(low.y, q.y), std::min(low.z, q.z)};
            high = {std::max(high.x, q.x), std::max(high.y, q.y), std::max(high.z, q.z)};
        }
        reports.rest = std::min(reports.rest, std::max({high.x - low.x, high.y - low.y, high.z - low.z}));
        recent.clear();
    }
    return reports;
}

/// Returns a range as a bar on a scale from -150 mm to 150 mm.
std::string bar(double low, double high) {
    constexpr int width = 61;
    constexpr double scale = 0.15;  // [m]
    const auto column = [=](double x) {
        return static_cast<int>(std::lround((std::clamp(x, -scale, scale) / scale + 1.0) * 0.5 * (width - 1)));
    };
    std::string text(width, '.');
    text[width / 2] = '|';
    for (int i = column(low); i <= column(high); ++i) text[static_cast<std::size_t>(i)] = '#';
    return text;
}

ExitCode test_device(const std::string& id, const PluginRegistry& plugins) {
    if (id.empty())
        return complain("which device? Write `kerf devices test ID`; `kerf devices` shows them.", exit_bad_input);
    constexpr double seconds = 10.0;
    const Interruption interruption;
    OwnDevice own;
    if (const ExitCode code = open_own_device(id, plugins, interruption, own); code != exit_pass) return code;
    run::OpenedDevice& device = *own.opened;
    const kerf_device_facts& facts = device.facts();
    print(std::string(device.record().id) + "\n" +
          formatted("  states: %.1f N at the peak, %.1f N continuous, up to %.2f N/mm, %u %s; senses %s\n",
                    facts.peak_force, facts.continuous_force, 1e-3 * facts.largest_stiffness, facts.button_count,
                    facts.button_count == 1 ? "button" : "buttons",
                    (facts.abilities & KERF_DEVICE_ROTATION) != 0 ? "position and rotation" : "position"));
    print_error("kerf: move the handle to all ends, press each button, then hold still; no force is made\n");
    const Reports reports = watch_reports(device, seconds, interruption);
    if (reports.count == 0)
        return complain("the device sent no pose in " + formatted("%.0f s", reports.seconds) + ".", exit_not_passed);
    print(formatted("  %.0f poses a second, the longest silence %.1f ms%s\n",
                    static_cast<double>(reports.count) / reports.seconds, 1e3 * reports.longest_gap,
                    reports.longest_gap > 20e-3 ? ": a run fades the force after 20 ms" : ""));
    print("  range, from -150 mm to 150 mm:\n");
    constexpr const char* axes[] = {"x (right)      ", "y (up)         ", "z (to the user)"};
    for (std::size_t i = 0; i < 3; ++i)
        print("    " + std::string(axes[i]) + " " + bar(reports.low[i], reports.high[i]) +
              formatted("  %.1f to %.1f mm\n", 1e3 * reports.low[i], 1e3 * reports.high[i]));
    if (std::isfinite(reports.rest)) print(formatted("  at rest it stays within %.3f mm\n", 1e3 * reports.rest));
    std::string pressed;
    for (std::uint32_t i = 0; i < facts.button_count; ++i)
        if ((reports.buttons >> i & 1u) != 0) pressed += (pressed.empty() ? "" : ", ") + std::to_string(i);
    print("  buttons pressed: " + (pressed.empty() ? "none" : pressed) + "\n");
    return interruption.has_come() ? complain("interrupted", exit_fault) : exit_pass;
}

// ---- setup -------------------------------------------------------------------------------------------------------

ExitCode set_up(const std::string& id, const PluginRegistry& plugins) {
    std::string device = id;
    if (device.empty()) {
        const std::vector<run::ListedDevice> all = run::find_devices(plugins);
        if (all.empty()) return complain("no plugin has a driver for devices.", exit_bad_input);
        device = all.front().driver;
    }
    const std::string file = station_file();
    if (const std::string error = write_station(file, device); !error.empty()) return complain(error, exit_bad_input);
    print(file + "\nChange it for your device; docs/guide/devices.md explains the keys.\n");
    return exit_pass;
}

// ---- doctor ------------------------------------------------------------------------------------------------------

std::string limit_text(rlim_t limit, rlim_t unit, const char* name) {
    return limit == RLIM_INFINITY ? "unlimited" : std::to_string(limit / unit) + name;
}

ExitCode report_health(const PluginRegistry& plugins) {
    print(std::string(session::notice_line) + ".\n");
    utsname system{};
    uname(&system);
    print("kerf " KERF_VERSION ", " + std::string(system.sysname) + " " + system.release + ", " + system.machine +
          ", " + std::to_string(std::thread::hardware_concurrency()) + " processors\n\nreal time\n");
    const run::RealtimeState state = run::run_in_real_time([] {}, [] {});
    rlimit priority{}, memory{};
    getrlimit(RLIMIT_RTPRIO, &priority);
    getrlimit(RLIMIT_MEMLOCK, &memory);
    print("  real-time priority: limit " + limit_text(priority.rlim_cur, 1, "") +
          ", needed 49\n  locked memory: limit " + limit_text(memory.rlim_cur, 1u << 20, " MiB") +
          ", needed unlimited\n");
    for (const std::string& refusal : state.refusals) print("  " + refusal + "\n");
    if (state.refusals.empty()) print("  the haptic thread gets all that it needs\n");
    print("\ndevices\n");
    text::Diagnostics diagnostics;
    const std::string file = station_file();
    const auto own = read_own_station().take(diagnostics);
    if (!own)
        print("  the station file cannot be used:\n" + to_text(diagnostics));
    else
        print("  station file " + file + (own->devices.empty() ? ": none, so the defaults count\n" : ": read\n"));
    bool has_problem = !state.refusals.empty() || !own;
    for (const run::ListedDevice& device : run::find_devices(plugins)) {
        print("  " + name_of(device) + ": " +
              (device.id.empty()        ? "no device found"
               : device.problem.empty() ? "can be opened"
                                        : device.problem) +
              "\n");
        has_problem = has_problem || !device.problem.empty();
    }
    print("\nplugins\n");
    for (const PluginText& plugin : plugins.listed()) print("  " + plugin.id + " " + plugin.version + "\n");
    for (const std::string& refusal : plugins.refusals()) print("  refused: " + refusal + "\n");
    return has_problem || !plugins.refusals().empty() ? exit_not_passed : exit_pass;
}

}  // namespace

namespace commands {

ExitCode devices(const DevicesOptions& options, const Environment& with) {
    if (options.action == "test") return test_device(options.device, with.plugins);
    if (options.action == "setup") return set_up(options.device, with.plugins);
    if (!options.device.empty()) return complain("only `kerf devices test` and `setup` take a device.", exit_bad_input);
    if (options.action == "doctor") return report_health(with.plugins);
    print_devices(with.plugins);
    return exit_pass;
}

}  // namespace commands
}  // namespace kerf::app
