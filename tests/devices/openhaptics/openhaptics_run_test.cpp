// SPDX-License-Identifier: Apache-2.0
// An operation with a hand at a Touch: through the driver and a stand-in for libHD, which has a servo of its own.
#include <gtest/gtest.h>

#include "tests/devices/openhaptics/openhaptics_stand_in.h"
#include "tests/run/doubled_device.h"

namespace kerf::run {
namespace {

TEST(OpenHapticsRun, HasTheBitsOfADeviceWithoutALibrary) {
    openhaptics::OpenHapticsStandIn device;
    expect_the_bits_of_no_driver(device, openhaptics::OpenHapticsStandIn::open());
}

}  // namespace
}  // namespace kerf::run
