// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/wall.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/studies/stability/found_tool.h"

namespace kerf::stability {
namespace {

TEST(Wall, TheLargestStableStiffnessOfASampledSpringIsThatOfTheory) {
    for (const double viscosity : {0.1, 1.0})
        for (const double period : {0.5e-3, 1e-3})
            for (const int delay : {0, 1, 2}) {
                const PortSettings settings{.viscosity = viscosity, .period = period, .delay = delay};
                EXPECT_NEAR(stiffest_wall(settings) / stiffest_wall_in_theory(settings), 1.0, 0.02)
                    << viscosity << " N s/m, " << period << " s, " << delay << " ticks";
            }
}

TEST(Wall, FrictionCarriesWhatDampingCannot) {
    const PortSettings without = port_of(*find_device("desktop"), no_hand, 0);
    PortSettings with = without;
    with.resolution = 0.0;
    EXPECT_GT(stiffest_wall(with), 1.5 * stiffest_wall_in_theory(with));
}

TEST(Wall, TheRecordsOfDevicesSayWhatTheBisectionFinds) {
    for (const DeviceRecord& device : all_devices())
        for (int latency = 0; latency <= max_latency; ++latency) {
            PortSettings settings = port_of(device, no_hand, latency);
            settings.resolution = 0.0;
            EXPECT_NEAR(device.stiffest_wall[latency] / stiffest_wall(settings), 1.0, 0.01)
                << device.id << ", " << latency << " ticks: found " << stiffest_wall(settings) << " N/m";
        }
}

TEST(Wall, ARigidWallShakesTheDeviceAsPrintedAndRestsInKerfsLoopUnderAHand) {
    const Scope scope = only("premium-1.5-6dof", test_hands[2], 0);
    std::vector<Finding> found;
    check_walls(scope, [&](const Finding& finding) {
        if (finding.scene == "wall of 20 kN/mm") found.push_back(finding);
    });
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].method, Method::as_printed);
    EXPECT_EQ(found[0].outcome, Outcome::fail) << found[0].measured;
    EXPECT_EQ(found[1].method, Method::kerf);
    EXPECT_EQ(found[1].outcome, Outcome::pass) << found[1].measured;
}

}  // namespace
}  // namespace kerf::stability
