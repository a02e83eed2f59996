// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/loop/stated_device.h"

#include <algorithm>
#include <cstdint>

namespace kerf {

namespace {

constexpr double viscosity = 0.1;       // [N·s/m] of a handle [assumed]
constexpr double friction = 0.05;       // [N] of a handle [assumed]
constexpr double knob_friction = 0.01;  // [N·m] of a motor about the handle's axis [assumed]

struct Value {
    const char* name;
    double DeviceRecord::*member;
};
constexpr Value values[] = {{"peak_force", &DeviceRecord::peak_force},
                            {"continuous_force", &DeviceRecord::continuous_force},
                            {"peak_torque", &DeviceRecord::peak_torque},
                            {"continuous_torque", &DeviceRecord::continuous_torque},
                            {"largest_stiffness", &DeviceRecord::largest_stiffness},
                            {"largest_damping", &DeviceRecord::largest_damping},
                            {"mass", &DeviceRecord::mass},
                            {"resolution", &DeviceRecord::resolution}};

bool is_between(double value, double min, double max) { return value >= min && value <= max; }

struct AxisValue {
    const char* name;
    double TorqueAxis::*member;
};
/// Sessions of devices without a motor about the axis have none of these.
constexpr AxisValue axis_values[] = {{"turn_peak_torque", &TorqueAxis::peak_torque},
                                     {"turn_resolution", &TorqueAxis::resolution},
                                     {"turn_friction", &TorqueAxis::friction}};

constexpr double min_turn_torque = 1e-3, max_turn_torque = 50.0;  // [N·m]

/// Returns why the loop cannot use the resolution of a knob [rad]; empty if it can.
std::string fault_of_turn_resolution(double resolution) {
    return is_between(resolution, 1e-9, 0.1) ? "" : "the resolution of its knob must be 1 nrad to 0.1 rad";
}

/// Returns why the loop cannot use the motor about the axis of a device; empty if it can, or if there is none.
std::string fault_of_axis(const DeviceRecord& d) {
    if (d.axis.peak_torque == 0.0) return {};
    if (d.peak_torque != 0.0) return "it makes all torques itself, so it needs no motor about its axis";
    if (!is_between(d.axis.peak_torque, min_turn_torque, max_turn_torque))
        return "the torque of its knob must be 1 mN m to 50 N m at the peak";
    if (!is_between(d.axis.friction, 1e-6, 10.0)) return "the friction of its knob must be 1 uN m to 10 N m";
    return fault_of_turn_resolution(d.axis.resolution);
}

/// Returns why the loop cannot use a device; empty if it can.
std::string fault_of(const DeviceRecord& d) {
    if (!is_between(d.peak_force, 0.1, 100.0) || !is_between(d.continuous_force, 0.05, d.peak_force))
        return "its force must be 0.1 N to 100 N at the peak, and its continuous force 0.05 N to the peak";
    if (d.peak_torque != 0.0 &&
        (!is_between(d.peak_torque, 1e-3, 10.0) || !is_between(d.continuous_torque, 1e-4, d.peak_torque)))
        return "its torque must be 0, or 1 mN m to 10 N m at the peak, and its continuous torque 0.1 mN m to the peak";
    if (!is_between(d.largest_stiffness, 10.0, 1e5)) return "its stiffness must be 10 N/m to 100 N/mm";
    if (!is_between(d.largest_damping, 0.0, 1e3)) return "its damping must be 0 to 1 N s/mm";
    if (!is_between(d.mass, 1e-3, 10.0)) return "its mass must be 1 g to 10 kg";
    if (!is_between(d.resolution, 1e-9, 2e-3)) return "its resolution must be 1 nm to 2 mm";
    return {};
}

/// Returns why the loop cannot use the knob of a device; empty if it can, or if there is none.
std::string fault_of_knob(const kerf_device_facts& d) {
    const bool has_turn = (d.abilities & KERF_DEVICE_TURN) != 0;
    if ((d.abilities & KERF_DEVICE_TURN_TORQUE) != 0) {
        if (!has_turn) return "it makes a torque about a knob whose turn it does not sense";
        if (!is_between(d.peak_turn_torque, min_turn_torque, max_turn_torque) ||
            !is_between(d.continuous_turn_torque, 1e-4, d.peak_turn_torque))
            return "the torque of its knob must be 1 mN m to 50 N m at the peak, and its continuous torque 0.1 mN m to "
                   "the peak";
    }
    return has_turn ? fault_of_turn_resolution(d.turn_resolution) : "";
}

/// Sets what follows from the stated values.
void complete(DeviceRecord& d) {
    d.viscosity = viscosity;
    d.friction = friction;
    // A sampled spring's limit falls as 1 / (1 + latency in ticks).
    for (int latency = 0; latency <= max_latency; ++latency)
        d.stiffest_wall[latency] = d.largest_stiffness / (1 + latency);
    d.source = "stated by the device";
    d.is_connected = true;
}

}  // namespace

bool leads_under_force(const kerf_device_facts& facts) noexcept {
    constexpr std::uint32_t others =
        KERF_DEVICE_DEFLECTION | KERF_DEVICE_TURN | KERF_DEVICE_TURN_TORQUE | KERF_DEVICE_MODELLED;
    return (facts.abilities & ~others) != 0;
}

std::string fault_of_facts(const kerf_device_facts& facts) {
    if (facts.button_count > KERF_DEVICE_MAX_BUTTONS)
        return "it states more than " + std::to_string(KERF_DEVICE_MAX_BUTTONS) + " buttons";
    std::string fault = fault_of_knob(facts);
    if (fault.empty() && leads_under_force(facts)) static_cast<void>(StatedDevice::of("", facts, fault));
    return fault;
}

std::unique_ptr<StatedDevice> StatedDevice::of(std::string id, const Values& recorded, std::string& fault) {
    std::unique_ptr<StatedDevice> device(new StatedDevice(std::move(id)));
    for (const Value& value : values) {
        const auto found =
            std::find_if(recorded.begin(), recorded.end(), [&](const auto& one) { return one.first == value.name; });
        if (found == recorded.end()) {
            fault = std::string("its ") + value.name + " is missing";
            return nullptr;
        }
        device->record_.*value.member = found->second;
    }
    for (const AxisValue& value : axis_values)
        for (const auto& [name, recorded_value] : recorded)
            if (name == value.name) device->record_.axis.*value.member = recorded_value;
    complete(device->record_);
    fault = fault_of(device->record_);
    if (fault.empty()) fault = fault_of_axis(device->record_);
    return fault.empty() ? std::move(device) : nullptr;
}

std::unique_ptr<StatedDevice> StatedDevice::of(std::string id, const kerf_device_facts& facts, std::string& fault) {
    if ((facts.abilities & KERF_DEVICE_POSITION) == 0) fault = "it senses no position";
    if ((facts.abilities & KERF_DEVICE_FORCE) == 0)
        fault = "it makes no force; without force only a deflection can move the tool";
    if (!fault.empty()) return nullptr;
    const bool has_torque = (facts.abilities & KERF_DEVICE_TORQUE) != 0;
    auto device = of(std::move(id),
                     {{"peak_force", facts.peak_force},
                      {"continuous_force", facts.continuous_force},
                      {"peak_torque", has_torque ? facts.peak_torque : 0.0},
                      {"continuous_torque", has_torque ? facts.continuous_torque : 0.0},
                      {"largest_stiffness", facts.largest_stiffness},
                      {"largest_damping", facts.largest_damping},
                      {"mass", facts.mass},
                      {"resolution", facts.resolution}},
                     fault);
    if (device == nullptr || (facts.abilities & KERF_DEVICE_TURN_TORQUE) == 0) return device;
    fault = device->add_axis(facts);
    return fault.empty() ? std::move(device) : nullptr;
}

StatedDevice::Values StatedDevice::values_of(const DeviceRecord& record) {
    Values all;
    for (const Value& value : values) all.emplace_back(value.name, record.*value.member);
    if (record.axis.peak_torque > 0.0)
        for (const AxisValue& value : axis_values) all.emplace_back(value.name, record.axis.*value.member);
    return all;
}

std::string StatedDevice::carry(double mass, double weight) {
    record_.mass += mass;
    record_.peak_force -= weight;
    record_.continuous_force -= weight;
    return fault_of(record_);
}

std::string StatedDevice::add_axis(const kerf_device_facts& knob) {
    if (std::string fault = fault_of_knob(knob); !fault.empty()) return fault;
    record_.axis = {
        .peak_torque = knob.peak_turn_torque, .resolution = knob.turn_resolution, .friction = knob_friction};
    record_.continuous_torque = knob.continuous_turn_torque;
    return fault_of_axis(record_);
}

}  // namespace kerf
