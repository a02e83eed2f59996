// SPDX-License-Identifier: Apache-2.0
// The drivers over the real hidapi, with devices that umockdev makes up. Run by umockdev-wrapper.
#include <gtest/gtest.h>
#include <umockdev.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "devices/hid/hid_nodes.h"
#include "devices/hid/hid_transport.h"
#include "devices/pedal/pedal.h"
#include "devices/spacemouse/spacemouse.h"
#include "tests/devices/hid/made_system.h"

namespace kerf {
namespace {

using namespace std::chrono_literals;
using test::Made;
using System = test::MadeSystem;

/// The beginning of the descriptor of a SpaceNavigator, with its axes and buttons. Source:
/// github.com/AndunHH/spacemouse, SpaceNavigator.md.
constexpr const char* navigator_descriptor = "05010908a101a100850116a2fe265e013688fa467805550c651109300931093275109503"
                                             "8106c0a1008502093309340935751095038106c0a10285030501050919012902150025"
                                             "013500450175019502810295"
                                             "0e8103c0c0";
/// Three buttons of the application 0C:03, as the pedal has them.
constexpr const char* pedal_descriptor = "050c0903a1010509190129031500250175019503810295057501810195087501"
                                         "8101c0";

const Made navigator{"046d", "c626", "SpaceNavigator", "", navigator_descriptor};
const Made pedal_made{"05f3", "00ff", "VEC USB Footpedal", "", pedal_descriptor};

bool comes(DeviceLink& link, const std::function<bool(const kerf_device_state&)>& is_wanted) {
    for (int i = 0; i < 3000; ++i) {
        if (is_wanted(link.read())) return true;
        std::this_thread::sleep_for(1ms);
    }
    return false;
}

template <class Driver>
std::unique_ptr<DeviceLink> open(const Driver& driver) {
    kerf_device_open_in in{};
    in.id = "";
    return driver.open(DeviceRequest(in, nullptr, nullptr));
}

TEST(Hidapi, FindsAndReadsASpaceMouse) {
    System system;
    ASSERT_TRUE(umockdev_in_mock_environment()) << "run it by umockdev-wrapper";
    system.plug_in(navigator, 0);
    const auto found = spacemouse::SpaceMouse{}.find();
    ASSERT_EQ(found.size(), 1u) << "a nested collection is no device";
    EXPECT_EQ(found.front().id, "046d-c626");
    EXPECT_EQ(found.front().name, "SpaceNavigator, /dev/hidraw0");
    EXPECT_EQ(found.front().problem, "");
    EXPECT_TRUE(pedal::Pedal{}.find().empty());

    const auto link = open(spacemouse::SpaceMouse{});
    EXPECT_STREQ(link->facts().name, "SpaceNavigator");
    EXPECT_EQ(link->facts().abilities, std::uint32_t{KERF_DEVICE_DEFLECTION});
    EXPECT_EQ(link->read().flags, std::uint32_t{KERF_DEVICE_VALID});
    system.send(0, {1, 0x5e, 0x01, 0, 0, 0, 0});
    EXPECT_TRUE(comes(*link, [](const kerf_device_state& s) { return s.deflection[0] == 1.0; }));
    EXPECT_TRUE(comes(*link, [](const kerf_device_state& s) { return s.deflection[0] == 0.0; })) << "after 100 ms";
    system.send(0, {3, 1, 0});
    EXPECT_TRUE(comes(*link, [](const kerf_device_state& s) { return s.buttons == 1; }));
}

TEST(Hidapi, TakesADeviceOnce) {
    System system;
    system.plug_in(navigator, 0);
    const auto link = open(spacemouse::SpaceMouse{});
    const auto found = spacemouse::SpaceMouse{}.find();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NE(found.front().problem.find("in use"), std::string::npos) << found.front().problem;
}

TEST(Hidapi, ReadsAPedalNextToASpaceMouse) {
    System system;
    system.plug_in(navigator, 0);
    system.plug_in(pedal_made, 1);
    const auto link = open(pedal::Pedal{});
    system.send(1, {4, 0});
    EXPECT_TRUE(comes(*link, [](const kerf_device_state& s) { return s.buttons == 4; }));
    const auto nodes = hid::list_hid_nodes();
    ASSERT_EQ(nodes.size(), 2u);
    EXPECT_EQ(nodes[1].path, "/dev/hidraw1");
    EXPECT_EQ(nodes[1].device, "05f3:00ff VEC USB Footpedal");
    EXPECT_TRUE(nodes[1].is_allowed);
}

TEST(Hidapi, LosesASpaceMouseAndFindsItAgain) {
    System system;
    system.plug_in(navigator, 0);
    const auto link = open(spacemouse::SpaceMouse{});
    system.unplug(0);
    EXPECT_TRUE(comes(*link, [](const kerf_device_state& s) { return s.flags == 0; }));
    system.plug_in(navigator, 1);
    EXPECT_TRUE(comes(*link, [](const kerf_device_state& s) { return s.flags == KERF_DEVICE_VALID; }));
    system.send(1, {1, 0xa2, 0xfe, 0, 0, 0, 0});
    EXPECT_TRUE(comes(*link, [](const kerf_device_state& s) { return s.deflection[0] == -1.0; }));
}

}  // namespace
}  // namespace kerf
