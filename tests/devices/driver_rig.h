// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "kerf/device_driver.hpp"

/// A driver as the host calls it, without the host.
namespace kerf::test {

using DriverSettings = std::vector<std::pair<std::string, std::string>>;

/// Opens a device. Throws what the driver throws.
/// @param is_cancelled  the user no longer waits
template <class Driver>
std::unique_ptr<DeviceLink> open_device(const Driver& driver, const DriverSettings& settings = {}, const char* id = "",
                                        bool is_cancelled = false) {
    std::vector<kerf_device_setting> texts;
    for (const auto& [key, value] : settings) texts.push_back({key.c_str(), value.c_str()});
    kerf_device_open_in in{};
    in.id = id;
    in.settings = texts.data();
    in.setting_count = static_cast<std::uint32_t>(texts.size());
    const auto ends = [](void* flag) { return *static_cast<bool*>(flag) ? std::int32_t{1} : std::int32_t{0}; };
    return driver.open(DeviceRequest(in, ends, &is_cancelled));
}

/// Returns why a device cannot be opened; empty if it can.
template <class Driver>
std::string refusal_of_device(const Driver& driver, const DriverSettings& settings = {}, const char* id = "",
                              bool is_cancelled = false) {
    try {
        static_cast<void>(open_device(driver, settings, id, is_cancelled));
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return {};
}

inline bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }
inline bool is_valid(const kerf_device_state& state) { return (state.flags & KERF_DEVICE_VALID) != 0; }

/// Writes a force each millisecond until a condition is true, at most 20 s. Returns whether it became true.
inline bool comes(DeviceLink& link, Vec3 force, const std::function<bool(const kerf_device_state&)>& is_wanted) {
    for (int i = 0; i < 20'000; ++i) {
        kerf_device_command command{};
        command.force = force;
        command.device_from_tool.rotation.w = 1.0;
        link.write(command);
        if (is_wanted(link.read())) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

}  // namespace kerf::test
