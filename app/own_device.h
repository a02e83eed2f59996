// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "app/exit_code.h"
#include "app/interruption.h"
#include "core/plugin/loader.h"
#include "documents/station.h"
#include "run/device/opened_device.h"
#include "run/run_observer.h"
#include "run/scene.h"

namespace kerf::app {

/// A device of this table, with its setup.
struct OwnDevice {
    documents::DeviceStation station;
    std::unique_ptr<run::OpenedDevice> opened;
};

/// Reads the station and opens one of its devices. Prints the reason if it cannot.   [main] may wait for the device
[[nodiscard]] ExitCode open_own_device(const std::string& id, const PluginRegistry& plugins,
                                       const Interruption& interruption, OwnDevice& device);

/// The same for the device that leads the tool of a run, with its pedal.   [main] may wait for the devices
[[nodiscard]] ExitCode open_leading_device(const std::string& id, const PluginRegistry& plugins,
                                           const Interruption& interruption, OwnDevice& device);

/// Computes the scale of a device whose station states a workspace, from where its handle now is. Prints the scale, and
/// where the operation does not fit.   [main] waits up to a second for a pose
/// @param rehearsal  id of the one whose path the hand follows; empty: the first
void fit_to_workspace(const run::Scene& scene, const std::string& rehearsal, OwnDevice& device);

/// Prints what is wrong with a device while it leads a run, once for each problem.
class DeviceProblems final : public run::RunObserver {
public:
    explicit DeviceProblems(run::OpenedDevice& device) : device_(device) {}
    void on_event(const session::EventRow& event) override;
    void on_tick(const session::TickRow& row) override;

private:
    void print_new();
    run::OpenedDevice& device_;
    std::string printed_{};
};

}  // namespace kerf::app
