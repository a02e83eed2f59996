// SPDX-License-Identifier: Apache-2.0
// The driver against a stand-in for the maker's library, which is opened by the same path.
#include "devices/force_dimension/force_dimension.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "devices/force_dimension/dhd.h"
#include "tests/devices/driver_rig.h"
#include "tests/devices/force_dimension/double_dhd.h"

namespace kerf::force_dimension {
namespace {

using namespace std::chrono_literals;
using Settings = test::DriverSettings;
using test::comes, test::has, test::is_valid;

const std::string of_new = KERF_BUILD_DIR "/doubles/dhd_new", of_old = KERF_BUILD_DIR "/doubles/dhd_old";

std::unique_ptr<DeviceLink> open(const Settings& settings = {{"library", of_new}}) {
    return test::open_device(ForceDimension{}, settings);
}
std::string refusal_of(const Settings& settings, const char* id = "") {
    return test::refusal_of_device(ForceDimension{}, settings, id);
}

/// The base of the stand-in, reset for each test.
class ForceDimensionDriver : public testing::Test {
protected:
    void SetUp() override {
        void* const library = dlopen((of_new + "/libdrd.so.3").c_str(), RTLD_NOW | RTLD_NODELETE);
        ASSERT_NE(library, nullptr) << dlerror();
        set_ = reinterpret_cast<decltype(&double_dhd_set)>(dlsym(library, "double_dhd_set"));
        get_ = reinterpret_cast<decltype(&double_dhd_get)>(dlsym(library, "double_dhd_get"));
        double_dhd_state fresh{};
        for (int i = 0; i < 3; ++i) fresh.rotation[i][i] = 1.0;
        fresh.is_plugged = fresh.is_initialized = fresh.has_watchdog = 1;
        fresh.system_type = 34;
        set_(&fresh);
    }
    [[nodiscard]] double_dhd_state base() const {
        double_dhd_state state{};
        get_(&state);
        return state;
    }
    void change(const std::function<void(double_dhd_state&)>& how) const {
        double_dhd_state state = base();
        how(state);
        set_(&state);
    }
    [[nodiscard]] Vec3 force() const {
        const double_dhd_state now = base();
        return {now.force[0], now.force[1], now.force[2]};
    }

private:
    decltype(&double_dhd_set) set_ = nullptr;
    decltype(&double_dhd_get) get_ = nullptr;
};

TEST_F(ForceDimensionDriver, ExchangesPosesAndForces) {
    const auto link = open();
    EXPECT_STREQ(link->facts().name, "omega.6 4711");
    EXPECT_EQ(link->facts().abilities, std::uint32_t{KERF_DEVICE_POSITION | KERF_DEVICE_ROTATION | KERF_DEVICE_FORCE});
    EXPECT_EQ(link->facts().peak_force, 12.0);
    EXPECT_EQ(base().watchdog_steps, 160) << "20 ms";
    EXPECT_EQ(base().is_force_on, 1);
    change([](auto& state) {
        state.position[0] = 0.01, state.position[1] = 0.02, state.position[2] = 0.03;
        state.buttons = 5;
        // A quarter turn about the maker's z axis, up: its x axis, towards the user, goes to its y axis, right.
        const double turn[3][3] = {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) state.rotation[i][j] = turn[i][j];
    });
    ASSERT_TRUE(comes(*link, {1, 2, 3}, [&](const auto& state) {
        return state.buttons == 5u && force() == Vec3{3, 1, 2};
    }));
    const kerf_device_state state = link->read();
    EXPECT_EQ(length(state.device_from_handle.position - Vec3{0.02, 0.03, 0.01}), 0.0) << "right, up, towards the user";
    EXPECT_NEAR(length(rotate(state.device_from_handle.rotation, {0, 0, 1}) - Vec3{1, 0, 0}), 0.0, 1e-12);
    EXPECT_NEAR(length(rotate(state.device_from_handle.rotation, {0, 1, 0}) - Vec3{0, 1, 0}), 0.0, 1e-12);
    EXPECT_EQ(link->problem(), "");
}

TEST_F(ForceDimensionDriver, SendsNoForceThatTheLoopHasNotRenewed) {
    const auto link = open();
    ASSERT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return force() == Vec3{0, 1, 0}; }));
    for (int i = 0; i < 5000 && force() != Vec3{}; ++i) std::this_thread::sleep_for(1ms);
    EXPECT_EQ(length(force()), 0.0) << "the loop is silent";
    const long calls = base().calls;
    for (int i = 0; i < 5000 && base().calls < calls + 50; ++i) std::this_thread::sleep_for(1ms);
    EXPECT_GE(base().calls, calls + 50) << "but the driver still sends";
}

TEST_F(ForceDimensionDriver, SendsAZeroForceWhenItIsClosed) {
    auto link = open();
    ASSERT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return force() == Vec3{0, 1, 0}; }));
    link.reset();
    change([](auto& state) { state.has_watchdog = 1; });
    EXPECT_EQ(length(force()), 0.0);
}

TEST_F(ForceDimensionDriver, LosesABaseAndTakesItBack) {
    const auto link = open();
    ASSERT_TRUE(comes(*link, {1, 0, 0}, is_valid));
    change([](auto& state) { state.is_plugged = 0; });
    ASSERT_TRUE(comes(*link, {1, 0, 0}, [](const auto& state) { return !is_valid(state); }));
    EXPECT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return has(link->problem(), "USB cable"); }))
        << link->problem();
    change([](auto& state) { state.is_plugged = 1; });
    ASSERT_TRUE(comes(*link, {1, 0, 0}, is_valid));
    EXPECT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return force() == Vec3{0, 1, 0}; }));
    EXPECT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return link->problem().empty(); })) << link->problem();
}

