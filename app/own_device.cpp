// SPDX-License-Identifier: Apache-2.0
#include "app/own_device.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <thread>
#include <utility>

#include "app/confirmed_devices.h"
#include "app/standard_streams.h"
#include "app/station_file.h"
#include "core/haptics/loop/device_report.h"
#include "run/device/workspace_fit.h"
#include "run/run_procedure.h"
#include "session/recorder.h"

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

/// Returns the position of the handle [m], or else the middle of the workspace.
Vec3 handle_of(run::OpenedDevice& device, const Box& workspace) {
    constexpr auto period = std::chrono::milliseconds(10);
    for (int tries = 0; tries < 100; ++tries) {
        const kerf_device_state state = device.read();
        if ((state.flags & KERF_DEVICE_VALID) != 0 && is_usable(state.device_from_handle))
            return state.device_from_handle.position;
        std::this_thread::sleep_for(period);
    }
    return 0.5 * (workspace.low + workspace.high);
}

/// Returns the directions in which the handle would leave its workspace, with their distances.
std::string ends_of(const run::WorkspaceFit& fit) {
    const std::pair<const char*, double> ends[] = {
        {"to the left", fit.below.x}, {"to the right", fit.above.x},       {"down", fit.below.y},
        {"up", fit.above.y},          {"away from the user", fit.below.z}, {"to the user", fit.above.z}};
    std::string text;
    for (const auto& [direction, distance] : ends)
        if (distance > 0.0) text += (text.empty() ? "" : ", ") + formatted("%.0f mm %s", 1e3 * distance, direction);
    return text;
}

}  // namespace

ExitCode open_own_device(const std::string& id, const PluginRegistry& plugins, const Interruption& interruption,
                         OwnDevice& device) {
    const auto own = own_station();
    if (!own) return exit_bad_input;
    device.station = own->of(id);
    return open_device(device.station, plugins, interruption, device.opened);
}

namespace {

/// Reminds the user of a device with force whose force no person has confirmed.
void remind_of_check(const run::OpenedDevice& device, const std::string& id) {
    if (device.is_modelled() || is_confirmed(device.name())) return;
    print_error("kerf: the force of the device `" + device.name() +
                "` was never confirmed at this table. Write `kerf devices test " + id + " --force` first.\n");
}

/// Adds the knob of a device's entry, if it names one.
ExitCode add_knob(const documents::Station& own, const PluginRegistry& plugins, const Interruption& interruption,
                  OwnDevice& device) {
    if (device.station.knob.empty()) return exit_pass;
    std::unique_ptr<run::OpenedDevice> knob;
    if (const ExitCode code = open_device(own.of(device.station.knob), plugins, interruption, knob); code != exit_pass)
        return code;
    if ((knob->facts().abilities & KERF_DEVICE_TURN_TORQUE) != 0) remind_of_check(*knob, device.station.knob);
    const std::string refusal = device.opened->add_knob(std::move(knob));
    return refusal.empty() ? exit_pass : complain(refusal, exit_bad_input);
}

}  // namespace

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
    if (device.opened->is_knob())
        return complain("the device `" + id + "` is a knob, so it cannot lead a tool. Write `knob: " + id +
                            "` under another device in " + station_file() + ".",
                        exit_bad_input);
    if (device.opened->record() != nullptr) remind_of_check(*device.opened, id);
    if (const ExitCode code = add_knob(*own, plugins, interruption, device); code != exit_pass) return code;
    if (device.station.pedal.empty()) return exit_pass;
    const documents::DeviceStation of_pedal = own->of(device.station.pedal);
    std::unique_ptr<run::OpenedDevice> pedal;
    if (const ExitCode code = open_device(of_pedal, plugins, interruption, pedal); code != exit_pass) return code;
    device.station.append_buttons(of_pedal, device.opened->facts().button_count);
    const std::string refusal = device.opened->add_pedal(std::move(pedal));
    return refusal.empty() ? exit_pass : complain(refusal, exit_bad_input);
}

void fit_to_workspace(const run::Scene& scene, const std::string& rehearsal, OwnDevice& device) {
    documents::DeviceStation& station = device.station;
    if (!station.workspace) return;
    if ((device.opened->facts().abilities & KERF_DEVICE_POSITION) == 0) {
        print_error("kerf: the device `" + station.device +
                    "` senses no position, so its `workspace` counts for nothing\n");
        return;
    }
    const Box motion = run::motion_of(run::rehearsal_of(scene.procedure, rehearsal), scene, station);
    const run::WorkspaceFit fit =
        run::fit_into(*station.workspace, handle_of(*device.opened, *station.workspace), motion);
    station.scale = fit.scale;
    const std::string moves = formatted("kerf: the tool moves by %.2f of the handle's motion", fit.scale);
    if (fit.fits())
        print_error(moves + ", so that the operation fits into the workspace\n");
    else
        print_error(moves +
                    ", and the operation still does not fit into the workspace: the handle would have to move " +
                    ends_of(fit) + " beyond it. Begin farther from there, or use the button `clutch`\n");
}

void DeviceProblems::on_event(const session::EventRow& event) {
    if (event.id == session::lost_event) print_new();
}

void DeviceProblems::on_tick(const session::TickRow& row) {
    constexpr std::uint64_t interval = 500;  // ticks
    if (row.tick % interval == 0) print_new();
}

void DeviceProblems::print_new() {
    std::string problem = device_.problem();
    if (problem == printed_) return;
    if (!problem.empty()) print_error("kerf: the device `" + device_.name() + "`: " + problem + "\n");
    printed_ = std::move(problem);
}

}  // namespace kerf::app
