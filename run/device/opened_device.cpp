// SPDX-License-Identifier: Apache-2.0
#include "run/device/opened_device.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/haptics/loop/device_record.h"
#include "documents/yaml/read_map.h"
#include "kerf/device_buttons.hpp"
#include "text/printable.h"
#include "text/quantity.h"
#include "text/source.h"

namespace kerf::run {

namespace {

constexpr std::uint32_t max_found = 32;  // of one driver

template <std::size_t size>
std::string text_in(const char (&text)[size]) {
    return text::shown(std::string(text, std::find(text, text + size, '\0')));
}

std::vector<std::string> drivers_of(const PluginRegistry& plugins) {
    std::vector<std::string> names;
    for (const ComponentInfo& component : plugins.catalog())
        if (component.kind == KERF_KIND_DEVICE) names.push_back(component.id);
    return names;
}

std::vector<double> defaults_of(const ComponentInfo& driver) {
    std::vector<double> values;
    for (const ParameterInfo& p : driver.parameters) values.push_back(p.def);
    return values;
}

/// The settings of a station for a driver: values of its parameters, and the others as texts.
struct DriverSettings {
    std::vector<double> parameters;  ///< SI, in declared order
    std::vector<kerf_device_setting> texts;
    std::string error;  ///< of the first setting that is no value of its parameter
};

/// Pre: the station outlives the result.
DriverSettings settings_for(const ComponentInfo& driver, const documents::DeviceStation& station) {
    DriverSettings settings{.parameters = defaults_of(driver), .texts = {}, .error = {}};
    for (const auto& [key, value] : station.settings) {
        const auto parameter = std::find_if(driver.parameters.begin(), driver.parameters.end(),
                                            [&id = key](const ParameterInfo& p) { return p.id == id; });
        if (parameter == driver.parameters.end()) {
            settings.texts.push_back({key.c_str(), value.c_str()});
            continue;
        }
        const text::Parsed<double> parsed = text::parse_quantity(
            value, key, {parameter->dimension, parameter->display_unit, parameter->min, parameter->max});
        if (parsed.value)
            settings.parameters[static_cast<std::size_t>(parameter - driver.parameters.begin())] = *parsed.value;
        else if (settings.error.empty())
            settings.error = "the station's setting `" + key + "` is wrong. " + parsed.problem.message;
    }
    return settings;
}

/// Returns a force for people, to 10 mN.
std::string in_newtons(double force) { return text::quantity_text(std::round(100.0 * force) / 100.0, "N"); }

}  // namespace

std::unique_ptr<OpenedDevice> OpenedDevice::open(const PluginRegistry& plugins, const documents::DeviceStation& station,
                                                 const std::function<bool()>& is_cancelled, std::string& error) {
    const std::size_t slash = station.device.find('/');
    const std::string driver_id = station.device.substr(0, slash);
    const std::string id = slash == std::string::npos ? "" : station.device.substr(slash + 1);
    const auto found =
        std::find_if(plugins.catalog().begin(), plugins.catalog().end(), [&](const ComponentInfo& component) {
            return component.kind == KERF_KIND_DEVICE && component.matches_id(driver_id);
        });
    if (found == plugins.catalog().end()) {
        const std::vector<std::string> known = drivers_of(plugins);
        if (find_device(driver_id.c_str()) != nullptr)
            error = "`" + driver_id + "` is a model of a device. Write `--set haptics.device=" + driver_id +
                    "` to simulate it; `--device` needs a driver: " +
                    (known.empty() ? "no plugin has one." : documents::listed(known) + ". `kerf devices` lists all.");
        else
            error = "there is no driver `" + text::excerpt(driver_id, 40) + "`" +
                    (known.empty() ? ": no plugin has a device."
                                   : ". " + documents::write_instead(driver_id, known) + " `kerf devices` lists all.");
        return nullptr;
    }
    const DriverSettings settings = settings_for(*found, station);
    if (!settings.error.empty()) {
        error = settings.error;
        return nullptr;
    }
    const kerf_component& driver = *plugins.find(found->plugin, KERF_KIND_DEVICE, found->id);
    const kerf_device_open_in in{.id = id.c_str(),
                                 .params = settings.parameters.data(),
                                 .settings = settings.texts.data(),
                                 .setting_count = static_cast<std::uint32_t>(settings.texts.size()),
                                 .reserved = 0};
    kerf_device_open_out out{};
    const auto should_end = [](void* context) {
        return (*static_cast<const std::function<bool()>*>(context))() ? std::int32_t{1} : std::int32_t{0};
    };
    const kerf_status status =
        call_open(driver, in, should_end, const_cast<std::function<bool()>*>(&is_cancelled), out);
    if (status != KERF_OK || out.device == nullptr) {
        if (out.device != nullptr) call_close(driver, out.device);
        error = "the device `" + station.device + "` cannot be opened: " + text_in(out.message);
        return nullptr;
    }
    const std::string name = text_in(out.facts.name);
    auto device = take(driver, out, found->id + (name.empty() ? "" : " " + name), error);
    if (device == nullptr || station.handle.is_none()) return device;
    error = device->fit_handle(station.handle);
    return error.empty() ? std::move(device) : nullptr;
}

std::unique_ptr<OpenedDevice> OpenedDevice::take(const kerf_component& driver, const kerf_device_open_out& opened,
                                                 const std::string& name, std::string& error) {
    std::unique_ptr<OpenedDevice> device(new OpenedDevice(driver, opened, name));
    std::string fault = fault_of_facts(opened.facts);
    if (fault.empty() && leads_under_force(opened.facts)) device->stated_ = StatedDevice::of(name, opened.facts, fault);
    if (fault.empty()) return device;
    error = "the device `" + name + "` cannot be used: " + fault + ".";
    return nullptr;
}

std::string OpenedDevice::fit_handle(const documents::HandleFit& fit) {
    if (stated_ == nullptr) return "the device `" + name_ + "` makes no force along its axes. Leave out `handle`.";
    const std::string cannot = "the station's `handle` of the device `" + name_ + "` cannot be used: ";
    if (fit.weight() > stated_->max_weight())
        return cannot + "its mass weighs " + in_newtons(fit.weight()) + ", need at most " +
               in_newtons(stated_->max_weight()) + ", half of the continuous force. Write at most `" +
               text::quantity_text(1e-3 * std::floor(1e3 * fit.mass * stated_->max_weight() / fit.weight()), "g") +
               "`.";
    if (const std::string fault = stated_->carry(fit.mass, fit.weight()); !fault.empty()) return cannot + fault + ".";
    facts_.peak_force = stated_->record().peak_force;
    facts_.continuous_force = stated_->record().continuous_force;
    facts_.mass = stated_->record().mass;
    handle_.emplace(fit, facts_.peak_torque);
    return {};
}

std::string OpenedDevice::add_pedal(std::unique_ptr<OpenedDevice> pedal) {
    const std::uint32_t all = facts_.button_count + pedal->facts().button_count;
    if (all > documents::max_buttons)
        return "the devices `" + name_ + "` and `" + pedal->name() + "` have " + std::to_string(all) +
               " buttons, need at most " + std::to_string(documents::max_buttons) + ". Leave out `pedal`.";
    own_buttons_ = std::exchange(facts_.button_count, all);
    pedal_ = std::move(pedal);
    return {};
}

std::string OpenedDevice::add_knob(std::unique_ptr<OpenedDevice> knob) {
    const kerf_device_facts& of_knob = knob->facts();
    if (!knob->is_knob())
        return "the device `" + knob->name() + "` is no knob: it senses more or less than a turn. Leave out `knob`.";
    if ((facts_.abilities & KERF_DEVICE_TORQUE) != 0)
        return "the device `" + name_ + "` makes all torques itself. Leave out `knob`.";
    if ((facts_.abilities & KERF_DEVICE_TURN) != 0)
        return "the device `" + name_ + "` has a knob of its own. Leave out `knob`.";
    if ((of_knob.abilities & KERF_DEVICE_TURN_TORQUE) != 0 && stated_ != nullptr)
        if (std::string fault = stated_->add_axis(of_knob); !fault.empty())
            return "the knob `" + knob->name() + "` cannot be used: " + fault + ".";
    facts_.abilities |= of_knob.abilities;
    facts_.peak_turn_torque = of_knob.peak_turn_torque;
    facts_.continuous_turn_torque = of_knob.continuous_turn_torque;
    facts_.turn_resolution = of_knob.turn_resolution;
    knob_ = std::move(knob);
    return {};
}

kerf_device_state OpenedDevice::read() noexcept {
    kerf_device_state state{};
    call_read(*driver_, device_, state);
    if (handle_) handle_->take(state);
    if (knob_ != nullptr) state.turn = turn_.take(knob_->read());
    if (pedal_ == nullptr || pedal_->facts().button_count == 0) return state;
    const kerf_device_state of_pedal = pedal_->read();
    state.buttons &= button_bits(own_buttons_);
    if ((of_pedal.flags & KERF_DEVICE_VALID) != 0) state.buttons |= of_pedal.buttons << own_buttons_;
    return state;
}

std::string OpenedDevice::problem() {
    char text[240] = {};
    call_problem(*driver_, device_, text);
    std::string own = text_in(text);
    if (own.empty() && knob_ != nullptr) own = knob_->problem();
    return own.empty() && pedal_ != nullptr ? pedal_->problem() : own;
}

std::vector<ListedDevice> find_devices(const PluginRegistry& plugins) {
    std::vector<ListedDevice> listed;
    for (const ComponentInfo& component : plugins.catalog()) {
        if (component.kind != KERF_KIND_DEVICE) continue;
        const std::vector<double> defaults = defaults_of(component);
        std::vector<kerf_device_found> found(max_found);
        const kerf_component& driver = *plugins.find(component.plugin, KERF_KIND_DEVICE, component.id);
        found.resize(std::min(call_find(driver, defaults.data(), found.data(), max_found), max_found));
        for (const kerf_device_found& one : found)
            listed.push_back({component.id, component.help, text_in(one.id), text_in(one.name), text_in(one.problem)});
        if (found.empty()) listed.push_back({component.id, component.help, "", "", ""});
    }
    return listed;
}

}  // namespace kerf::run
