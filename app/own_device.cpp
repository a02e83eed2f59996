// SPDX-License-Identifier: Apache-2.0
#include "app/own_device.h"

#include <optional>
#include <utility>

#include "app/standard_streams.h"
#include "app/station_file.h"

namespace kerf::app {

namespace {

/// Returns the station of this table. Prints what is wrong with it.
std::optional<documents::Station> own_station() {
    text::Diagnostics diagnostics;
    auto own = read_own_station().take(diagnostics);
    if (!own) print_error(to_text(diagnostics));
    return own;
}

ExitCode open_device(const documents::DeviceStation& station, const PluginRegistry& plugins,
                     const Interruption& interruption, std::unique_ptr<run::OpenedDevice>& opened) {
    std::string error;
    print_error("kerf: opening the device `" + station.device + "`; Ctrl-C ends\n");
    opened = run::OpenedDevice::open(
        plugins, station, [&] { return interruption.has_come(); }, error);
    return opened != nullptr ? exit_pass : complain(error, exit_bad_input);
}

}  // namespace

ExitCode open_own_device(const std::string& id, const PluginRegistry& plugins, const Interruption& interruption,
                         OwnDevice& device) {
    const auto own = own_station();
    if (!own) return exit_bad_input;
    device.station = own->of(id);
    return open_device(device.station, plugins, interruption, device.opened);
}

ExitCode open_leading_device(const std::string& id, const PluginRegistry& plugins, const Interruption& interruption,
                             OwnDevice& device) {
    const auto own = own_station();
    if (!own) return exit_bad_input;
    device.station = own->of(id);
    if (const ExitCode code = open_device(device.station, plugins, interruption, device.opened); code != exit_pass)
        return code;
    if (device.opened->is_pedal())
        return complain("the device `" + id + "` only has buttons, so it cannot lead a tool. Write `pedal: " + id +
                            "` under another device in " + station_file() + ".",
                        exit_bad_input);
    if (device.station.pedal.empty()) return exit_pass;
    const documents::DeviceStation of_pedal = own->of(device.station.pedal);
    std::unique_ptr<run::OpenedDevice> pedal;
    if (const ExitCode code = open_device(of_pedal, plugins, interruption, pedal); code != exit_pass) return code;
    device.station.append_buttons(of_pedal, device.opened->facts().button_count);
    const std::string refusal = device.opened->add_pedal(std::move(pedal));
    return refusal.empty() ? exit_pass : complain(refusal, exit_bad_input);
}

}  // namespace kerf::app
