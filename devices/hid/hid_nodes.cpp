// SPDX-License-Identifier: Apache-2.0
#include "devices/hid/hid_nodes.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

namespace kerf::hid {

namespace {

constexpr const char* nodes_folder = "/sys/class/hidraw";

/// Returns the value of a key in a uevent file: lines `KEY=value`.
std::string value_in(const std::string& file, const std::string& key) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);)
        if (line.starts_with(key + "=")) return line.substr(key.size() + 1);
    return {};
}

/// Returns "046d:c626" of `0003:0000046D:0000C626`, which is bus, vendor and product.
std::string ids_of(const std::string& hid_id) {
    constexpr std::size_t full_size = 22, vendor_at = 9, product_at = 18, digits = 4;
    if (hid_id.size() != full_size) return "unknown";
    std::string ids = hid_id.substr(vendor_at, digits) + ":" + hid_id.substr(product_at, digits);
    for (char& c : ids)
        if (c >= 'A' && c <= 'F') c = static_cast<char>(c - 'A' + 'a');
    return ids;
}

std::string mode_of(const std::string& path) {
    struct stat about {};
    if (stat(path.c_str(), &about) != 0) return {};
    constexpr std::array<std::pair<mode_t, char>, 9> bits{{{S_IRUSR, 'r'},
                                                           {S_IWUSR, 'w'},
                                                           {S_IXUSR, 'x'},
                                                           {S_IRGRP, 'r'},
                                                           {S_IWGRP, 'w'},
                                                           {S_IXGRP, 'x'},
                                                           {S_IROTH, 'r'},
                                                           {S_IWOTH, 'w'},
                                                           {S_IXOTH, 'x'}}};
    std::string text(1, S_ISCHR(about.st_mode) ? 'c' : '-');
    for (const auto& [bit, letter] : bits) text += (about.st_mode & bit) != 0 ? letter : '-';
    return text;
}

}  // namespace

std::vector<HidNode> list_hid_nodes() {
    std::vector<HidNode> nodes;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(nodes_folder, error)) {
        const std::string uevent = entry.path().string() + "/device/uevent";
        const std::string path = "/dev/" + entry.path().filename().string();
        nodes.push_back({.path = path,
                         .device = ids_of(value_in(uevent, "HID_ID")) + " " + value_in(uevent, "HID_NAME"),
                         .mode = mode_of(path),
                         .is_allowed = access(path.c_str(), R_OK | W_OK) == 0});
    }
    std::sort(nodes.begin(), nodes.end(), [](const HidNode& a, const HidNode& b) {
        return std::pair(a.path.size(), a.path) < std::pair(b.path.size(), b.path);
    });
    return nodes;
}

std::string refusal_of_node(const std::string& path, int error) {
    if (error != EACCES && error != EPERM) return path + " cannot be opened: " + std::strerror(error) + ".";
    return path + ": permission denied. As root: `cp share/kerf/" + udev_rules_file +
           " /etc/udev/rules.d/ && udevadm control --reload && udevadm trigger`. Then plug the device in again.";
}

}  // namespace kerf::hid
