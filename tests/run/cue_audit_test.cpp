// SPDX-License-Identifier: Apache-2.0
#include "run/cues/cue_audit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/short_scene.h"

namespace kerf::run {
namespace {

constexpr std::int32_t air = -1;

/// Returns the index of the densest tissue of a scene, or of another one.
std::int32_t tissue_of(const Scene& scene, bool is_densest) {
    const auto& materials = scene.body.materials;
    std::size_t densest = 0, other = 0;
    for (std::size_t m = 0; m < materials.size(); ++m) {
        if (materials[m].density > materials[densest].density) densest = m;
        if (materials[m].density < materials[other].density) other = m;
    }
    return static_cast<std::int32_t>(is_densest ? densest : other);
}

/// A hand that advances by 1 mm/s, with a force of the device in each tissue.
class Advance {
public:
    explicit Advance(const Scene& scene) : audit(scene) {}

    /// @param force    [N] of the device
    /// @param coupled  factor by which the coupling would push harder
    void ticks(int count, std::int32_t tissue, double force, double coupled = 1.0) {
        for (int i = 0; i < count; ++i) {
            session::TickRow row;
            row.step = 0;
            row.tissue = tissue;
            row.depth = depth_ += 1e-6;
            row.feed_rate = 1e-3;
            row.commanded = make_vec6({0, 0, force}, {});
            row.limited = make_vec6({0, 0, 100.0 * force}, {});
            row.coupled = make_vec6({0, 0, 100.0 * force * coupled}, {});
            row.modelled = make_vec6({0, 0, 100.0 * force}, {});
            audit.on_tick(row);
        }
    }
    [[nodiscard]] StepCues cues() const { return audit.cues().at(0); }

    CueAudit audit;

private:
    double depth_ = 0.0;
};

TEST(NoticeableSteps, CountsSevenPercentEach) {
    EXPECT_NEAR(noticeable_steps(1.07, 1.0, 0.1), 1.0, 1e-12);
    EXPECT_NEAR(noticeable_steps(1.0, 2.0, 0.1), std::log(2.0) / std::log(1.07), 1e-12);
    EXPECT_EQ(noticeable_steps(0.2, 0.05, 0.3), 0.0) << "friction hides both";
    EXPECT_NEAR(noticeable_steps(0.6, 0.05, 0.3), std::log(2.0) / std::log(1.07), 1e-12) << "and the smaller one";
}

TEST(CueAudit, SumsUpAStep) {
    const Scene& scene = test::short_scene();
    const double friction = scene.device->friction;
    const std::int32_t wall = tissue_of(scene, true), inside = tissue_of(scene, false);
    Advance hand(scene);
    hand.ticks(500, air, 0.0);
    hand.ticks(200, wall, 20.0 * friction);
    hand.ticks(600, inside, 0.5 * friction);
    hand.ticks(200, wall, 20.0 * friction, 1.5);
    const StepCues cues = hand.cues();
    EXPECT_EQ(cues.step, scene.procedure.steps[0].id);
    EXPECT_NEAR(cues.time_in_bone, 1.0, 1e-9);
    EXPECT_NEAR(cues.below_friction, 0.6, 1e-12);
    EXPECT_NEAR(cues.saturated, 0.2, 1e-12);
    ASSERT_TRUE(cues.contrast);
    EXPECT_NEAR(*cues.contrast, std::log(20.0) / std::log(1.07), 1e-4);
    EXPECT_FALSE(cues.exit) << "it has not left the bone";
}

TEST(CueAudit, FindsTheFallOfForceBeyondTheFarWall) {
    const Scene& scene = test::short_scene();
    const double friction = scene.device->friction;
    const std::int32_t wall = tissue_of(scene, true), inside = tissue_of(scene, false);
    Advance hand(scene);
    hand.ticks(200, wall, 10.0 * friction);
    hand.ticks(200, inside, 2.0 * friction);
    hand.ticks(200, wall, 12.0 * friction);
    hand.ticks(50, air, 6.0 * friction);
    hand.ticks(1200, air, 3.0 * friction);
    ASSERT_TRUE(hand.cues().exit);
    EXPECT_NEAR(*hand.cues().exit, std::log(4.0) / std::log(1.07), 1e-4);
}

TEST(CueAudit, NamesNoCueThatWasNotThere) {
    const Scene& scene = test::short_scene();
    Advance hand(scene);
    hand.ticks(50, tissue_of(scene, true), 1.0);
    hand.ticks(500, tissue_of(scene, false), 1.0);
    EXPECT_FALSE(hand.cues().contrast) << "50 ticks are too few for a median";
    EXPECT_FALSE(hand.cues().exit);
    Advance in_air(scene);
    in_air.ticks(500, air, 0.0);
    EXPECT_TRUE(in_air.audit.cues().empty());
}

}  // namespace
}  // namespace kerf::run
