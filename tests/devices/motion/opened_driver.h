// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <memory>
#include <string>

#include "kerf/device_driver.hpp"

/// Drivers that play a motion, opened without a host.
namespace kerf::test {

/// Opens a driver's device with a file as `motion`; with an empty one, without settings.
template <class Driver>
std::unique_ptr<DeviceLink> open_with_motion(const std::string& file, const char* id = "") {
    const kerf_device_setting motion{"motion", file.c_str()};
    const kerf_device_open_in in{
        .id = id, .params = nullptr, .settings = &motion, .setting_count = file.empty() ? 0u : 1u, .reserved = 0};
    return Driver{}.open(DeviceRequest(in, nullptr, nullptr));
}

/// Returns why a driver opens no device.
template <class Driver>
std::string refusal_of(const std::string& file, const char* id = "") {
    try {
        static_cast<void>(open_with_motion<Driver>(file, id));
    } catch (const std::exception& e) {
        return e.what();
    }
    return "";
}

/// A command of a tick with a force [N].
inline kerf_device_command pushing(Vec3 force = {}) {
    kerf_device_command command{};
    command.force = force;
    command.device_from_tool.rotation.w = 1.0;
    command.flags = KERF_DEVICE_RUNNING | KERF_DEVICE_FORCE_ON;
    return command;
}

}  // namespace kerf::test
