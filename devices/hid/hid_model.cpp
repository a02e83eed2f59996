// SPDX-License-Identifier: Apache-2.0
#include "devices/hid/hid_model.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

namespace kerf::hid {

namespace {

constexpr std::size_t max_serial = 40;  // characters

bool may_be_in_id(char c) noexcept {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
}

std::string id_of(const HidEntry& entry) {
    std::string id = entry.serial.substr(0, max_serial);
    std::replace_if(
        id.begin(), id.end(), [](char c) { return !may_be_in_id(c); }, '_');
    if (!id.empty()) return id;
    std::array<char, 16> text{};
    static_cast<void>(std::snprintf(text.data(), text.size(), "%04x-%04x", entry.vendor, entry.product));
    return text.data();
}

}  // namespace

std::vector<HidDevice> devices_of(const HidModel& model, const std::vector<HidEntry>& entries) {
    std::vector<HidDevice> devices;
    for (const HidEntry& entry : entries)
        if (model.is_one(entry) && std::none_of(devices.begin(), devices.end(),
                                                [&](const HidDevice& other) { return other.entry.path == entry.path; }))
            devices.push_back({.id = id_of(entry), .entry = entry});
    std::sort(devices.begin(), devices.end(), [](const HidDevice& a, const HidDevice& b) {
        return std::pair(a.entry.path.size(), a.entry.path) < std::pair(b.entry.path.size(), b.entry.path);
    });
    for (std::size_t i = 0; i < devices.size(); ++i) {
        int number = 1;
        for (std::size_t j = i + 1; j < devices.size(); ++j)
            if (devices[j].id == devices[i].id) devices[j].id += "." + std::to_string(++number);
    }
    return devices;
}

}  // namespace kerf::hid