TEST_F(ForceDimensionDriver, MakesNoForceWhileAPoseCannotBe) {
    const auto link = open();
    ASSERT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return force() == Vec3{0, 1, 0}; }));
    change([](auto& state) { state.is_no_number = 1; });
    ASSERT_TRUE(comes(*link, {1, 0, 0}, [&](const auto& state) { return !is_valid(state) && force() == Vec3{}; }));
    EXPECT_TRUE(comes(*link, {1, 0, 0}, [&](const auto&) { return has(link->problem(), "a pose that is none"); }));
    change([](auto& state) { state.is_no_number = 0; });
    ASSERT_TRUE(comes(*link, {1, 0, 0}, is_valid));
    change([](auto& state) { state.position[1] = 0.1; });
    ASSERT_TRUE(comes(*link, {1, 0, 0}, [](const auto& state) { return !is_valid(state); }))
        << "10 cm in half a millisecond";
    EXPECT_TRUE(comes(*link, {1, 0, 0}, is_valid)) << "it goes on from there";
}

TEST_F(ForceDimensionDriver, NamesWhyForcesAreOff) {
    const auto link = open();
    for (const auto& [state, word] : {std::pair{1, "force button"}, {2, "too fast"}, {3, "in time"}, {6, "dead man"}}) {
        change([&, off = state](auto& base) { base.force_off = off; });
        EXPECT_TRUE(comes(*link, {}, [&, what = word](const auto&) { return has(link->problem(), what); }))
            << link->problem();
    }
}

TEST_F(ForceDimensionDriver, MovesTheArmOnlyWithLeave) {
    change([](auto& state) { state.is_initialized = 0; });
    const std::string refusal = refusal_of({{"library", of_new}});
    EXPECT_TRUE(has(refusal, "may_move: yes") && has(refusal, "moves by itself")) << refusal;
    EXPECT_EQ(base().moves, 0);
    EXPECT_TRUE(has(refusal_of({{"library", of_new}, {"may_move", "perhaps"}}), "yes or no"));
    const int before = base().moves;
    const auto link = open({{"library", of_new}, {"may_move", "yes"}});
    EXPECT_EQ(base().moves, before + 1);
}

TEST_F(ForceDimensionDriver, RefusesWithTheReason) {
    EXPECT_TRUE(has(refusal_of({{"library", "/nonexistent/libdrd.so.3"}}), "/nonexistent/libdrd.so.3"));
    const std::string old = refusal_of({{"library", of_old}});
    EXPECT_TRUE(has(old, "`dhdGetWatchdog`") && has(old, "another version")) << old;
    EXPECT_TRUE(has(refusal_of({{"library", KERF_SOURCE_DIR "/README.md"}}), "README.md"));
    EXPECT_TRUE(has(refusal_of({{"library", of_new}}, "99"), "there is `4711`"));
    EXPECT_TRUE(has(refusal_of({{"libary", of_new}}), "`libary`"));
    change([](auto& state) { state.is_in_use = 1; });
    EXPECT_TRUE(has(refusal_of({{"library", of_new}}), "already in use"));
    change([](auto& state) { state.is_plugged = 0; });
    EXPECT_TRUE(has(refusal_of({{"library", of_new}}), "no device of Force Dimension"));
}

TEST_F(ForceDimensionDriver, StatesWhatABaseLacks) {
    change([](auto& state) { state.has_watchdog = 0, state.system_type = 60; });
    const auto falcon = open();
    EXPECT_STREQ(falcon->facts().name, "Falcon 4711 (no watchdog)");
    EXPECT_EQ(falcon->facts().abilities & KERF_DEVICE_ROTATION, 0u);
    EXPECT_EQ(model_of(33).peak_force, 12.0);
    EXPECT_FALSE(model_of(999).is_known);
    EXPECT_EQ(model_of(999).peak_force, 8.0) << "the weakest";
}

TEST_F(ForceDimensionDriver, FindsBasesByTheVariable) {
    EXPECT_TRUE(ForceDimension{}.find().empty()) << "without the library there is no device, and no message";
    setenv("FORCEDIM_SDK", of_new.c_str(), 1);
    const std::vector<DeviceFound> found = ForceDimension{}.find();
    unsetenv("FORCEDIM_SDK");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].id, "4711");
}

TEST(ForceDimensionRotation, RefusesAMatrixThatTurnsNothing) {
    const double none[3][3] = {}, mirrored[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
                 odd[3][3] = {{std::nan(""), 0, 0}, {0, 1, 0}, {0, 0, 1}};
    EXPECT_FALSE(rotation_of(none));
    EXPECT_FALSE(rotation_of(mirrored));
    EXPECT_FALSE(rotation_of(odd));
    for (const Vec3 r : {Vec3{3.1, 0.2, 0.1}, {0.1, 3.1, 0.2}, {0.2, 0.1, 3.1}, {0.3, -0.4, 0.5}, {0, 0, 0}}) {
        const Quat q = quat_from_rotation_vector(r);
        double rows[3][3] = {};
        const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (int column = 0; column < 3; ++column) {
            const Vec3 image = to_maker(rotate(q, to_device(axes[column])));
            rows[0][column] = image.x, rows[1][column] = image.y, rows[2][column] = image.z;
        }
        const auto read = rotation_of(rows);
        ASSERT_TRUE(read);
        EXPECT_NEAR(std::abs(read->w * q.w + read->x * q.x + read->y * q.y + read->z * q.z), 1.0, 1e-12);
    }
}

}  // namespace
}  // namespace kerf::force_dimension
