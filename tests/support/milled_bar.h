// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/support/made_outline.h"
#include "tests/support/mill.h"

namespace kerf::test {

/// A bar of bone, and the mill on its way along x that severs it.
struct Milled {
    Body body = bar(0.2e-3);
    ToolSetup setup = mill();
    ToolOutline outline = test::outline(setup);
    Simulation simulation{body, setup, outline, gains_for(*find_device("premium-1.5-6dof"), 0.1), mill_at(-3.0e-3)};
    double x = -3.0e-3;

    /// One tick of the hand on its way along x, 2 µm.
    TickResult go(double y = 2.0e-3) {
        x += 2e-6;
        return simulation.tick({mill_at(x, y)});
    }
};

}  // namespace kerf::test
