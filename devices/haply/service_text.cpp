// SPDX-License-Identifier: Apache-2.0
#include "service_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace kerf::haply {

namespace {

using Json = nlohmann::json;

constexpr std::size_t max_devices = 16;  // of one kind
constexpr std::size_t max_id = 64;       // characters

const Json* child(const Json& of, const char* key) {
    if (!of.is_object()) return nullptr;
    const auto found = of.find(key);
    return found != of.end() ? &*found : nullptr;
}

bool flag(const Json* of, const char* key, bool otherwise) {
    const Json* const value = of != nullptr ? child(*of, key) : nullptr;
    return value != nullptr && value->is_boolean() ? value->get<bool>() : otherwise;
}

std::string text(const Json* of, const char* key) {
    const Json* const value = of != nullptr ? child(*of, key) : nullptr;
    return value != nullptr && value->is_string() ? value->get<std::string>().substr(0, max_id) : std::string();
}

/// Reads named numbers, in this order. Returns whether all are there.
template <std::size_t count>
bool read_numbers(const Json* of, const std::array<const char*, count>& keys, std::array<double, count>& values) {
    if (of == nullptr) return false;
    for (std::size_t i = 0; i < count; ++i) {
        const Json* const value = child(*of, keys[i]);
        if (value == nullptr || !value->is_number()) return false;
        values[i] = value->get<double>();
        if (!std::isfinite(values[i])) return false;
    }
    return true;
}

Vec3 to_device(double x, double y, double z) noexcept { return {x, z, -y}; }

std::optional<Vec3> read_vector(const Json* of) {
    std::array<double, 3> v{};
    if (!read_numbers(of, {"x", "y", "z"}, v)) return std::nullopt;
    return to_device(v[0], v[1], v[2]);
}

std::optional<Quat> read_rotation(const Json* of) {
    std::array<double, 4> q{};
    if (!read_numbers(of, {"w", "x", "y", "z"}, q)) return std::nullopt;
    const double norm = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (std::abs(norm - 1.0) > 0.01) return std::nullopt;
    const Vec3 axis = to_device(q[1], q[2], q[3]);
    const Quat read{q[0], axis.x, axis.y, axis.z};
    return std::abs(norm - 1.0) < 1e-9 ? read : normalized(read);
}

/// Calls `take(device)` for each device of a kind that has an id.
template <class Take>
void for_each_device(const Json& message, const char* kind, const Take& take) {
    const Json* const devices = child(message, kind);
    if (devices == nullptr || !devices->is_array()) return;
    for (std::size_t i = 0; i < std::min(devices->size(), max_devices); ++i)
        if (const Json& device = (*devices)[i]; !text(&device, "device_id").empty()) take(device);
}

Arm read_arm(const Json& device) {
    const Json* const state = child(device, "state");
    const Json* const status = child(device, "status");
    Arm arm;
    arm.id = text(&device, "device_id");
    arm.type = text(child(device, "config"), "type");
    if (state != nullptr) {
        arm.position = read_vector(child(*state, "cursor_position"));
        arm.force = read_vector(child(*state, "current_cursor_force"));
    }
    arm.is_calibrated = flag(status, "calibrated", true);
    arm.is_in_use = flag(status, "in_use", false);
    arm.is_ready = flag(status, "ready", true);
    arm.has_power = flag(status, "power_supply", true);
    return arm;
}

Grip read_grip(const Json& device) {
    const Json* const state = child(device, "state");
    Grip grip;
    grip.id = text(&device, "device_id");
    if (state == nullptr) return grip;
    grip.rotation = read_rotation(child(*state, "orientation"));
    const Json* const buttons = child(*state, "buttons");
    constexpr std::array names{"a", "b", "c"};
    for (std::size_t i = 0; i < names.size(); ++i)
        if (flag(buttons, names[i], false)) grip.buttons |= 1u << i;
    if (flag(state, "button", false)) grip.buttons |= 1u;
    return grip;
}

/// Adds a vector of the frame `device` as one of the service.
void put_vector(Json& into, Vec3 v) { into = {{"x", v.x}, {"y", -v.z}, {"z", v.y}}; }

Json command_for(std::string_view arm, ForceWord word, Vec3 force) {
    Json device{{"device_id", std::string(arm)}};
    put_vector(device["commands"]["set_cursor_force"][word == ForceWord::vector ? "vector" : "values"],
               is_finite(force) ? force : Vec3{});
    return device;
}

template <class T>
const T* find_by_id(const std::vector<T>& all, std::string_view id) noexcept {
    const auto found = std::find_if(all.begin(), all.end(), [&](const T& one) { return one.id == id; });
    return found != all.end() ? &*found : nullptr;
}

}  // namespace

