// SPDX-License-Identifier: Apache-2.0
// The inside of a tick, against values that can be worked out by hand.
#include "run/view/inspection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "run/view/bone_slice.h"
#include "run/view/run_view.h"
#include "tests/support/probe.h"
#include "tests/support/rig.h"
#include "tests/support/short_scene.h"
#include "tests/support/watched_run.h"

namespace kerf::run {
namespace {

const Vec3 slope = normalized(Vec3{0.3, -0.5, 0.8});  // out of the bone, off every axis

/// Bone below a plane through the origin, with its outer 1.1 mm cortical.
Body tilted_bone(double spacing) {
    Grid grid = Grid::covering({-9e-3, -9e-3, -9e-3}, {9e-3, 9e-3, 9e-3}, spacing);
    Body body;
    body.id = "tilted";
    body.surface = LevelSet::build(grid, [](Vec3 p) { return dot(slope, p); });
    body.materials.push_back(
        {"cancellous", 800.0, LevelSet::build(grid, [](Vec3 p) { return dot(slope, p) + 1.1e-3; })});
    body.materials.push_back({"cortical", 1850.0, {}});
    return body;
}

constexpr double stiffness = 2e5;  // [N/m] of the contact

/// A probe that a hand at rest presses into the tilted bone.
struct Pressed {
    test::Rig rig;
    Pose hand;
    TickResult last;

    /// @param along  direction of the probe
    /// @param scale  device newtons per bone newton
    explicit Pressed(Vec3 along = {-0.1, 0.2, -1.0}, double scale = 0.01)
        : rig(tilted_bone(0.5e-3), test::probe(stiffness), test::pointing(0.2e-3 * slope, along), test::gains(scale)),
          hand(rig.world_from_tool()) {
        for (int i = 0; i < 600; ++i) {
            hand.position = hand.position - (i < 200 ? 5e-6 : 0.0) * slope;
            last = rig.tick({hand});
        }
    }
    [[nodiscard]] std::shared_ptr<const ViewedInspection> inspection() {
        return Inspector(0.5e-3).inspect(rig, last, hand);
    }
};
Pressed& pressed() {
    static Pressed one;
    return one;
}

TEST(Inspection, ShowsTheContactAtTheTipWithTheForceOfTheLaw) {
    const auto seen = pressed().inspection();
    ASSERT_EQ(seen->channels.size(), 1u);
    const ViewedChannel& contact = seen->channels[0];
    EXPECT_EQ(contact.kind, ViewedChannel::Kind::contact);
    EXPECT_EQ(contact.wall, nullptr);
    EXPECT_EQ(contact.id, 1u);
    EXPECT_LT(length(contact.point), 1e-12) << "the law touches with its tip alone";
    const Vec3 on_tool = rotate(seen->world_from_tool.rotation, -contact.force * contact.along);
    ASSERT_GT(length(on_tool), 1.0);
    EXPECT_LT(length(on_tool - length(on_tool) * slope), 1e-4 * length(on_tool)) << "along the slope's normal";
    EXPECT_LT(length(on_tool - linear(pressed().last.bone_on_tool)), 1e-7);
    EXPECT_LT(length(seen->following), 1e-7) << "the law has no other force";
    EXPECT_NEAR(contact.force, stiffness * (contact.depth + contact.rate * Simulation::dt), 1e-6);
}

TEST(Inspection, ShowsWhereTheLawQueriesBone) {
    const auto seen = pressed().inspection();
    ASSERT_EQ(seen->samples.size(), 1u);
    EXPECT_EQ(seen->sample_count, 1u);
    const ViewedSample& sample = seen->samples[0];
    EXPECT_FALSE(sample.is_edge);
    EXPECT_EQ(sample.body, 0);
    EXPECT_EQ(sample.engagement, 1.0);
    EXPECT_NEAR(sample.distance, dot(slope, seen->world_from_tool * sample.point), 2e-7);
    EXPECT_LT(length(rotate(seen->world_from_tool.rotation, sample.direction) - slope), 1e-4);
}

TEST(Inspection, ShowsTheCouplingBetweenHandAndTool) {
    Pressed& one = pressed();
    const auto seen = one.inspection();
    const ViewedCoupling& coupling = seen->coupling;
    const Vec3 apart = one.hand.position - one.last.world_from_tool.position;
    EXPECT_GT(length(apart), 0.1e-3);
    EXPECT_LT(length(coupling.world_from_unstretched.position - seen->world_from_tool.position - apart), 1e-12)
        << "the anchor has not slid";
    EXPECT_FALSE(coupling.is_saturated);
    EXPECT_LT(length(coupling.force - linear(one.last.limited_on_hand)), 1e-12);
    EXPECT_NEAR(length(coupling.force), length(linear(one.last.bone_on_tool)), 0.02 * length(coupling.force))
        << "at rest the spring carries the contact";
    EXPECT_LT(dot(coupling.stretch, coupling.force), 0.0) << "the spring pulls the hand back to the tool";
}

TEST(Inspection, ShowsALimitThatIsReached) {
    Pressed one(-slope, 1.0);
    EXPECT_FALSE(one.inspection()->coupling.is_saturated);
    for (int i = 0; i < 2000; ++i) {
        one.hand.position = one.hand.position - 10e-6 * slope;
        one.last = one.rig.tick({one.hand});
    }
    const ViewedCoupling coupling = one.inspection()->coupling;
    EXPECT_TRUE(coupling.is_saturated) << "the hand has moved 20 mm further";
    EXPECT_GT(length(coupling.force), 0.9 * coupling.max_force);
    EXPECT_LT(length(coupling.force), 1.5 * coupling.max_force) << "across and along the shaft separately";
}

TEST(Inspection, HasNoForceWhileTheToolRestsAfterAFault) {
    Pressed one;
    one.last.is_closed_or_closing = true;
    EXPECT_EQ(one.inspection()->channels.at(0).force, 0.0);
}

TEST(BoneSlice, HasTheExactDistanceToATiltedPlane) {
    for (const double spacing : {0.25e-3, 0.5e-3}) {
        test::Rig rig(tilted_bone(spacing), test::probe(stiffness), test::pointing(0.2e-3 * slope, {-0.1, 0.2, -1.0}));
        const Pose turned{{0.2e-3, -0.1e-3, 0.3e-3}, quat_from_rotation_vector({0.4, -0.9, 0.2})};
        const ViewedSlice slice = bone_slice(rig, turned, 0.21e-3, 31);
        ASSERT_EQ(slice.distance.size(), 31u * 31u);
        std::size_t compared = 0, at = 0;
        for (int row = 0; row < slice.edge; ++row)
            for (int column = 0; column < slice.edge; ++column, ++at) {
                const Vec3 point = rig.world_from_tool() * (turned * slice.point(column, row));
                const double exact = dot(slope, point);
                ASSERT_LT(length(slice.world_from_slice * slice.point(column, row) - point), 1e-12);
                if (std::abs(exact) > slice.reach - 1.8 * spacing) continue;  // a sample of its cell may be clamped
                ++compared;
                ASSERT_NEAR(static_cast<double>(slice.distance[at]), exact, 2e-7);
                const int tissue = exact >= 0.0 ? -1 : exact < -1.1e-3 ? 0 : 1;
                const bool is_at_border = std::abs(exact) < 1e-6 || std::abs(exact + 1.1e-3) < 0.05e-3;
                ASSERT_TRUE(is_at_border || slice.tissue[at] == tissue) << exact;
            }
        EXPECT_GT(compared, 150u);
    }
}

// ---- in a run -----------------------------------------------------------------------------------------------------

/// The short scene with an inspection of each moment.
struct Inspected {
    RunView view;
    test::WatchedRun run;
    std::vector<ViewedMoment> moments;

