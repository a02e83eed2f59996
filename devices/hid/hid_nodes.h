// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace kerf::hid {

/// A node of a HID device, and whether this user may open it.
struct HidNode {
    std::string path;         ///< "/dev/hidraw3"
    std::string device;       ///< bus, vendor, product and name: "046d:c626 3Dconnexion SpaceNavigator"
    std::string mode;         ///< as `ls -l` shows it: "crw-rw----"; empty: there is no such node
    bool is_allowed = false;  ///< this user may read and write it
};

/// Returns the nodes of all HID devices, in the order of their numbers. Needs no hidapi.   [main]
[[nodiscard]] std::vector<HidNode> list_hid_nodes();

/// Returns why a node cannot be opened, given `errno`, and what to do.   [any] pure
[[nodiscard]] std::string refusal_of_node(const std::string& path, int error);

/// The rules that let the user at the machine open the devices that Kerf knows.
inline constexpr const char* udev_rules_file = "70-kerf.rules";

}  // namespace kerf::hid
