// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/law/body_threads.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "kerf/units.hpp"

namespace kerf {
namespace {

using namespace literals;

kerf_thread thread() {
    kerf_thread t{};
    t.tool_from_thread = identity_pose();
    t.lead = 2.5_mm;
    t.radius = 3.0_mm;
    t.core = 2.0_mm;
    t.to = 10.0_mm;
    t.slip_step = 1.0_mm;
    t.volume = 5e-9;
    t.number = KERF_NEW_THREAD;
    return t;
}

std::uint32_t seen(const BodyThreads& threads, std::array<ToolInBody, 1> near = {{{0, identity_pose()}}}) {
    std::array<kerf_thread, KERF_MAX_THREADS> out;
    return threads.write(near, out.data(), KERF_MAX_THREADS);
}

TEST(BodyThreads, StayWithTheirBodyWhereverTheToolIs) {
    BodyThreads threads;
    const Pose left_at{{1.0_mm, 0, -4.0_mm}, quat_from_rotation_vector({0.1, 0.2, 0.3})};
    const std::array<ToolInBody, 1> then{{{0, left_at}}};
    ASSERT_TRUE(threads.leave(thread(), then));
    const Pose later{{0, 3.0_mm, 2.0_mm}, quat_from_rotation_vector({0, 0, 1.0})};
    const std::array<ToolInBody, 1> now{{{0, later}}};
    kerf_thread found{};
    ASSERT_EQ(threads.write(now, &found, 1), 1u);
    const Vec3 in_body = later * (found.tool_from_thread * Vec3{0, 0, 1.0_mm});
    EXPECT_NEAR(length(in_body - left_at * Vec3{0, 0, 1.0_mm}), 0.0, 1e-15);
    EXPECT_EQ(found.number, 0u);
    EXPECT_EQ(seen(threads, {{{1, later}}}), 0u) << "near another body";
}

TEST(BodyThreads, ChangeUnderTheirNumber) {
    BodyThreads threads;
    const std::array<ToolInBody, 1> near{{{0, identity_pose()}}};
    ASSERT_TRUE(threads.leave(thread(), near));
    kerf_thread changed = thread();
    changed.number = 0;
    changed.to = 12.0_mm;
    ASSERT_TRUE(threads.leave(changed, near));
    EXPECT_EQ(threads.count(), 1u);
    EXPECT_EQ(threads.thread(0).to, 12.0_mm);
    changed.number = 1;
    EXPECT_FALSE(threads.leave(changed, near)) << "there is no such thread";
}

TEST(BodyThreads, AreSixteenAtMost) {
    BodyThreads threads;
    const std::array<ToolInBody, 1> near{{{0, identity_pose()}}};
    for (int i = 0; i < 16; ++i) EXPECT_TRUE(threads.leave(thread(), near));
    EXPECT_FALSE(threads.leave(thread(), near));
    EXPECT_EQ(threads.count(), 16u);
    kerf_thread one{};
    EXPECT_EQ(threads.write(near, &one, 1), 16u) << "how many there are, and no more is written than there is room";
    EXPECT_NEAR(threads.volume(), 16 * 5e-9, 1e-18);
}

TEST(BodyThreads, RefuseWhatIsUnsound) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto field = [](auto change) {
        kerf_thread t = thread();
        change(t);
        const char* found = fault_of(t);
        BodyThreads threads;
        const std::array<ToolInBody, 1> near{{{0, identity_pose()}}};
        EXPECT_EQ(threads.leave(t, near), found == nullptr);
        return std::string(found != nullptr ? found : "");
    };
    EXPECT_EQ(field([](kerf_thread&) {}), "");
    EXPECT_EQ(field([](kerf_thread& t) { t.lead = 0.0; }), "lead");
    EXPECT_EQ(field([&](kerf_thread& t) { t.radius = nan; }), "radius");
    EXPECT_EQ(field([](kerf_thread& t) { t.radius = t.core - 1.0_mm; }), "radius");
    EXPECT_EQ(field([](kerf_thread& t) { t.to = t.from - 1.0_mm; }), "to");
    EXPECT_EQ(field([](kerf_thread& t) { t.slip_step = 0.0; }), "slip_step");
    EXPECT_EQ(field([](kerf_thread& t) { t.slip[63] = -1e-6; }), "slip");
    EXPECT_EQ(field([&](kerf_thread& t) { t.tool_from_thread.position.z = nan; }), "tool_from_thread");
    EXPECT_EQ(field([](kerf_thread& t) { t.tool_from_thread.rotation = {2, 0, 0, 0}; }), "tool_from_thread");
}

TEST(BodyThreads, GoWithEachPartOfABodyAndCountOnce) {
    BodyThreads threads;
    const std::array<ToolInBody, 1> near{{{0, identity_pose()}}};
    ASSERT_TRUE(threads.leave(thread(), near));
    threads.inherit(0, 3);
    EXPECT_EQ(seen(threads), 1u);
    EXPECT_EQ(seen(threads, {{{3, identity_pose()}}}), 1u);
    EXPECT_EQ(threads.volume(), 5e-9);
}

}  // namespace
}  // namespace kerf
