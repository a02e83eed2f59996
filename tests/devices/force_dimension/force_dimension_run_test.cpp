// SPDX-License-Identifier: Apache-2.0
// An operation with a hand at an omega: through the driver and a stand-in for the maker's library.
#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "tests/devices/force_dimension/force_dimension_stand_in.h"
#include "tests/run/doubled_device.h"

namespace kerf::run {
namespace {

TEST(ForceDimensionRun, HasTheBitsOfADeviceWithoutALibrary) {
    force_dimension::ForceDimensionStandIn device;
    auto link = force_dimension::ForceDimensionStandIn::open();
    const kerf_device_facts facts = link->facts();
    const RunOutcome led = run_in_lock_step("pedicle-awl", hurried_awl, device, std::move(link));
    ASSERT_EQ(led.error, "");
    const RunOutcome direct = run_directly("pedicle-awl", hurried_awl, facts, device);
    EXPECT_EQ(direct.summary.ticks, 3000u);
    EXPECT_GT(direct.summary.removed, 0.0) << "the hand has felt bone";
    EXPECT_EQ(led.summary.hash, direct.summary.hash);
}

}  // namespace
}  // namespace kerf::run
