// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/papers/printed_loop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "studies/stability/kerf_loop.h"
#include "tests/studies/stability/found_tool.h"

namespace kerf::papers {
namespace {

using namespace stability;

constexpr BoneBlock block{.thickness = 10e-3, .shell = 5e-3, .inner = 585.0};

/// The papers' drill over that block, whole in the outer tissue at 3 mm and in the inner one at 8 mm.
struct Printed {
    const ToolUnderTest tool = the_papers_drill();
    const Body body = make(block);
    PrintedLoop loop{block, body.grid(), tool.setup, at_depth(-1e-3), Simulation::dt};

    /// Goes to `depth` at `feed` [m/s]; the thrust of the last tick.
    double go(double from, double to, double feed) {
        const int ticks = static_cast<int>(std::abs(to - from) / feed / Simulation::dt);
        for (int i = 1; i <= ticks; ++i) loop.go(at_depth(from + (to - from) * i / ticks));
        return loop.thrust();
    }
};

TEST(PrintedLoop, ForceIsProportionalToTheFeed) {
    Printed slow, fast;
    const double once = slow.go(-1e-3, 3e-3, 1e-3), twice = fast.go(-1e-3, 3e-3, 2e-3);
    EXPECT_GT(once, 1.0);
    EXPECT_NEAR(twice / once, 2.0, 1e-6 /* poses are rounded */);
}

TEST(PrintedLoop, TheSofterTissueResistsATenth) {
    Printed printed;
    const double outer = printed.go(-1e-3, 3e-3, 1e-3), inner = printed.go(3e-3, 8e-3, 1e-3);
    EXPECT_NEAR(inner / outer, 0.1, 1e-6 /* the default of the law */);
}

TEST(PrintedLoop, ThereIsNoForceOverTheFace) {
    Printed printed;
    EXPECT_EQ(printed.go(-1e-3, -0.2e-3, 1e-3), 0.0);
}

TEST(PrintedLoop, ItsBoneStaysWhereItHasBeenDrilled) {
    Printed printed;
    const double once = printed.go(-1e-3, 3e-3, 1e-3);
    (void)printed.go(3e-3, -1e-3, 1e-3);
    EXPECT_NEAR(printed.go(-1e-3, 3e-3, 1e-3), once, 1e-6 * once);
}

TEST(PrintedLoop, AVoxelIsBoneOrItIsNot) {
    // Given a drill with its tip in the face
    Printed printed;
    (void)printed.go(-1e-3, 0.0, 1e-3);
    double last = printed.loop.thrust();

    // When it goes in by a little more than a voxel, a thousandth of a millimetre each tick
    constexpr int ticks = 300;
    int changed = 0;
    for (int i = 1; i <= ticks; ++i) {
        printed.loop.go(at_depth(i * 1e-6));
        if (std::abs(printed.loop.thrust() - last) > 1e-9 * printed.loop.thrust()) ++changed;
        last = printed.loop.thrust();
    }

    // Then its force is the same in most ticks, and changes where a point meets a voxel
    EXPECT_GT(changed, 0);
    EXPECT_LT(changed, ticks / 10);
}

TEST(PrintedLoop, ASignalThatIsNotThereIsNoNumber) {
    Printed printed;
    (void)printed.go(-1e-3, 3e-3, 1e-3);
    EXPECT_GT(printed.loop.signal("t_tang"), 0.0);
    EXPECT_TRUE(std::isnan(printed.loop.signal("no_such_signal")));
}

}  // namespace
}  // namespace kerf::papers
