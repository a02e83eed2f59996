// SPDX-License-Identifier: Apache-2.0
// `kerf devices`.
#include <algorithm>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/device_health.h"
#include "app/device_test.h"
#include "app/force_check.h"
#include "app/listed_name.h"
#include "app/standard_streams.h"
#include "app/station_file.h"
#include "kerf/units.hpp"
#include "run/device/opened_device.h"
#include "text/quantity.h"

namespace kerf::app {

namespace {

void print_devices(const PluginRegistry& plugins) {
    const std::vector<run::ListedDevice> devices = run::find_devices(plugins);
    bool is_any_ready = false;
    for (const run::ListedDevice& device : devices) {
        if (device.id.empty()) {
            print(device.driver + "  no device found. " + device.help + "\n");
            continue;
        }
        print(name_of(device) + "  " + device.name + "\n");
        print(device.problem.empty() ? "    " + device.help + "\n" : "    cannot be opened: " + device.problem + "\n");
        is_any_ready = is_any_ready || device.problem.empty();
    }
    if (devices.empty()) print("no plugin has a driver for devices\n");
    if (is_any_ready)
        print("\nkerf devices test DEVICE                      measures a device\n"
              "kerf run PROCEDURE.yaml --device DEVICE       a hand at the device carries out an operation\n");
}

ExitCode set_up(const std::string& id, const PluginRegistry& plugins) {
    std::string device = id;
    if (device.empty()) {
        const std::vector<run::ListedDevice> all = run::find_devices(plugins);
        if (all.empty()) return complain("no plugin has a driver for devices.", exit_bad_input);
        const auto connected =
            std::find_if(all.begin(), all.end(), [](const run::ListedDevice& one) { return !one.id.empty(); });
        device = (connected != all.end() ? *connected : all.front()).driver;
    }
    const std::string file = station_file();
    if (const std::string error = write_station(file, device); !error.empty()) return complain(error, exit_bad_input);
    print(file + "\nChange it for your device; docs/guide/devices.md explains the keys.\n");
    return exit_pass;
}

ExitCode measure(const DevicesOptions& options, const PluginRegistry& plugins) {
    const text::Parsed<double> seconds =
        text::parse_quantity(options.duration, "`--for`", {dimension::time, "s", 0.1, 3600.0});
    if (!seconds.value) return complain(seconds.problem.message, exit_bad_input);
    return test_device({.id = options.device, .seconds = *seconds.value, .record = options.record}, plugins);
}

}  // namespace

namespace commands {

ExitCode devices(const DevicesOptions& options, const Environment& with) {
    if (options.action == "test")
        return options.is_with_force ? check_force(options.device, with.plugins) : measure(options, with.plugins);
    if (options.is_with_force) return complain("only `kerf devices test` takes `--force`.", exit_bad_input);
    if (!options.record.empty()) return complain("only `kerf devices test` takes `--record`.", exit_bad_input);
    if (options.action == "setup") return set_up(options.device, with.plugins);
    if (!options.device.empty()) return complain("only `kerf devices test` and `setup` take a device.", exit_bad_input);
    if (options.action == "doctor") return report_health(with);
    print_devices(with.plugins);
    return exit_pass;
}

}  // namespace commands
}  // namespace kerf::app
