// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/powered/exact_saw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "kerf/units.hpp"
#include "studies/chart/powered/powered_measure.h"
#include "tests/studies/papers/as_printed/printed_rig.h"

namespace kerf::chart {
namespace {

using namespace literals;

/// Ten teeth 2 mm apart that move by 4 mm, 1 mm wide: edge forces alone, of full size from the thinnest chip on.
Values ten_teeth() {
    return {{"blade_length", 20.0_mm}, {"blade_height", 10.0_mm},     {"stroke", 4.0_mm},
            {"tooth_pitch", 2.0_mm},   {"blade_thickness", 0.8_mm},   {"tooth_set", 0.1_mm},
            {"stroke_rate", 250.0},    {"thrust_edge", 6.0_N_per_mm}, {"thrust_chip", 0.0},
            {"edge_depth", 1e-15},     {"reference_density", 1850.0}, {"set_share", 0.1}};
}
ExactBone bone_of(ExactBone::Distance surface) {
    ExactBone bone;
    bone.surface = std::move(surface);
    bone.tissues = {{"cortical", 1850.0, {}}};
    return bone;
}
Pose deep(double depth) { return {{0, 0, -depth}, quat_between({0, 0, 1}, {0, 0, -1})}; }
Vec6 fed(double feed) { return make_vec6({0, 0, feed}, {}); }

TEST(ExactSaw, TakesTheChipOfTheToothBefore) {
    // 250/s, S = 4 mm, p = 2 mm: at the mean speed 2 S u = 2 m/s a chip of p/V = 1 ms of feed; at rest half a cycle
    const StraightSaw saw(ten_teeth());
    EXPECT_NEAR(saw.chip_per_feed(std::acos(2.0 / pi)), 1e-3, 1e-9);
    EXPECT_NEAR(saw.chip_per_feed(0.5 * pi), 2e-3, 1e-12);
    EXPECT_EQ(saw.teeth(), 10);
}

TEST(ExactSaw, HasTheEdgeForceOfAllItsTeeth) {
    const ExactBone bone = bone_of([](Vec3 p) { return p.z; });
    ExactSaw saw(bone, StraightSaw(ten_teeth()));
    const Vec6 wrench = *saw.tick(deep(2.0_mm), fed(2.0_mm_per_s));
    EXPECT_NEAR(wrench[2], -10.0 * 6.0, 1e-9) << "ten teeth, 1 mm wide, 6 N/mm";
    EXPECT_NEAR(wrench[1], 0.0, 1e-9) << "set to either side by turns";
    EXPECT_EQ(length(linear(*saw.tick(deep(2.0_mm), fed(0.0)))), 0.0) << "no feed, no force";
}

TEST(ExactSaw, AveragesTeethThatSwingInAndOutOfBone) {
    // Bone for |x| < 1 mm. A tooth at ±1 mm swings over 2 mm to either side: it is within while
    // −2 < 2 sin φ < 0, a half of the time; one at ±3 mm while sin φ beyond 1 … 2/2: never.
    const ExactBone bone = bone_of([](Vec3 p) { return std::max(p.z, std::abs(p.x) - 1.0_mm); });
    ExactSaw saw(bone, StraightSaw(ten_teeth()));
    EXPECT_NEAR((*saw.tick(deep(2.0_mm), fed(2.0_mm_per_s)))[2], -2.0 * 0.5 * 6.0, 0.1 /* 64 phases */);
}

TEST(ExactSaw, TakesTheSlotOfItsKerf) {  // C.1: kerf times what the front crosses
    const ExactBone bone = bone_of([](Vec3 p) { return std::max(p.z, std::abs(p.x) - 5.0_mm); });
    ExactSaw saw(bone, StraightSaw(ten_teeth()));
    for (int i = 0; i < 1000; ++i) (void)saw.tick(deep(i * 2.0_um), fed(2.0_mm_per_s));
    EXPECT_NEAR(saw.volume() / (1.0_mm * 10.0_mm * 2.0_mm), 1.0, 2e-3) << "the first tick begins on the face";
}

TEST(ExactSaw, SaysNothingOnceItIsTurned) {
    const ExactBone bone = bone_of([](Vec3 p) { return p.z; });
    ExactSaw saw(bone, StraightSaw(ten_teeth()));
    EXPECT_TRUE(saw.tick(deep(2.0_mm), fed(2.0_mm_per_s)).has_value());
    EXPECT_FALSE(saw.tick(deep(2.0_mm), make_vec6({0, 0, 2.0_mm_per_s}, {0.05, 0, 0})).has_value());
    EXPECT_FALSE(saw.tick(deep(2.0_mm), fed(2.0_mm_per_s)).has_value()) << "what it has cut is not known";
}

TEST(MandibleScene, IsCorticalBoneAroundCancellous) {
    const PoweredScene scene = mandible_scene();
    const auto density = [&](Vec3 p) {
        const int in = scene.bone.tissue_at(p);
        return in < 0 ? 0.0 : scene.bone.tissues[static_cast<std::size_t>(in)].density;
    };
    EXPECT_EQ(density({0, 0, 0.01_mm}), 0.0) << "the cut enters at z = 0";
    EXPECT_EQ(density({0, 0, -0.01_mm}), 1850.0);
    EXPECT_EQ(density({0, 0, -11.0_mm}), 500.0) << "in the middle of the cut";
    EXPECT_EQ(density({4.0_mm, 0, -11.0_mm}), 1850.0) << "a plate of 2.1 mm on either side";
    EXPECT_EQ(density({5.01_mm, 0, -11.0_mm}), 0.0);
    EXPECT_EQ(density({0, 0, scene.path.back().position.z}), 0.0) << "it leaves the bone";
}

TEST(MandibleScene, IsHeldAgainstTheExactLawUntilItTwists) {
    const Plugins plugins{&test::own_plugins(), &test::printed_plugins()};
    PoweredScene scene = mandible_scene();
    const auto exact = scene.exact(scene, scene.tool.all(*plugins.own));
    const Motion motion = prescribed_motion(scene);
    std::size_t straight = 0;
    while (exact->tick(motion.from[straight], motion.rate[straight])) ++straight;
    EXPECT_NEAR(motion.from[straight].position.z, -9.0_mm, 0.05_mm);

    // The way there alone: teeth that do not swing are within a tenth of those that do
    scene.path.resize(straight);
    for (const PoweredMethod& method : powered_methods(plugins, scene, true)) {
        if (method.id != "M10") continue;
        const PoweredReference reference = reference_along(plugins, scene, prescribed_motion(scene), true);
        const Measured measured = measure_powered(plugins, method, scene, reference, {0.25e-3, 0, {}}, 1, 1.0);
        EXPECT_EQ(measured.exact_share, 1.0);
        EXPECT_LT(measured.force_error, 0.1);
        EXPECT_LT(measured.volume_error, 0.01);
    }
}

}  // namespace
}  // namespace kerf::chart
