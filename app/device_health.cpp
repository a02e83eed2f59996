// SPDX-License-Identifier: Apache-2.0
#include "app/device_health.h"

#include <sys/resource.h>
#include <sys/utsname.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "app/listed_name.h"
#include "app/standard_streams.h"
#include "app/station_file.h"
#include "devices/hid/hid_nodes.h"
#include "devices/hid/hid_transport.h"
#include "run/clock/realtime_thread.h"
#include "run/device/opened_device.h"
#include "session/recorder.h"
#include "text/shell.h"

namespace kerf::app {

namespace {

std::string limit_text(rlim_t limit, rlim_t unit, const char* name) {
    return limit == RLIM_INFINITY ? "unlimited" : std::to_string(limit / unit) + name;
}

bool is_in_any(const std::string& file, std::initializer_list<const char*> folders) {
    return std::any_of(folders.begin(), folders.end(), [&](const char* folder) {
        std::error_code error;
        return std::filesystem::exists(std::filesystem::path(folder) / file, error);
    });
}

bool are_limits_installed() { return is_in_any("90-kerf.conf", {"/etc/security/limits.d"}); }
bool are_rules_installed() {
    return is_in_any(hid::udev_rules_file, {"/etc/udev/rules.d", "/run/udev/rules.d", "/usr/local/lib/udev/rules.d",
                                            "/usr/lib/udev/rules.d", "/lib/udev/rules.d"});
}

/// Returns whether the haptic thread gets all that it needs.
bool print_real_time(const Installation& here) {
    print("\nreal time\n");
    const run::RealtimeState state = run::run_in_real_time([] {}, [] {});
    rlimit priority{}, memory{};
    getrlimit(RLIMIT_RTPRIO, &priority);
    getrlimit(RLIMIT_MEMLOCK, &memory);
    print("  real-time priority: limit " + limit_text(priority.rlim_cur, 1, "") +
          ", needed 49\n  locked memory: limit " + limit_text(memory.rlim_cur, 1u << 20, " MiB") +
          ", needed unlimited\n");
    for (const std::string& refusal : state.refusals) print("  " + refusal + "\n");
    if (state.refusals.empty()) print("  the haptic thread gets all that it needs\n");
    if (!state.refusals.empty() && !are_limits_installed())
        print("  the limits of Kerf are not installed. As root, then log in again:\n    cp " +
              text::shell_path(here.system_files() + "/90-kerf.conf") +
              " /etc/security/limits.d/ && groupadd -f realtime && usermod -aG realtime USER\n");
    return state.refusals.empty();
}

/// Returns whether the file of this table can be used.
bool print_station() {
    text::Diagnostics diagnostics;
    const std::string file = station_file();
    const auto own = read_own_station().take(diagnostics);
    if (!own)
        print("  the station file cannot be used:\n" + to_text(diagnostics));
    else
        print("  station file " + file + (own->devices.empty() ? ": none, so the defaults count\n" : ": read\n"));
    return own.has_value();
}

/// Returns whether each device that is found can be opened.
bool print_found(const PluginRegistry& plugins) {
    bool is_well = true;
    for (const run::ListedDevice& device : run::find_devices(plugins)) {
        print("  " + name_of(device) + ": " +
              (device.id.empty()        ? "no device found"
               : device.problem.empty() ? "can be opened"
                                        : device.problem) +
              "\n");
        is_well = is_well && device.problem.empty();
    }
    return is_well;
}

void print_hid(const Installation& here) {
    print("\nHID devices\n");
    const std::string version = hid::hidapi_version();
    print(version.empty() ? std::string("  ") + hid::lacks_hidapi + "\n" : "  hidapi " + version + "\n");
    const std::vector<hid::HidNode> nodes = hid::list_hid_nodes();
    for (const hid::HidNode& node : nodes)
        print("  " + node.path + "  " + (node.mode.empty() ? "no such node" : node.mode) + "  " + node.device +
              (node.is_allowed ? "\n" : ": this user may not open it\n"));
    if (nodes.empty()) print("  no HID device is connected\n");
    if (are_rules_installed()) return;
    print("  the udev rules of Kerf are not installed. As root, then plug the device in again:\n    cp " +
          text::shell_path(here.system_files() + "/" + hid::udev_rules_file) +
          " /etc/udev/rules.d/ && udevadm control --reload && udevadm trigger\n");
}

}  // namespace

ExitCode report_health(const Environment& with) {
    print(std::string(session::notice_line) + ".\n");
    utsname system{};
    uname(&system);
    print("kerf " KERF_VERSION ", " + std::string(system.sysname) + " " + system.release + ", " + system.machine +
          ", " + std::to_string(std::thread::hardware_concurrency()) + " processors\n");
    bool is_well = print_real_time(with.here);
    print("\ndevices\n");
    is_well = print_station() && is_well;
    is_well = print_found(with.plugins) && is_well;
    print_hid(with.here);
    print("\nplugins\n");
    for (const PluginText& plugin : with.plugins.listed()) print("  " + plugin.id + " " + plugin.version + "\n");
    for (const std::string& refusal : with.plugins.refusals()) print("  refused: " + refusal + "\n");
    return is_well && with.plugins.refusals().empty() ? exit_pass : exit_not_passed;
}

}  // namespace kerf::app
