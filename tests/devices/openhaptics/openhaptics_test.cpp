// SPDX-License-Identifier: Apache-2.0
// The driver against a stand-in for the maker's library, which is opened by the same path.
#include "devices/openhaptics/openhaptics.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/devices/driver_rig.h"
#include "tests/devices/openhaptics/double_hd.h"

namespace kerf::openhaptics {
namespace {

using namespace std::chrono_literals;
using Settings = test::DriverSettings;
using test::comes, test::has, test::is_valid;

const std::string of_new = KERF_BUILD_DIR "/doubles/hd_new", of_old = KERF_BUILD_DIR "/doubles/hd_old";
constexpr double wait = 0.2;  // [s]

std::unique_ptr<DeviceLink> open(const Settings& settings = {{"library", of_new}}, const char* id = "") {
    return test::open_device(OpenHaptics{wait}, settings, id);
}
std::string refusal_of(const Settings& settings, const char* id = "", bool is_cancelled = false) {
    return test::refusal_of_device(OpenHaptics{wait}, settings, id, is_cancelled);
}

/// The Touch of the stand-in, reset for each test.
class OpenHapticsDriver : public testing::Test {
protected:
    void SetUp() override {
        void* const library = dlopen((of_new + "/libHD.so.3.0").c_str(), RTLD_NOW | RTLD_NODELETE);
        ASSERT_NE(library, nullptr) << dlerror();
        set_ = reinterpret_cast<decltype(&double_hd_set)>(dlsym(library, "double_hd_set"));
        get_ = reinterpret_cast<decltype(&double_hd_get)>(dlsym(library, "double_hd_get"));
        set_pose_ = reinterpret_cast<decltype(&double_hd_set_pose)>(dlsym(library, "double_hd_set_pose"));
        force_ = reinterpret_cast<decltype(&double_hd_force)>(dlsym(library, "double_hd_force"));
        reinterpret_cast<decltype(&double_hd_reset)>(dlsym(library, "double_hd_reset"))();
    }
    void set(double_hd_value value, long to) const { set_(value, to); }
    [[nodiscard]] long get(double_hd_value value) const { return get_(value); }
    /// Turns the stylus by an angle about y and moves it [mm].
    void move(Vec3 to, double angle = 0.0, int buttons = 0) const {
        const double c = std::cos(angle), s = std::sin(angle);
        const double transform[16] = {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, to.x, to.y, to.z, 1};
        set_pose_(transform, buttons);
    }
    [[nodiscard]] Vec3 force() const {
        double now[3] = {};
        force_(now);
        return {now[0], now[1], now[2]};
    }

private:
    decltype(&double_hd_set) set_ = nullptr;
    decltype(&double_hd_get) get_ = nullptr;
    decltype(&double_hd_set_pose) set_pose_ = nullptr;
    decltype(&double_hd_force) force_ = nullptr;
};

TEST_F(OpenHapticsDriver, ExchangesPosesAndForces) {
    move({10, 20, 30}, 0.5, 5);
    const auto link = open();
    ASSERT_TRUE(comes(*link, {1, 2, -1}, [&](const auto& state) {
        return is_valid(state) && force() == Vec3{1, 2, -1};
    }));
    const kerf_device_state state = link->read();
    EXPECT_EQ(state.buttons, 5u);
    EXPECT_NEAR(length(state.device_from_handle.position - Vec3{0.01, 0.02, 0.03}), 0.0, 1e-15);
    EXPECT_NEAR(length(rotate(state.device_from_handle.rotation, {1, 0, 0}) - Vec3{std::cos(0.5), 0, -std::sin(0.5)}),
                0.0, 1e-12);
    EXPECT_EQ(link->problem(), "");
    EXPECT_EQ(get(double_hd_wrong_calls), 0);
}

TEST_F(OpenHapticsDriver, StatesTheLimitsOfTheDevice) {
    {
        const kerf_device_facts facts = open()->facts();
        EXPECT_STREQ(facts.name, "Touch (stand-in)");
        EXPECT_EQ(facts.abilities, std::uint32_t{KERF_DEVICE_POSITION | KERF_DEVICE_ROTATION | KERF_DEVICE_FORCE});
        EXPECT_EQ(facts.peak_force, 3.3);
        EXPECT_EQ(facts.continuous_force, 0.88);
        EXPECT_EQ(facts.largest_stiffness, 500.0);
        EXPECT_EQ(facts.largest_damping, 3.0);
    }
    set(double_hd_is_silent_of_facts, 1);
    EXPECT_EQ(open()->facts().largest_stiffness, 700.0) << "of a Touch";
}

TEST_F(OpenHapticsDriver, SendsNoForceThatTheLoopHasNotRenewed) {
    const auto link = open();
    ASSERT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return force() == Vec3{1, 0, 0}; }));
    for (int i = 0; i < 5000 && force() != Vec3{}; ++i) std::this_thread::sleep_for(1ms);
    EXPECT_EQ(length(force()), 0.0) << "the loop is silent";
    const long frames = get(double_hd_frames);
    for (int i = 0; i < 5000 && get(double_hd_frames) < frames + 50; ++i) std::this_thread::sleep_for(1ms);
    EXPECT_GE(get(double_hd_frames), frames + 50) << "but the servo runs on";
}

