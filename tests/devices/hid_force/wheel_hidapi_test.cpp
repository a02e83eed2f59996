// SPDX-License-Identifier: Apache-2.0
// The driver over the real hidapi and hidraw's ioctls, with emulated firmware below umockdev. Run by umockdev-wrapper.
#include <dlfcn.h>
#include <glib-object.h>
#include <gtest/gtest.h>
#include <linux/hidraw.h>
#include <sys/ioctl.h>
#include <umockdev.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "devices/hid_force/hid_force.h"
#include "kerf/device_exchange.hpp"
#include "tests/devices/driver_rig.h"
#include "tests/devices/hid/made_system.h"
#include "tests/devices/hid_force/pid_emulator.h"

namespace kerf::hid_force {
namespace {

using namespace std::chrono_literals;
using test::has;
using test::is_valid;

std::string digits_of(const std::vector<std::uint8_t>& bytes) {
    std::string text;
    for (const std::uint8_t byte : bytes) {
        char two[3];
        static_cast<void>(std::snprintf(two, sizeof two, "%02x", static_cast<unsigned>(byte)));
        text += two;
    }
    return text;
}

/// Passes ioctls and writes of one node to emulated firmware, on a thread of its own.
class Firmwared {
public:
    explicit Firmwared(test::PidEmulator& device)
        : device_(&device), base_(umockdev_ioctl_base_new()), loop_(g_main_loop_new(nullptr, FALSE)) {
        g_signal_connect(base_, "handle-ioctl", G_CALLBACK(&Firmwared::take_ioctl), this);
        g_signal_connect(base_, "handle-write", G_CALLBACK(&Firmwared::take_write), this);
        thread_ = std::thread([this] { g_main_loop_run(loop_); });
    }
    ~Firmwared() {
        while (g_main_loop_is_running(loop_) == FALSE) std::this_thread::yield();
        g_main_loop_quit(loop_);
        thread_.join();
        g_main_loop_unref(loop_);
        g_object_unref(base_);
    }
    Firmwared(const Firmwared&) = delete;
    Firmwared& operator=(const Firmwared&) = delete;

    /// Lets the next write block.
    void block_write(double seconds) noexcept { block_.store(seconds, std::memory_order_relaxed); }
    [[nodiscard]] bool is_blocked() const noexcept { return is_blocked_.load(std::memory_order_relaxed); }

    void attach(UMockdevTestbed* testbed, const std::string& node) {
        GError* error = nullptr;
        umockdev_testbed_attach_ioctl(testbed, node.c_str(), base_, &error);
        ASSERT_EQ(error, nullptr) << error->message;
    }

private:
    static gboolean take_write(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client, Firmwared* self) {
        const std::vector<std::uint8_t> report = bytes_of(umockdev_ioctl_client_get_arg(client));
        if (const double seconds = self->block_.exchange(0.0, std::memory_order_relaxed); seconds > 0.0) {
            self->is_blocked_.store(true, std::memory_order_relaxed);
            std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
        }
        static_cast<void>(self->device_->take_output(report));
        umockdev_ioctl_client_complete(client, static_cast<glong>(report.size()), 0);
        return TRUE;
    }
    static gboolean take_ioctl(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client, Firmwared* self) {
        const gulong request = umockdev_ioctl_client_get_request(client);
        const std::vector<std::uint8_t>& descriptor = self->device_->firmware().descriptor;
        UMockdevIoctlData* const memory =
            umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, _IOC_SIZE(request), nullptr);
        std::vector<std::uint8_t> data = bytes_of(memory);
        constexpr unsigned descriptor_size = 1, descriptor_itself = 2, set_feature = 6, get_feature = 7;
        glong result = 0;
        switch (_IOC_NR(request)) {
            case descriptor_itself:
                std::copy(descriptor.begin(), descriptor.end(), data.begin() + 4);
                [[fallthrough]];
            case descriptor_size:
                data[0] = static_cast<std::uint8_t>(descriptor.size() & 0xff);
                data[1] = static_cast<std::uint8_t>(descriptor.size() >> 8);
                break;
            case set_feature:
                result = self->device_->take_feature(data) ? static_cast<glong>(data.size()) : -1;
                break;
            case get_feature:
                result = static_cast<glong>(self->device_->give_feature(data));
                if (result == 0) result = -1;
                break;
            default:
                result = -1;
        }
        umockdev_ioctl_data_update(memory, 0, data.data(), static_cast<int>(data.size()));
        g_object_unref(memory);
        umockdev_ioctl_client_complete(client, result, result < 0 ? EPIPE : 0);
        return TRUE;
    }

    static std::vector<std::uint8_t> bytes_of(UMockdevIoctlData* data) {
        guint8* bytes = nullptr;
        int count = 0;
        umockdev_ioctl_data_retrieve(data, &bytes, &count);
        std::vector<std::uint8_t> copy(bytes, bytes + count);
        g_free(bytes);
        return copy;
    }

    test::PidEmulator* device_;
    UMockdevIoctlBase* base_;
    GMainLoop* loop_;
    std::atomic<double> block_{0.0};  ///< [s]
    std::atomic<bool> is_blocked_{false};
    std::thread thread_;
};

struct Rig {
    test::MadeSystem system;
    test::PidEmulator device;
    Firmwared firmwared{device};

