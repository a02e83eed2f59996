// SPDX-License-Identifier: Apache-2.0
#include "app/station_file.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "documents/read_station.h"
#include "session/recorder.h"
#include "text/write_file.h"

namespace kerf::app {

namespace {

std::string variable(const char* name) {
    const char* const value = std::getenv(name);
    return value != nullptr ? value : "";
}

}  // namespace

std::string station_file() {
    if (std::string file = variable("KERF_STATION"); !file.empty()) return file;
    if (const std::string folder = variable("XDG_CONFIG_HOME"); !folder.empty()) return folder + "/kerf/station.yaml";
    const std::string home = variable("HOME");
    return home.empty() ? "" : home + "/.config/kerf/station.yaml";
}

text::Result<documents::Station> read_own_station() {
    const std::string file = station_file();
    std::error_code error;
    if (file.empty() || !std::filesystem::exists(file, error)) return documents::Station{};
    return documents::read_station(file);
}

std::string write_station(const std::string& file, const std::string& device) {
    if (file.empty()) return "there is no configuration folder. Set HOME, or KERF_STATION to the name of the file.";
    std::error_code error;
    if (std::filesystem::exists(file, error)) return file + " exists. Change it, or remove it first.";
    std::filesystem::create_directories(std::filesystem::path(file).parent_path(), error);
    const std::string text =
        std::string("# ") + session::notice_line +
        "\n"
        "# The setup of the devices of this table. `kerf devices` lists the devices.\n"
        "apiVersion: kerf/v1\n"
        "kind: Station\n"
        "devices:\n"
        "  - device: " +
        device +
        "\n"
        "    # The directions of the patient in which the device's +x (right) and +y (up) lead: left, right,\n"
        "    # anterior, posterior, superior or inferior. These are the view from behind.\n"
        "    axes: {right: right, up: superior}\n"
        "    scale: 1  # motion of the tool per motion of the handle\n"
        "    # Instead of a scale: the box that the handle reaches, as `kerf devices test` prints it. The scale is "
        "then\n"
        "    # computed so that the operation fits into it:\n"
        "    # workspace: {from: -80 -60 -40 mm, to: 80 60 40 mm}\n"
        "    buttons: [drive, next, clutch, undo]\n"
        "    # Of a device without position and force, at full deflection, and what counts as rest:\n"
        "    # speed: 20 mm/s\n"
        "    # turn_speed: 30 deg/s\n"
        "    # dead_zone: 0.1\n"
        "    # A second device, whose buttons do what its own entry states:\n"
        "    # pedal: pedal\n"
        "    # A program on another machine needs its address, and a key that both machines have:\n"
        "    # peer: 192.168.1.7\n"
        "    # key_file: /home/user/kerf.key\n"
        "    # The drivers `replay` and `simulated_hand` play a motion that `kerf devices test ID --record FILE` "
        "wrote:\n"
        "    # motion: /home/user/motion.csv\n";
    return text::write_file(file, text);
}

}  // namespace kerf::app
