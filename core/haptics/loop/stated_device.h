// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/haptics/loop/device_record.h"
#include "kerf/device.h"

namespace kerf {

/// Returns whether a device leads a tool by its position, under a force. Others need no `StatedDevice`: one that senses
/// a deflection, a knob, or one that only has buttons.   [any] pure
[[nodiscard]] bool leads_under_force(const kerf_device_facts& facts) noexcept;

/// Returns why the loop cannot use a device of these facts; empty if it can.   [any]
[[nodiscard]] std::string fault_of_facts(const kerf_device_facts& facts);

/// The capabilities of a connected device that makes a force, as its driver states them or as a session recorded them.
class StatedDevice {
public:
    using Values = std::vector<std::pair<std::string, double>>;  ///< SI, by name

    /// Returns the device of a driver's statements, or null with the reason in `fault`.   [main]
    [[nodiscard]] static std::unique_ptr<StatedDevice> of(std::string id, const kerf_device_facts& facts,
                                                          std::string& fault);
    /// Returns the device that a session recorded, or null with the reason in `fault`.   [main]
    [[nodiscard]] static std::unique_ptr<StatedDevice> of(std::string id, const Values& recorded, std::string& fault);
    StatedDevice(const StatedDevice&) = delete;
    StatedDevice& operator=(const StatedDevice&) = delete;

    [[nodiscard]] const DeviceRecord& record() const noexcept { return record_; }
    /// Adds the motor of a knob about the handle's axis. Returns why it cannot; empty on success.   [main] before the
    /// record is used
    [[nodiscard]] std::string add_axis(const kerf_device_facts& knob);
    /// Returns the largest weight that may be fixed to the handle [N]: half of the continuous force.
    [[nodiscard]] double max_weight() const noexcept { return 0.5 * record_.continuous_force; }
    /// Adds a mass to the handle, whose weight [N] takes a part of the device's force. Returns why it cannot; empty on
    /// success. Pre: weight ≤ max_weight().   [main] before the record is used
    [[nodiscard]] std::string carry(double mass, double weight);
    /// Returns what a session records, so that a replay has the same device.
    [[nodiscard]] static Values values_of(const DeviceRecord& record);

private:
    explicit StatedDevice(std::string id) : id_(std::move(id)) { record_.id = id_.c_str(); }
    std::string id_;
    DeviceRecord record_{};
};

}  // namespace kerf