    explicit Rig(const test::Firmware& firmware) : device(firmware, &device_time) { plug_in(0); }
    void plug_in(int number) {
        system.add({"1209", "ffb0", "FFBoard", "W1", digits_of(device.firmware().descriptor)}, number);
        firmwared.attach(system.testbed(), "/dev/hidraw" + std::to_string(number));
    }
};

constexpr HidForce driver{
    .full_scale_torque = 2.0, .range = 2.0 * std::numbers::pi, .peak_torque = 1.0, .continuous_torque = 0.5};

bool comes(DeviceLink& link, double torque, const std::function<bool()>& is_so) {
    for (int i = 0; i < 10'000; ++i) {
        kerf_device_command command = command_at_rest();
        command.turn_torque = torque;
        link.write(command);
        if (is_so()) return true;
        std::this_thread::sleep_for(1ms);
    }
    return false;
}

TEST(HidForceOverHidapi, OutlivesTheUnloadingOfItsPlugin) {
    // Given a device whose driver is loaded as the host does it, with a write that blocks
    Rig rig(test::open_ffboard());
    void* const library = dlopen(KERF_TEST_HID_FORCE, RTLD_NOW | RTLD_LOCAL);
    ASSERT_NE(library, nullptr) << dlerror();
    const auto* const entry = static_cast<const kerf_entry*>(dlsym(library, KERF_ENTRY_SYMBOL));
    ASSERT_NE(entry, nullptr);
    const kerf_device& table = *entry->components[0].device;
    const double params[] = {2.0, 2.0 * std::numbers::pi, 1.0, 0.5};
    kerf_device_open_in in{};
    in.id = "";
    in.params = params;
    kerf_device_open_out out{};
    ASSERT_EQ(table.open(&in, nullptr, nullptr, &out), KERF_OK) << out.message;
    rig.firmwared.block_write(1.0);
    while (!rig.firmwared.is_blocked()) std::this_thread::sleep_for(1ms);

    // When it is closed and unloaded
    const double start = device_time();
    table.close(out.device);
    EXPECT_LT(device_time() - start, 0.2);
    dlclose(library);

    // Then its thread ends the effect when the write returns
    EXPECT_EQ(rig.device.blocks(), 1u);
    while (rig.device.blocks() > 0 && device_time() < start + 20.0) std::this_thread::sleep_for(1ms);
    EXPECT_EQ(rig.device.blocks(), 0u);
    std::this_thread::sleep_for(200ms);  // its thread ends in the code of the plugin
}

class OverHidapi : public testing::TestWithParam<test::Firmware (*)()> {};
INSTANTIATE_TEST_SUITE_P(HidForce, OverHidapi,
                         testing::Values(&test::open_ffboard, &test::two_axes, &test::sparse_knob));

TEST_P(OverHidapi, MakesATorqueAndClosesWithoutIt) {
    Rig rig(GetParam()());
    const auto found = driver.find();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found.front().id, "W1");
    EXPECT_EQ(found.front().name, "FFBoard, /dev/hidraw0");
    EXPECT_EQ(found.front().problem, "");
    auto link = test::open_device(driver);
    EXPECT_TRUE(comes(*link, 0.6, [&] { return std::abs(rig.device.torque() - 0.3) < 1e-3; })) << rig.device.torque();
    link.reset();
    EXPECT_EQ(rig.device.torque(), 0.0);
    EXPECT_EQ(rig.device.fault(), "");
    EXPECT_FALSE(rig.device.was_disabled());
}

TEST(HidForceOverHidapi, FollowsTheKnob) {
    Rig rig(test::sparse_knob());
    const auto link = test::open_device(driver);
    rig.system.send(0, {0x07, 0x00, 0x00, 0xf0});
    rig.system.send(0, {0x07, 0x00, 0x00, 0x10});
    EXPECT_TRUE(comes(*link, 0.0, [&] { return std::abs(link->read().turn - 0.25 * std::numbers::pi) < 1e-3; }))
        << link->read().turn;
}

TEST(HidForceOverHidapi, IsTakenOnce) {
    Rig rig(test::open_ffboard());
    const auto link = test::open_device(driver);
    EXPECT_TRUE(has(test::refusal_of_device(driver), "/dev/hidraw0 is in use by another program"));
}

TEST(HidForceOverHidapi, LosesAWheelAndFindsItAgain) {
    Rig rig(test::open_ffboard());
    const auto link = test::open_device(driver);
    ASSERT_TRUE(comes(*link, 1.0, [&] { return rig.device.torque() > 0.1; }));
    rig.device.lose_power();
    rig.system.unplug(0);
    EXPECT_TRUE(comes(*link, 1.0, [&] { return !is_valid(link->read()); }));
    rig.plug_in(1);
    EXPECT_TRUE(comes(*link, 1.0, [&] { return is_valid(link->read()) && rig.device.torque() > 0.4; }));
}

}  // namespace
}  // namespace kerf::hid_force
