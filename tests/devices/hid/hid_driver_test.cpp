// SPDX-License-Identifier: Apache-2.0
#include "devices/hid/hid_driver.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "devices/hid/hid_nodes.h"
#include "devices/spacemouse/spacemouse.h"
#include "tests/devices/hid/scripted_transport.h"
#include "tests/support/loop_guard.h"

namespace kerf::hid {
namespace {

using test::HidTable;
using test::ScriptedTransport;
using test::space_navigator;

std::vector<std::string> ids_of(const std::vector<HidEntry>& entries) {
    std::vector<std::string> ids;
    for (const HidDevice& device : devices_of(spacemouse::model(), entries)) ids.push_back(device.id);
    return ids;
}

TEST(HidModel, ListsEachNodeOnce) {
    const HidEntry one = space_navigator("/dev/hidraw3", "A1");
    HidEntry nested = one;
    nested.usage = 0x3a;
    EXPECT_EQ(ids_of({nested, one, one, one}), std::vector<std::string>{"A1"});
}

TEST(HidModel, NamesDevicesWithoutASerialNumber) {
    EXPECT_EQ(ids_of({space_navigator("/dev/hidraw10"), space_navigator("/dev/hidraw9")}),
              (std::vector<std::string>{"046d-c626", "046d-c626.2"}));
    EXPECT_EQ(devices_of(spacemouse::model(), {space_navigator("/dev/hidraw10"), space_navigator("/dev/hidraw9")})
                  .front()
                  .entry.path,
              "/dev/hidraw9");
    EXPECT_EQ(ids_of({space_navigator("/dev/hidraw1", "a b/\xc3\xa4")}), std::vector<std::string>{"a_b___"});
}

std::string refusal_of(std::unique_ptr<HidTransport> transport, const char* id = "") {
    kerf_device_open_in in{};
    in.id = id;
    try {
        static_cast<void>(open_device(spacemouse::model(), std::move(transport), DeviceRequest(in, nullptr, nullptr)));
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return {};
}

TEST(HidDriver, ReportsALackOfHidapi) {
    const auto found = find_devices(spacemouse::model(), nullptr);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NE(found.front().problem.find("libhidapi-dev"), std::string::npos);
    EXPECT_EQ(refusal_of(nullptr), lacks_hidapi);
}

TEST(HidDriver, ReportsWhyADeviceCannotBeOpened) {
    HidTable table;
    const auto transport = [&] { return std::make_unique<ScriptedTransport>(table); };
    EXPECT_NE(refusal_of(transport()).find("no SpaceMouse is connected"), std::string::npos);
    table.plug_in(space_navigator("/dev/hidraw3", "A1"));
    EXPECT_NE(refusal_of(transport(), "B2").find("there is `A1`"), std::string::npos);
    table.refusal = refusal_of_node("/dev/hidraw3", EACCES);
    const auto found = find_devices(spacemouse::model(), transport().get());
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found.front().id, "A1");
    for (const char* part : {"/dev/hidraw3", "70-kerf.rules", "/etc/udev/rules.d", "udevadm trigger"})
        EXPECT_NE(found.front().problem.find(part), std::string::npos) << part;
    EXPECT_LT(found.front().problem.size(), sizeof kerf_device_found::problem);
    EXPECT_EQ(refusal_of(transport()), table.refusal);
}

TEST(HidDriver, ReadsAndWritesWithoutAllocationOrLock) {
    HidTable table;
    table.plug_in(space_navigator("/dev/hidraw3"));
    kerf_device_open_in in{};
    in.id = "";
    const auto link = open_device(spacemouse::model(), std::make_unique<ScriptedTransport>(table),
                                  DeviceRequest(in, nullptr, nullptr));
    const test::Forbidden before = test::forbidden_here();
    for (int i = 0; i < 1000; ++i) {
        static_cast<void>(link->read());
        link->write({});
    }
    EXPECT_EQ(test::forbidden_here(), before);
    EXPECT_EQ(link->read().flags, std::uint32_t{KERF_DEVICE_VALID});
}

}  // namespace
}  // namespace kerf::hid
