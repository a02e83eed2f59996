// SPDX-License-Identifier: Apache-2.0
// The hand at a device on the haptic thread.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "core/haptics/loop/tick_result.h"
#include "run/device/device_hand.h"
#include "tests/support/loop_guard.h"

namespace kerf::run {
namespace {

/// Takes reports and sends commands for some ticks, in which the device is also lost.
void lead(DeviceHand& hand) {
    const TickResult result;
    for (std::uint64_t i = 0; i < 1000; ++i) {
        kerf_device_state state{};
        state.device_from_handle.rotation.w = 1.0;
        state.deflection[0] = std::sin(1e-2 * static_cast<double>(i));
        state.deflection[4] = 1.0;
        state.flags = i % 100 < 90 ? std::uint32_t{KERF_DEVICE_VALID} : 0u;
        static_cast<void>(hand.take(state, {}));
        static_cast<void>(hand.command(result, i));
    }
}

TEST(DeviceHandLoop, NeitherAllocatesNorLocks) {
    for (const std::uint32_t ability : {KERF_DEVICE_DEFLECTION, KERF_DEVICE_POSITION}) {
        kerf_device_facts facts{};
        facts.abilities = ability;
        DeviceHand hand({}, facts, identity_pose());
        const test::Forbidden before = test::forbidden_here();
        lead(hand);
        EXPECT_EQ(test::forbidden_here(), before) << ability;
    }
}

}  // namespace
}  // namespace kerf::run
