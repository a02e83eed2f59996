// SPDX-License-Identifier: Apache-2.0
#include "run/device/workspace_fit.h"

#include <gtest/gtest.h>

#include "run/device/handle_frame.h"
#include "run/run_procedure.h"
#include "tests/support/short_scene.h"

namespace kerf::run {
namespace {

constexpr Box workspace{{-0.08, -0.06, -0.04}, {0.08, 0.06, 0.04}};

TEST(WorkspaceFit, TakesTheSmallestScaleThatKeepsTheHandleInside) {
    const WorkspaceFit fit = fit_into(workspace, {}, {{-0.02, -0.03, -0.01}, {0.02, 0.01, 0.01}});
    EXPECT_DOUBLE_EQ(fit.scale, 0.5) << "30 mm down in 60 mm";
    EXPECT_TRUE(fit.fits());
}

TEST(WorkspaceFit, CountsFromWhereTheHandleIs) {
    const WorkspaceFit fit = fit_into(workspace, {0, -0.02, 0}, {{-0.02, -0.03, -0.01}, {0.02, 0.01, 0.01}});
    EXPECT_DOUBLE_EQ(fit.scale, 0.75) << "40 mm are left below";
}

TEST(WorkspaceFit, StatesWhatDoesNotFitAtTheFullMotion) {
    const WorkspaceFit fit = fit_into(workspace, {}, {{-0.02, -0.1, -0.01}, {0.13, 0.01, 0.01}});
    EXPECT_EQ(fit.scale, 1.0);
    EXPECT_FALSE(fit.fits());
    EXPECT_NEAR(fit.below.y, 0.04, 1e-12);
    EXPECT_NEAR(fit.above.x, 0.05, 1e-12);
    EXPECT_EQ(fit.below.x, 0.0);
    EXPECT_EQ(fit.above.z, 0.0);
}

TEST(WorkspaceFit, CountsFromAHandleOutsideOfTheWorkspace) {
    const WorkspaceFit fit = fit_into(workspace, {0, 0, 0.05}, {{-0.01, -0.01, -0.01}, {0.01, 0.01, 0.02}});
    EXPECT_EQ(fit.scale, 1.0);
    EXPECT_NEAR(fit.above.z, 0.02, 1e-12) << "only what it would go farther";
    EXPECT_EQ(fit.below.z, 0.0);
}

TEST(WorkspaceFit, MagnifiesUpToTwentyTimes) {
    EXPECT_EQ(fit_into(workspace, {}, {{-1e-4, 0, 0}, {0, 0, 0}}).scale, documents::min_scale);
    EXPECT_EQ(fit_into(workspace, {}, {}).scale, documents::min_scale);
}

TEST(WorkspaceFit, CoversTheHandleOnAPlannedPath) {
    const Scene& scene = test::short_scene();
    const documents::Rehearsal& rehearsal = scene.procedure.rehearsals.front();
    documents::DeviceStation station{.right = {0, 0, 1}, .up = {0, -1, 0}};
    const Box motion = motion_of(rehearsal, scene, station);
    const Box wide{{-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}};
    station.scale = fit_into(wide, {0.01, 0, 0}, motion).scale;
    ASSERT_LT(station.scale, 1.0);
    const HandPlan plan = plan_of(rehearsal, scene);
    const Vec3 grip{0, 0, scene.tool(0).outline.handling.grip_z};
    HandleFrame frame(station, true);
    frame.join({{0.01, 0, 0}, plan.start.rotation}, plan.start, grip);
    Box visited = empty_box;
    for (const simulated_hand::Leg& leg : plan.intent.legs)
        visited = joined(visited, frame.to_device(leg.target) * grip);
    EXPECT_GE(visited.low.x, wide.low.x);
    EXPECT_GE(visited.low.y, wide.low.y);
    EXPECT_GE(visited.low.z, wide.low.z);
    EXPECT_LE(visited.high.x, wide.high.x);
    EXPECT_LE(visited.high.y, wide.high.y);
    EXPECT_LE(visited.high.z, wide.high.z);
}

}  // namespace
}  // namespace kerf::run