TEST_F(OpenHapticsDriver, SendsAZeroForceWhenItIsClosed) {
    auto link = open();
    ASSERT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return force() == Vec3{1, 0, 0}; }));
    link.reset();
    EXPECT_EQ(length(force()), 0.0);
    EXPECT_EQ(get(double_hd_is_scheduled), 0);
    EXPECT_EQ(get(double_hd_is_running), 0);
}

TEST_F(OpenHapticsDriver, ClampsForcesToThePeak) {
    const auto link = open();
    ASSERT_TRUE(comes(*link, {0, 100, 0}, [&](const auto&) { return std::abs(force().y - 3.3) < 1e-12; }));
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(comes(*link, {nan, 0, 0}, [&](const auto&) { return force() == Vec3{}; }));
    EXPECT_EQ(link->problem(), "");
}

TEST_F(OpenHapticsDriver, LosesADeviceAndTakesItBack) {
    const auto link = open();
    ASSERT_TRUE(comes(*link, {1, 0, 0}, is_valid));
    const std::uint64_t reports = link->read().reports;
    set(double_hd_is_plugged, 0);
    ASSERT_TRUE(comes(*link, {1, 0, 0}, [](const auto& state) { return !is_valid(state); }));
    EXPECT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) {
        return has(link->problem(), "communication") && has(link->problem(), "cable");
    })) << link->problem();
    std::this_thread::sleep_for(50ms);
    EXPECT_FALSE(is_valid(link->read()));
    set(double_hd_is_plugged, 1);
    ASSERT_TRUE(comes(*link, {1, 0, 0}, is_valid));
    EXPECT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return force() == Vec3{1, 0, 0}; }));
    EXPECT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return link->problem().empty(); })) << link->problem();
    EXPECT_GE(link->read().reports, reports);
    EXPECT_EQ(get(double_hd_wrong_calls), 0) << "no device is initialised while the scheduler runs";
}

TEST_F(OpenHapticsDriver, MakesNoForceWhileAPoseCannotBe) {
    const auto link = open();
    ASSERT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return force() == Vec3{1, 0, 0}; }));
    move({std::nan(""), 0, 0});
    ASSERT_TRUE(comes(*link, {1, 0, 0}, [&](const auto& state) { return !is_valid(state) && force() == Vec3{}; }));
    EXPECT_TRUE(has(link->problem(), "a pose that is none")) << link->problem();
    move({0, 0, 0});
    ASSERT_TRUE(comes(*link, {1, 0, 0}, is_valid));
    double y = 0.0;
    EXPECT_TRUE(comes(*link, {1, 0, 0}, [&](const auto& state) {
        move({0, y = 100.0 - y, 0});  // 10 cm in a millisecond
        return !is_valid(state) && has(link->problem(), "jumped");
    })) << link->problem();
    EXPECT_TRUE(comes(*link, {1, 0, 0}, is_valid)) << "it continues from there";
}

TEST_F(OpenHapticsDriver, NoticesAFrozenPosition) {
    const auto link = open();
    ASSERT_TRUE(comes(*link, {1, 0, 0}, is_valid));
    double angle = 0.0;
    ASSERT_TRUE(comes(*link, {1, 0, 0}, [&](const auto& state) {
        move({0, 0, 0}, angle += 1e-3);
        return !is_valid(state);
    }));
    EXPECT_TRUE(has(link->problem(), "inkwell") && has(link->problem(), "not calibrated")) << link->problem();
    double x = 0.0;
    EXPECT_TRUE(comes(*link, {1, 0, 0}, [&](const auto& state) {
        move({x += 0.01, 0, 0}, angle += 1e-3);
        return is_valid(state);
    }));
    for (int i = 0; i < 500; ++i) {
        move({x += 0.01, 0, 0}, angle += 1e-3);
        link->write({});
        ASSERT_TRUE(is_valid(link->read())) << "a hand that moves and turns is no fault";
        std::this_thread::sleep_for(1ms);
    }
}

TEST_F(OpenHapticsDriver, BelievesNoPoseOfTheFirstPeriods) {
    for (int i = 0; i < 5; ++i) {
        const auto link = open();
        const kerf_device_state state = link->read();
        EXPECT_TRUE(is_valid(state));
        EXPECT_EQ(length(state.device_from_handle.position), 0.0) << "libHD begins with a pose that is made up";
    }
}