    explicit Inspected(const std::string& mode, bool is_wanted = true)
        : view(test::short_scene(), {.mode = mode, .hand = "rehearsal expert"}) {
        RunRequest request;
        request.mode = mode;
        request.observers = {&view};
        view.request_inspection(is_wanted);
        run = test::watched_run(test::short_scene(), test::plugins(), request);
        view.take(moments);
    }
};
const Inspected& inspected() {
    static const Inspected one("practice");
    return one;
}

TEST(RunInspection, HasThePosesOfTheSession) {
    std::size_t count = 0;
    for (const ViewedMoment& moment : inspected().moments) {
        if (moment.inspection == nullptr || moment.state.is_over) continue;
        const session::TickRow& row = inspected().run.ticks.at(moment.inspection->tick - 1);
        const ViewedCoupling& coupling = moment.inspection->coupling;
        ASSERT_EQ(length(coupling.world_from_handle.position - row.device_from_handle.position), 0.0);
        ASSERT_EQ(length(moment.inspection->world_from_tool.position - row.world_from_tool.position), 0.0);
        ASSERT_LT(length(coupling.force - linear(row.limited)), 1e-12);
        ++count;
    }
    EXPECT_GT(count, 500u);
}

TEST(RunInspection, ShowsTheEdgesAndSignalsOfADrillInBone) {
    std::size_t edges_in_bone = 0, cutting = 0;
    for (const ViewedMoment& moment : inspected().moments) {
        if (moment.inspection == nullptr) continue;
        for (const ViewedSample& sample : moment.inspection->samples)
            edges_in_bone += sample.is_edge && sample.engagement > 0.0 ? 1 : 0;
        double force = 0.0;
        for (const ViewedChannel& channel : moment.inspection->channels) force += channel.force;
        if (force > 1.0) ++cutting;
        ASSERT_NE(moment.inspection->along, nullptr);
        ASSERT_NE(moment.inspection->across, nullptr);
    }
    EXPECT_GT(edges_in_bone, 100u);
    EXPECT_GT(cutting, 20u);
    const ViewedTool& drill = inspected().view.scene().tools.at(0);
    EXPECT_FALSE(drill.law.empty());
    EXPECT_EQ(drill.signals.size(), test::short_scene().tools.at(0).setup.force->force->signal_count);
}

TEST(RunInspection, ChangesNoResult) {
    const Inspected without("practice", false);
    EXPECT_EQ(inspected().run.summary.hash, without.run.summary.hash);
    EXPECT_EQ(inspected().run.summary.score, without.run.summary.score);
    for (const ViewedMoment& moment : without.moments) ASSERT_EQ(moment.inspection, nullptr);
}

TEST(RunInspection, IsRefusedInAnExamination) {
    const Inspected exam("exam");
    ASSERT_FALSE(exam.moments.empty());
    for (const ViewedMoment& moment : exam.moments) ASSERT_EQ(moment.inspection, nullptr);
}

}  // namespace
}  // namespace kerf::run
