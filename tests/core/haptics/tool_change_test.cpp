// SPDX-License-Identifier: Apache-2.0
// Nothing of the last tool's motion or loads moves the next one.
#include <gtest/gtest.h>

#include <vector>

#include "tests/support/probe.h"
#include "tests/support/rig.h"

namespace kerf {
namespace {

using namespace literals;

/// A probe of half a kilogram.
struct HeavyProbe {
    static constexpr auto about() { return describe("heavy_probe", "A blunt probe with a mass."); }
    [[nodiscard]] Outline outline() const {
        return revolution({{0.0, 0.0}, {-0.5e-3, 0.5e-3}})
            .cuts()
            .to(-50e-3, 0.5e-3)
            .gripped_at(-60e-3)
            .weighs({.mass = 0.5, .centre_z = -60e-3, .gyration = 50e-3});
    }
};

/// The tip touches, and a side load of 0.3 of its force follows.
struct Dragging {
    struct State {};
    static constexpr auto about() { return describe("dragging", "Contact of the tip, with a load across it."); }
    void resist(const Held<HeavyProbe>&, const BoneQuery& bone, const State&, Channels& channels) const noexcept {
        const SurfacePoint tip = bone.nearest({});
        if (tip.body < 0) return;
        channels.contact({.id = 1, .along = -tip.normal, .stiffness = 2e4, .depth = -tip.distance});
        if (kerf_channel* last = channels.add(KERF_CUT, 2, make_vec6({0, 0, 1}, {}))) {
            last->eta = tip.distance < 0.0 ? 1e3 : 0.0;
            last->follow[0] = 0.3;
        }
    }
    void commit(const Held<HeavyProbe>&, const BoneQuery&, const Advance&, State&, Actions&) const noexcept {}
};

Tool heavy_probe() {
    using Components = PluginTables<HeavyProbe, Dragging>;
    const ToolSetup setup{.tool = &Components::components[0],
                          .force = &Components::components[1],
                          .tool_parameters = {},
                          .force_parameters = {},
                          .drives = {},
                          .bound = {}};
    return {setup, test::outline(setup)};
}

struct TwoProbes {
    Body body = test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.25_mm);
    Simulation simulation{body, {heavy_probe(), heavy_probe()}, test::gains(1.0), test::at_depth(-20.0_mm)};
};

TEST(ToolChange, LeavesTheLastToolsMomentum) {
    TwoProbes probes;
    double aside = 0.0;
    for (int i = 0; i < 200; ++i)
        (void)probes.simulation.tick({test::at_depth(-20.0_mm, 0.0, {aside += 0.1_mm, 0, 0})});
    ASSERT_GT(length(linear(probes.simulation.last_rate())), 20.0_mm_per_s);
    probes.simulation.take_tool(1);

    // From rest, half a kilogram goes no farther in a tick under the damper of a hand that was at 100 mm/s
    const Vec3 before = probes.simulation.world_from_tool().position;
    const TickResult first = probes.simulation.tick({test::at_depth(-20.0_mm, 0.0, {aside, 0, 0})});
    EXPECT_LT(length(first.world_from_tool.position - before), 2.0_um);
}

TEST(ToolChange, ForgetsTheLoadsThatFollowedTheLastTool) {
    // Given a probe that slides into bone, with a load across it
    TwoProbes probes;
    double depth = -1.0_mm;
    for (int i = 0; i < 20; ++i) (void)probes.simulation.tick({test::at_depth(-20.0_mm + i * 1.0_mm)});
    double largest = 0.0;
    for (; depth < 3.0_mm; depth += 0.02_mm) {
        const TickResult result = probes.simulation.tick({test::at_depth(depth)});
        largest = std::max(largest, std::abs(result.bone_on_tool[0]));
    }
    ASSERT_GT(largest, 0.1);

    // When the hand takes another and draws it back into the air in front of that bone
    probes.simulation.take_tool(1);
    const TickResult first = probes.simulation.tick({test::at_depth(depth)});

    // Then no load is on it
    EXPECT_NEAR(first.bone_on_tool[0], 0.0, 1e-12);
}

}  // namespace
}  // namespace kerf