TEST_F(OpenHapticsDriver, WaitsForTheInkwell) {
    set(double_hd_calibration, 0x5002);
    const std::string refusal = refusal_of({{"library", of_new}});
    EXPECT_TRUE(has(refusal, "Put the stylus into the inkwell")) << refusal;
    EXPECT_TRUE(has(refusal_of({{"library", of_new}}, "", true), "interrupted"));
    EXPECT_EQ(get(double_hd_is_running), 0) << "a refusal leaves no scheduler";
    set(double_hd_calibration, 0x5001);
    const auto link = open();
    EXPECT_EQ(get(double_hd_updates), 1);
    ASSERT_TRUE(comes(*link, {1, 0, 0}, is_valid));
    set(double_hd_calibration, 0x5002);
    ASSERT_TRUE(comes(*link, {1, 0, 0}, [&](const auto& state) { return !is_valid(state) && force() == Vec3{}; }));
    EXPECT_TRUE(has(link->problem(), "inkwell")) << link->problem();
}

TEST_F(OpenHapticsDriver, NamesWarmMotors) {
    const auto link = open();
    ASSERT_TRUE(comes(*link, {1, 0, 0}, is_valid));
    set(double_hd_error, 0x200);
    EXPECT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return has(link->problem(), "too warm"); }));
    EXPECT_TRUE(is_valid(link->read())) << "it still reports its pose";
    EXPECT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return link->problem().empty(); })) << "within a second";
}

TEST_F(OpenHapticsDriver, NoticesAServoThatStops) {
    const auto link = open();
    ASSERT_TRUE(comes(*link, {1, 0, 0}, is_valid));
    set(double_hd_is_stalled, 1);
    EXPECT_TRUE(comes(*link, {1, 0, 0}, [&](const auto& state) { return state.age > 0.15; }));
    EXPECT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return has(link->problem(), "stopped calling"); }));
}

TEST_F(OpenHapticsDriver, TriesTheNamesOfADefaultDevice) {
    set(double_hd_accepted_name, 1);
    EXPECT_NE(open(), nullptr) << "Default PHANToM";
    set(double_hd_accepted_name, 2);
    const std::string refusal = refusal_of({{"library", of_new}});
    EXPECT_TRUE(has(refusal, "the default, `Default Device`, `Default PHANToM`: ") && has(refusal, "setup program"))
        << refusal;
    EXPECT_NE(open({{"library", of_new}, {"device_name", "my touch"}}), nullptr);
}

TEST_F(OpenHapticsDriver, FreesADeviceThatACrashLeftInUse) {
    set(double_hd_refusals, 9);
    EXPECT_NE(open(), nullptr);
    set(double_hd_refusals, 1000);
    EXPECT_TRUE(has(refusal_of({{"library", of_new}}), "already in use"));
}

TEST_F(OpenHapticsDriver, RefusesWithTheReason) {
    EXPECT_TRUE(has(refusal_of({{"library", "/nonexistent/libHD.so"}}), "/nonexistent/libHD.so"));
    const std::string old = refusal_of({{"library", of_old}});
    EXPECT_TRUE(has(old, "`hdUpdateCalibration`") && has(old, "another version")) << old;
    EXPECT_TRUE(has(refusal_of({{"library", of_new}}, "99"), "there is `T_0815`"));
    EXPECT_TRUE(has(refusal_of({{"libary", of_new}}), "`libary`"));
    set(double_hd_is_plugged, 0);
    EXPECT_TRUE(has(refusal_of({{"library", of_new}}), "0x302, internal -28"));
    set(double_hd_is_plugged, 1);
    const auto link = open();
    EXPECT_TRUE(has(refusal_of({{"library", of_new}}), "open already"));
}

TEST_F(OpenHapticsDriver, FindsADeviceByTheVariable) {
    EXPECT_TRUE(OpenHaptics{wait}.find().empty()) << "without the library there is no device, and no message";
    setenv("OH_SDK_BASE", of_new.c_str(), 1);
    const std::vector<DeviceFound> found = OpenHaptics{wait}.find();
    set(double_hd_is_plugged, 0);
    const std::vector<DeviceFound> unplugged = OpenHaptics{wait}.find();
    unsetenv("OH_SDK_BASE");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].id, "T_0815");
    EXPECT_EQ(found[0].problem, "");
    ASSERT_EQ(unplugged.size(), 1u);
    EXPECT_TRUE(has(unplugged[0].problem, "communication")) << unplugged[0].problem;
}

}  // namespace
}  // namespace kerf::openhaptics
