// SPDX-License-Identifier: Apache-2.0
#include "plugins/drilling/bone_strength.h"

#include <gtest/gtest.h>

namespace kerf::drilling {
namespace {

TEST(CrushingPressure, OfSpongyAndOfWholeBone) {
    EXPECT_NEAR(crushing_pressure(300.0), 6.12e6, 1.0);
    EXPECT_NEAR(crushing_pressure(1850.0), 232.73e6, 1e3);
}

}  // namespace
}  // namespace kerf::drilling
