// SPDX-License-Identifier: Apache-2.0
// An operation with a hand at an omega: through the driver and a stand-in for the maker's library.
#include <gtest/gtest.h>

#include "tests/devices/force_dimension/force_dimension_stand_in.h"
#include "tests/run/doubled_device.h"

namespace kerf::run {
namespace {

TEST(ForceDimensionRun, HasTheBitsOfADeviceWithoutALibrary) {
    force_dimension::ForceDimensionStandIn device;
    expect_the_bits_of_no_driver(device, force_dimension::ForceDimensionStandIn::open());
}

}  // namespace
}  // namespace kerf::run
