// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/haptics/loop/stated_device.h"
#include "core/plugin/loader.h"
#include "core/plugin/plugin_call.h"
#include "documents/station.h"
#include "kerf/device.h"
#include "run/device/fitted_handle.h"
#include "run/device/knob_turn.h"

namespace kerf::run {

/// A haptic device, opened through the driver of a plugin. Closed with this object: the driver then sends a zero force.
class OpenedDevice {
public:
    /// Opens the device that a station names, without its pedal. Returns null with the reason in `error`.   [main] may
    /// wait for the device
    /// @param is_cancelled  called ten times a second or more while it waits; true ends the wait
    [[nodiscard]] static std::unique_ptr<OpenedDevice> open(const PluginRegistry& plugins,
                                                            const documents::DeviceStation& station,
                                                            const std::function<bool()>& is_cancelled,
                                                            std::string& error);
    /// Takes over a device that its driver has opened. Returns null with the reason in `error` if the loop cannot use
    /// it.   [main]
    /// @param name  for people
    [[nodiscard]] static std::unique_ptr<OpenedDevice> take(const kerf_component& driver,
                                                            const kerf_device_open_out& opened, const std::string& name,
                                                            std::string& error);
    ~OpenedDevice() { call_close(*driver_, device_); }
    OpenedDevice(const OpenedDevice&) = delete;
    OpenedDevice& operator=(const OpenedDevice&) = delete;

    /// Returns its name, for people.
    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    /// Returns what the loop needs to know of it; null if it makes no force: then a modelled device replaces it.
    [[nodiscard]] const DeviceRecord* record() const noexcept {
        return stated_ != nullptr ? &stated_->record() : nullptr;
    }
    /// Returns whether it only has buttons, so that it cannot lead a tool.
    [[nodiscard]] bool is_pedal() const noexcept { return facts_.abilities == 0; }
    /// Returns whether it is no hardware.
    [[nodiscard]] bool is_modelled() const noexcept { return (facts_.abilities & KERF_DEVICE_MODELLED) != 0; }
    /// Returns whether it is a knob and nothing else, so that it cannot lead a tool.
    [[nodiscard]] bool is_knob() const noexcept {
        return facts_.abilities != 0 && (facts_.abilities & ~(KERF_DEVICE_TURN | KERF_DEVICE_TURN_TORQUE)) == 0;
    }
    /// Returns what it states, with the buttons of its pedal and the abilities of its knob.
    [[nodiscard]] const kerf_device_facts& facts() const noexcept { return facts_; }

    /// Adds a second device, whose buttons come after those of this one. A lost pedal has no button pressed. Returns
    /// why it cannot be added; empty on success.   [main]
    [[nodiscard]] std::string add_pedal(std::unique_ptr<OpenedDevice> pedal);

    /// Takes over what is fixed to the handle: from now on the handle is where the hand grips, and the device, which is
    /// that much weaker, carries the mass. Returns why it cannot; empty on success.   [main] before the record is used
    [[nodiscard]] std::string fit_handle(const documents::HandleFit& fit);

    /// Returns why the device or its pedal is lost or makes no force now, and what to do; empty if nothing is wrong.
    /// [main]
    [[nodiscard]] std::string problem();

    /// Adds a knob, whose turn adds to that of this device's handle, and whose motor makes the torque about the tool's
    /// shaft. Its buttons count for nothing. Returns why it cannot be added; empty on success.   [main] before the
    /// record is used
    [[nodiscard]] std::string add_knob(std::unique_ptr<OpenedDevice> knob);

    /// Returns the newest report, with the buttons of the pedal and the turn of the knob.   [haptic, nonblocking]
    [[nodiscard]] kerf_device_state read() noexcept;
    /// [haptic, nonblocking]
    void write(const kerf_device_command& command) noexcept {
        call_write(*driver_, device_, handle_ ? handle_->give(command) : command);
        if (knob_ != nullptr) knob_->write(command);
    }

private:
    OpenedDevice(const kerf_component& driver, const kerf_device_open_out& opened, std::string name)
        : driver_(&driver), device_(opened.device), facts_(opened.facts), name_(std::move(name)) {}

    const kerf_component* driver_;
    void* device_;
    kerf_device_facts facts_;
    std::string name_;
    std::unique_ptr<StatedDevice> stated_;
    std::unique_ptr<OpenedDevice> pedal_, knob_;
    std::optional<FittedHandle> handle_;
    KnobTurn turn_;                  ///< of the knob
    std::uint32_t own_buttons_ = 0;  ///< number of buttons before those of the pedal
};

/// A device that a driver has found, or the driver itself if it has found none.
struct ListedDevice {
    std::string driver, help;
    std::string id, name, problem;  ///< empty without a device
};
/// Returns the devices that the drivers of all plugins find now.   [main]
[[nodiscard]] std::vector<ListedDevice> find_devices(const PluginRegistry& plugins);

}  // namespace kerf::run
