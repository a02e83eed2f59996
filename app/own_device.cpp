// SPDX-License-Identifier: Apache-2.0
#include "app/own_device.h"

#include "app/standard_streams.h"
#include "app/station_file.h"

namespace kerf::app {

ExitCode open_own_device(const std::string& id, const PluginRegistry& plugins, const Interruption& interruption,
                         OwnDevice& device) {
    text::Diagnostics diagnostics;
    const auto own = read_own_station().take(diagnostics);
    if (!own) {
        print_error(to_text(diagnostics));
        return exit_bad_input;
    }
    device.station = own->of(id);
    std::string error;
    print_error("kerf: opening the device `" + id + "`; Ctrl-C ends\n");
    device.opened = run::OpenedDevice::open(
        plugins, device.station, [&] { return interruption.has_come(); }, error);
    return device.opened != nullptr ? exit_pass : complain(error, exit_bad_input);
}

}  // namespace kerf::app
