// SPDX-License-Identifier: Apache-2.0
#include "devices/motion/modelled_handle.h"

#include <gtest/gtest.h>

#include "core/haptics/loop/device_record.h"
#include "core/haptics/loop/stated_device.h"

namespace kerf::motion {
namespace {

TEST(ModelledHandle, HasTheLimitsOfOmega6) {
    const kerf_device_facts facts = facts_of_handle("handle", 2);
    const DeviceRecord& omega = *find_device("omega.6");
    EXPECT_EQ(facts.peak_force, omega.peak_force);
    EXPECT_EQ(facts.continuous_force, omega.peak_force) << "ideal motors";
    EXPECT_EQ(facts.largest_stiffness, omega.largest_stiffness);
    EXPECT_EQ(facts.largest_damping, omega.largest_damping);
    EXPECT_EQ(facts.mass, omega.mass);
    EXPECT_EQ(facts.resolution, omega.resolution);
    EXPECT_EQ(fault_of_facts(facts), "");
}

}  // namespace
}  // namespace kerf::motion
