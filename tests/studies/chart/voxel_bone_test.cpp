// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/voxel_bone.h"

#include <gtest/gtest.h>

namespace kerf::chart {
namespace {

/// Bone below z = 0, soft below −5 mm, in a box of 10 mm.
ExactBone two_layers() {
    ExactBone bone;
    bone.surface = [](Vec3 p) { return p.z; };
    bone.tissues = {{"soft", 400.0, [](Vec3 p) { return p.z + 5e-3; }}, {"hard", 1600.0, {}}};
    bone.low = {-5e-3, -5e-3, -10e-3};
    bone.high = {5e-3, 5e-3, 0.0};
    return bone;
}

kerf_bone_sample ask(VoxelBone& bone, Vec3 point) {
    kerf_bone_sample sample{};
    const Vec3 direction{0, 0, 1};
    bone.query().sample(bone.query().bone, &point, 1, &direction, 1, &sample);
    return sample;
}

TEST(VoxelBone, BinaryIsTheTissueOfTheVoxelsCentre) {
    VoxelBone bone(two_layers(), 1e-3, {0, 0, 0}, VoxelBone::Reading::binary);
    EXPECT_EQ(ask(bone, {0, 0, 0.4e-3}).engagement, 0.0);
    EXPECT_EQ(ask(bone, {0, 0, -0.1e-3}).engagement, 1.0);
    EXPECT_EQ(ask(bone, {0, 0, -2e-3}).weight[1], 1.0);
    EXPECT_EQ(ask(bone, {0, 0, -7e-3}).weight[0], 1.0);
    EXPECT_EQ(ask(bone, {0, 0, 1.0}).engagement, 0.0) << "far outside";
}

TEST(VoxelBone, SharesOfTissueRiseAlongALine) {  // 01-01: linear in the share, ends equal to one tissue
    VoxelBone bone(two_layers(), 1e-3, {0, 0, 0}, VoxelBone::Reading::fraction);
    EXPECT_NEAR(ask(bone, {0, 0, -0.5e-3}).engagement, 1.0, 1e-12);
    EXPECT_NEAR(ask(bone, {0, 0, 0.0}).engagement, 0.5, 1e-9)
        << "half way between the last voxel of bone and the first of air";
    EXPECT_NEAR(ask(bone, {0, 0, 0.25e-3}).engagement, 0.25, 1e-9);
    EXPECT_NEAR(ask(bone, {0, 0, -5e-3}).weight[0], 0.5, 1e-9);
}

TEST(VoxelBone, DensityIsTrilinearAndAirHasNone) {  // P7
    VoxelBone bone(two_layers(), 1e-3, {0, 0, 0}, VoxelBone::Reading::density);
    EXPECT_NEAR(ask(bone, {0, 0, 0.0}).density[0], 800.0, 1e-6);
    EXPECT_NEAR(ask(bone, {0, 0, -5e-3}).density[0], 1000.0, 1e-6);
}

TEST(VoxelBone, WearsWhereItIsAskedAndOnlyThen) {
    VoxelBone bone(two_layers(), 1e-3, {0, 0, 0}, VoxelBone::Reading::binary);
    const Vec3 point{0.1e-3, 0.1e-3, -2.2e-3};
    (void)ask(bone, point);
    EXPECT_EQ(bone.removed_volume(), 0.0);
    bone.wear(0.5);
    (void)ask(bone, point);
    EXPECT_EQ(bone.removed_volume(), 0.0);
    (void)ask(bone, point);
    bone.stop_wearing();
    EXPECT_NEAR(bone.removed_volume(), 1e-9, 1e-15);
    EXPECT_EQ(ask(bone, point).engagement, 0.0);
    EXPECT_EQ(ask(bone, {0.1e-3, 0.1e-3, -4.2e-3}).engagement, 1.0);
}

}  // namespace
}  // namespace kerf::chart
