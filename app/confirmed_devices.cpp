// SPDX-License-Identifier: Apache-2.0
#include "app/confirmed_devices.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <vector>

#include "app/station_file.h"
#include "session/recorder.h"
#include "text/write_file.h"

namespace kerf::app {

namespace {

constexpr std::size_t max_devices = 200;  // the oldest are forgotten

/// Returns the file; empty: there is no folder for it.
std::string file_of_confirmed() {
    const std::string station = station_file();
    if (station.empty()) return "";
    return (std::filesystem::path(station).parent_path() / "confirmed-devices").string();
}

std::vector<std::string> confirmed() {
    std::vector<std::string> devices;
    std::error_code none;
    const std::string file = file_of_confirmed();
    if (file.empty() || !std::filesystem::is_regular_file(file, none)) return devices;  // no FIFO
    std::ifstream in(file);
    for (std::string line; devices.size() < max_devices && std::getline(in, line);)
        if (!line.empty() && line.front() != '#') devices.push_back(line);
    return devices;
}

}  // namespace

bool is_confirmed(const std::string& device) {
    const std::vector<std::string> devices = confirmed();
    return std::find(devices.begin(), devices.end(), device) != devices.end();
}

std::string confirm(const std::string& device) {
    const std::string file = file_of_confirmed();
    if (file.empty()) return "there is no configuration folder. Set HOME, or KERF_STATION to the name of the file.";
    if (is_confirmed(device)) return "";
    std::vector<std::string> devices = confirmed();
    if (devices.size() == max_devices) devices.erase(devices.begin());
    devices.push_back(device);
    std::string text = std::string("# ") + session::notice_line +
                       "\n# Devices whose force a person has confirmed (`kerf devices test DEVICE --force`).\n";
    for (const std::string& one : devices) text += one + "\n";
    std::error_code error;
    std::filesystem::create_directories(std::filesystem::path(file).parent_path(), error);
    return text::write_file(file, text);
}

}  // namespace kerf::app