std::string name_of_arm(std::string_view type, const std::string& id) {
    return (type == "minverse" ? "Minverse " : "Inverse3 ") + id;
}

const Arm* ServiceState::arm(std::string_view id) const noexcept { return find_by_id(arms, id); }
const Grip* ServiceState::grip(std::string_view id) const noexcept { return find_by_id(grips, id); }

std::optional<ServiceState> read_state(std::string_view text, std::string& fault) {
    if (text.size() > max_message) {
        fault = "it is longer than " + std::to_string(max_message / 1024) + " KiB";
        return std::nullopt;
    }
    const Json message = Json::parse(text, nullptr, false);
    if (!message.is_object()) {
        fault = "it is no JSON object";
        return std::nullopt;
    }
    ServiceState state;
    state.has_session = child(message, "session_id") != nullptr;
    for_each_device(message, "inverse3", [&](const Json& device) { state.arms.push_back(read_arm(device)); });
    for (const char* const kind : {"verse_grip", "wireless_verse_grip", "custom_verse_grip"})
        for_each_device(message, kind, [&](const Json& device) { state.grips.push_back(read_grip(device)); });
    const bool is_of_service = state.has_session || child(message, "inverse3") != nullptr || !state.grips.empty();
    if (!is_of_service) {
        fault = "it names neither a session nor a device";
        return std::nullopt;
    }
    return state;
}

std::string force_command(std::string_view arm, ForceWord word, Vec3 force) {
    return Json{{"inverse3", Json::array({command_for(arm, word, force)})}}.dump();
}

std::string first_command(std::string_view arm, ForceWord word, bool configures) {
    Json device = command_for(arm, word, {});
    if (configures)
        device["configure"] = {
            {"preset", {{"preset", "defaults"}}}, {"basis", {{"permutation", "XYZ"}}}, {"damping", {{"scalar", 0.0}}}};
    return Json{{"session", {{"configure", {{"profile", {{"name", "kerf"}}}}}}}, {"inverse3", Json::array({device})}}
        .dump();
}

std::optional<ServiceEvent> read_event(std::string_view text) {
    if (text.size() > max_message) return std::nullopt;
    const Json message = Json::parse(text, nullptr, false);
    ServiceEvent event;
    event.name = haply::text(&message, "name");
    if (event.name.empty()) return std::nullopt;
    const Json* const data = child(message, "data");
    event.device = haply::text(data, "device_id");
    event.safety = haply::text(data, "safety_type");
    return event;
}

std::string problem_of(const ServiceEvent& event) {
    struct Meaning {
        const char* name;
        const char* safety;
        const char* text;
    };
    static constexpr Meaning meanings[] = {
        {"device-busy", "",
         "another program drives the arm, and the service adds the forces of both. End that program, such as a demo of "
         "Haply Hub."},
        {"device-disconnected", "", "the arm or its grip is unplugged. Check cable and power."},
        {"device-sleep", "", "the grip sleeps. Press one of its buttons."},
        {"device-battery-critical", "", "the battery of the grip is empty. Charge it."},
        {"device-calibration-failed", "", "the calibration has failed. Put the grip into the inkwell again."},
        {"device-safety-triggered", "ebrake_triggered",
         "the arm's emergency brake is on, so it makes no force. Let go of it until its lamp is calm."},
        {"device-safety-triggered", "stall_detected", "a motor of the arm has stalled. Let go of the handle."},
        {"device-safety-triggered", "fod_stage_changed",
         "the arm has reduced its force, since it did not sense a hand. Hold the grip as its manual shows."},
        {"device-safety-triggered", "stability_ceiling",
         "the arm has reduced its force, since it began to oscillate. Grip it more firmly."},
    };
    for (const Meaning& meaning : meanings)
        if (event.name == meaning.name && (*meaning.safety == '\0' || event.safety == meaning.safety))
            return meaning.text;
    return {};
}

}  // namespace kerf::haply
