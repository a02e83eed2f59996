// SPDX-License-Identifier: Apache-2.0
#pragma once

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
#include <string>
#include <thread>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace kerf::test {

/// A HID device below the real hidapi: ids and descriptor in hexadecimal digits.
struct Made {
    std::string vendor, product, name, serial, descriptor;
};
inline std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

/// A system that only has the devices of a test.
class MadeSystem {
public:
    MadeSystem() : testbed_(umockdev_testbed_new()) {}
    ~MadeSystem() {
        g_object_unref(testbed_);
        if (kept_ >= 0) close(kept_);
    }
    MadeSystem(const MadeSystem&) = delete;
    MadeSystem& operator=(const MadeSystem&) = delete;

    void plug_in(const Made& made, int number) {
        add(made, number);
        answer_ioctls("/dev/hidraw" + std::to_string(number), made.descriptor);
    }
    /// Adds a device that cannot be opened before something answers its ioctls.
    void add(const Made& made, int number) {
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
    }
    /// Sends a report, and waits: two that are queued would come as one.
    void send(int number, const std::vector<std::uint8_t>& report) {
        const int fd = umockdev_testbed_get_dev_fd(testbed_, ("/dev/hidraw" + std::to_string(number)).c_str());
        ASSERT_EQ(write(fd, report.data(), report.size()), static_cast<ssize_t>(report.size()));
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    /// Unplugs a device. umockdev cannot give the number of its terminal to another one, so it stays in use.
    void unplug(int number) {
        const std::string node = "/dev/hidraw" + std::to_string(number);
        kept_ = ::open(node.c_str(), O_RDWR | O_CLOEXEC);
        close(umockdev_testbed_get_dev_fd(testbed_, node.c_str()));
        umockdev_testbed_remove_device(testbed_, syspath_.c_str());
    }

    [[nodiscard]] UMockdevTestbed* testbed() const noexcept { return testbed_; }

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
    const TemporaryFolder folder_;
    UMockdevTestbed* testbed_;
    std::string syspath_;
    int files_ = 0, kept_ = -1;
};

}  // namespace kerf::test
