// SPDX-License-Identifier: Apache-2.0
// The drivers over the real hidapi, with devices that umockdev makes up. Run by umockdev-wrapper.
#include <fcntl.h>
#include <glib-object.h>
#include <gtest/gtest.h>
#include <umockdev.h>
#include <unistd.h>

#include <cctype>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "devices/hid/hid_nodes.h"
#include "devices/hid/hid_transport.h"
#include "devices/pedal/pedal.h"
#include "devices/spacemouse/spacemouse.h"
#include "tests/support/temporary_folder.h"

namespace kerf {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;

/// The beginning of the descriptor of a SpaceNavigator, with its axes and buttons. Source:
/// github.com/AndunHH/spacemouse, SpaceNavigator.md.
constexpr const char* navigator_descriptor = "05010908a101a100850116a2fe265e013688fa467805550c651109300931093275109503"
                                             "8106c0a1008502093309340935751095038106c0a10285030501050919012902150025"
                                             "013500450175019502810295"
                                             "0e8103c0c0";
/// Three buttons of the application 0C:03, as the pedal has them.
constexpr const char* pedal_descriptor = "050c0903a1010509190129031500250175019503810295057501810195087501"
                                         "8101c0";

struct Made {
    std::string vendor, product, name, serial, descriptor;
};
const Made navigator{"046d", "c626", "SpaceNavigator", "", navigator_descriptor};
const Made pedal_made{"05f3", "00ff", "VEC USB Footpedal", "", pedal_descriptor};

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

/// A system that only has the devices of a test.
class System {
public:
    System() : testbed_(umockdev_testbed_new()) {}
    ~System() {
        g_object_unref(testbed_);
        if (kept_ >= 0) close(kept_);
    }
    System(const System&) = delete;
    System& operator=(const System&) = delete;

    void plug_in(const Made& made, int number) {
        const std::string n = std::to_string(number), usb = "/devices/pci0000:00/0000:00:1d.0/usb1/1-" + n;
        const std::string device = "0003:" + upper(made.vendor) + ":" + upper(made.product) + ".000" + n;
        const std::string hid = usb + "/1-" + n + ":1.0/" + device;
        const std::string raw = hid + "/hidraw/hidraw" + n;
        const std::string text =
            "P: " + raw + "\nN: hidraw" + n + "\nE: DEVNAME=/dev/hidraw" + n +
            "\nE: SUBSYSTEM=hidraw\nA: dev=240:" + n + "\nL: device=../../../" + device + "\n\n" + "P: " + hid +
            "\nE: SUBSYSTEM=hid\nE: HID_ID=0003:0000" + upper(made.vendor) + ":0000" + upper(made.product) +
            "\nE: HID_NAME=" + made.name + "\nE: HID_UNIQ=" + made.serial +
            "\nH: report_descriptor=" + upper(made.descriptor) + "\n\n" + "P: " + usb + "/1-" + n +
            ":1.0\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_interface\nA: bInterfaceNumber=00\\n\n\n" + "P: " + usb +
            "\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nA: idVendor=" + made.vendor +
            "\\n\nA: idProduct=" + made.product + "\\n\nA: manufacturer=Maker\\n\nA: product=" + made.name +
            "\\n\nA: bcdDevice=0100\\n\n";
        GError* error = nullptr;
        umockdev_testbed_add_from_string(testbed_, text.c_str(), &error);
        ASSERT_EQ(error, nullptr) << error->message;
        syspath_ = "/sys" + raw;
        answer_ioctls("/dev/hidraw" + n, made.descriptor);
    }
    /// Sends a report, and waits: two that are queued would come as one.
    void send(int number, const Bytes& report) {
        const int fd = umockdev_testbed_get_dev_fd(testbed_, ("/dev/hidraw" + std::to_string(number)).c_str());
        ASSERT_EQ(write(fd, report.data(), report.size()), static_cast<ssize_t>(report.size()));
        std::this_thread::sleep_for(20ms);
    }
    /// Unplugs a device. umockdev cannot give the number of its terminal to another one, so it stays in use.
    void unplug(int number) {
        const std::string node = "/dev/hidraw" + std::to_string(number);
        kept_ = ::open(node.c_str(), O_RDWR | O_CLOEXEC);
        close(umockdev_testbed_get_dev_fd(testbed_, node.c_str()));
        umockdev_testbed_remove_device(testbed_, syspath_.c_str());
    }

private:
    void answer_ioctls(const std::string& node, const std::string& descriptor) {
        const std::size_t size = descriptor.size() / 2;
        char number[16];
        static_cast<void>(std::snprintf(number, sizeof number, "%02X%02X0000", static_cast<unsigned>(size & 0xff),
                                        static_cast<unsigned>(size >> 8)));
        const std::string file = folder_.path() + "/ioctls" + std::to_string(++files_);
        std::ofstream(file) << "@DEV " << node << "\nHIDIOCGRDESCSIZE 0 " << number << "\nHIDIOCGRDESC 0 " << number
                            << upper(descriptor) << std::string(2 * (4096 - size), '0') << "\n";
        GError* error = nullptr;
        umockdev_testbed_load_ioctl(testbed_, node.c_str(), file.c_str(), &error);
        ASSERT_EQ(error, nullptr) << error->message;
    }
    const test::TemporaryFolder folder_;
    UMockdevTestbed* testbed_;
    std::string syspath_;
    int files_ = 0, kept_ = -1;
};

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
