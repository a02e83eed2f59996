// SPDX-License-Identifier: Apache-2.0
// Operations with a hand at an Inverse3: through the driver, WebSockets and a stand-in for the maker's service.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/devices/haply/haply_stand_in.h"
#include "tests/run/doubled_device.h"
#include "tests/support/temporary_folder.h"

namespace kerf::run {
namespace {

TEST(HaplyRun, HasTheBitsOfADeviceWithoutAService) {
    haply::HaplyStandIn device;
    expect_the_bits_of_no_driver(device, device.open());
}

TEST(HaplyRun, ReplaysARunOnTheClockToTheBit) {
    const test::TemporaryFolder folder;
    haply::HaplyStandIn device;
    std::vector<std::string> awl = hurried_awl;
    awl.front() = "time_limit=8 s";  // the hand of a loaded machine is slow
    const LiveAndAgain runs = run_live_at("pedicle-awl", awl, device, device.open(), folder.path() + "/led");
    EXPECT_EQ(runs.live.error, "");
    EXPECT_EQ(runs.live.summary.hand, "device");
    EXPECT_EQ(runs.again.summary.hash, runs.live.summary.hash);
    EXPECT_GT(length(device.largest_force()), 0.0) << "the service has got forces of the bone";
}

}  // namespace
}  // namespace kerf::run
