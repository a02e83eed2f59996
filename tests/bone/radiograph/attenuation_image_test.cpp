// SPDX-License-Identifier: Apache-2.0
#include "bone/radiograph/attenuation_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "tests/bone/radiograph/shapes.h"

namespace kerf::bone {
namespace {

using namespace literals;
using test::Bone;

AttenuationImage image_of(const std::vector<AttenuatingBody>& bodies, double half = 24.0_mm, int voxels = 96) {
    AttenuationImage image = AttenuationImage::around(test::cube(half), {.voxels = voxels});
    image.update(bodies);
    return image;
}

std::uint8_t at(const AttenuationImage& image, Vec3 p) {
    const Vec3 v = (1.0 / image.spacing()) * (p - image.origin());
    return image.value(static_cast<int>(std::lround(v.x)), static_cast<int>(std::lround(v.y)),
                       static_cast<int>(std::lround(v.z)));
}

Bone block() {
    Body body = test::block({-12.0_mm, -12.0_mm, -12.0_mm}, {12.0_mm, 12.0_mm, 12.0_mm}, 0.5_mm);
    body.materials[0].density = test::bone_density;
    return Bone(body);
}

/// A block with a shell of 2 mm, and cancellous bone in it whose density grows along x.
Bone shelled_block() {
    Bone bone = block();
    const Grid grid = bone.body.grid();
    const auto inner = [](Vec3 p) {
        return -test::box_distance(p, {-10.0_mm, -10.0_mm, -10.0_mm}, {10.0_mm, 10.0_mm, 10.0_mm});
    };
    bone.body.materials[0].border = LevelSet::build(grid, inner);
    Material cancellous{"cancellous", 600.0, {}};
    cancellous.densities = DensityField::build(
        grid, [](std::size_t) { return true; }, [](Vec3 p) { return 300.0 + p.x / 10.0_mm * 200.0; });
    bone.body.materials.push_back(cancellous);
    return bone;
}

TEST(BoneAttenuation, MatchesWaterAndCompactBone) {
    EXPECT_DOUBLE_EQ(bone_attenuation(0.0), 20.59);
    EXPECT_DOUBLE_EQ(bone_attenuation(1920.0), 60.44);
    EXPECT_NEAR(bone_attenuation(960.0), 40.515, 1e-12);
    EXPECT_EQ(AttenuationImage::step * 64, water_attenuation);
}

TEST(AttenuationImage, CoversTheBoxWithCubicVoxels) {
    const AttenuationImage image = AttenuationImage::around({{0, 0, 0}, {0.10, 0.05, 0.02}}, {.voxels = 103});
    EXPECT_DOUBLE_EQ(image.spacing(), 1.0_mm);
    EXPECT_EQ(image.voxels(), (std::array{103, 53, 23}));
    EXPECT_NEAR(image.origin().x, -1.0_mm, 1e-12);
    EXPECT_NEAR(image.origin().z, -1.0_mm, 1e-12);
    // The ellipsoid contains the corners of the grid, with skin around it.
    const auto [centre, axes] = image.soft_tissue();
    EXPECT_NEAR(length(centre - Vec3{0.05, 0.025, 0.01}), 0.0, 1e-12);
    EXPECT_NEAR(axes.z, std::sqrt(3.0) * 12.0_mm + 80.0_mm, 1e-9);
}

TEST(BoneBox, ContainsTheBoneOfAMovedBody) {
    const Body body = block().body;
    // A cube of 24 mm; samples are 0.5 mm apart, and the outermost ones inside lie less than that below its faces.
    const Box still = bone_box(body, {{0.1, 0, 0}, {1, 0, 0, 0}});
    EXPECT_NEAR(still.low.x, 0.1 - 11.75_mm, 0.2501_mm);
    EXPECT_NEAR(still.high.z, 11.75_mm, 0.2501_mm);
    // On its edge it is √2 times as wide, and up to a brick's diagonal is added.
    const Box turned = bone_box(body, {{0, 0, 0}, quat_from_rotation_vector({0, 0, 45.0_deg})});
    const double corner = 11.5_mm * std::sqrt(2.0), brick = 4.0_mm * std::sqrt(2.0);
    EXPECT_GE(turned.high.y, corner - 1e-9);
    EXPECT_LE(turned.high.y, corner + brick);
    EXPECT_LE(turned.low.x, -corner + 1e-9);
    EXPECT_EQ(bone_box(test::solid(5.0_mm, 0.5_mm, [](Vec3) { return 1.0; }), identity_pose()).low.x, empty_box.low.x);
}

TEST(AttenuationImage, HasSoftTissueWithoutBodies) {
    const AttenuationImage image = image_of({});
    EXPECT_TRUE(std::all_of(image.values().begin(), image.values().end(), [](int v) { return v == 64; }));
}

TEST(AttenuationImage, HasNoVoxelsWithoutABox) {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const Box& box : {empty_box, Box{{0, 0, 0}, {0, 0, 0}}, Box{{0, 0, 0}, {infinity, 1, 1}}}) {
        AttenuationImage image = AttenuationImage::around(box);
        const Bone bone = block();
        image.update(std::vector{bone.at()});
        EXPECT_TRUE(image.values().empty());
    }
}

TEST(AttenuationImage, WeightsTissuesByTheirFractionOfAVoxel) {
    const Bone bone = shelled_block();
    const AttenuationImage image = image_of({bone.at()});
    const auto value = [](double density) {
        return static_cast<int>(bone_attenuation(density) / AttenuationImage::step + 0.5);
    };
    EXPECT_EQ(at(image, {11.0_mm, 0, 0}), test::bone_value);
    EXPECT_EQ(at(image, {0, 0, 15.0_mm}), 64);
    for (int i = 0; i < image.voxels()[0]; ++i) {
        const double x = image.origin().x + i * image.spacing();
        if (std::abs(x) < 9.0_mm) {
            EXPECT_NEAR(at(image, {x, 0, 0}), value(300.0 + 2e4 * x), 1) << x;
        }
        // A voxel that the face at 12 mm divides has the fraction that lies inside.
        const double inside = (12.0_mm - x) / image.spacing() + 0.5;
        if (inside > 0.0 && inside < 1.0) {
            EXPECT_NEAR(at(image, {x, 0, 0}), 64 + 120 * inside, 1.0) << inside;
        }
    }
}

TEST(AttenuationImage, FindsTheBoneOfEachLine) {
    const Bone bone = block();
    const AttenuationImage image = image_of({bone.at()});
    const int middle = image.voxels()[1] / 2;
    const auto span = image.bone_in_line(middle, middle);
    EXPECT_NE(image.value(span.begin, middle, middle), 64);
    EXPECT_EQ(image.value(span.begin - 1, middle, middle), 64);
    EXPECT_NEAR((span.end - span.begin) * image.spacing(), 24.0_mm, 2.0 * image.spacing());
    EXPECT_EQ(image.bone_in_line(0, 0).end, 0);
}

TEST(AttenuationImage, MakesChangedBricksAsIfAnew) {
    for (const Pose& pose :
         {identity_pose(), Pose{{1.0_mm, -2.3_mm, 0.7_mm}, quat_from_rotation_vector({0.3, -0.5, 0.2})}}) {
        Bone bone = shelled_block();
        AttenuationImage image = image_of({bone.at(pose)});
        const std::size_t all = image.updated_voxels();

        (void)bone.cut.take_changed();
        bone.drill(1.6_mm, {3.0_mm, 2.0_mm, 20.0_mm}, {1.0_mm, 2.0_mm, -4.0_mm});
        const std::vector<std::size_t> changed = bone.cut.take_changed();
        AttenuatingBody body = bone.at(pose);
        body.changed = changed;
        image.update(std::vector{body});

        EXPECT_LT(image.updated_voxels(), all / 4);
        EXPECT_GT(image.updated_voxels(), 0u);
        EXPECT_EQ(image.values(), image_of({bone.at(pose)}).values());
        EXPECT_NE(image.values(), image_of({shelled_block().at(pose)}).values());
    }
}

TEST(AttenuationImage, MakesMovedBodiesAsIfAnew) {
    const Bone still = block(), moving = shelled_block();
    const Pose away{{-8.0_mm, 0, 0}, {1, 0, 0, 0}};
    AttenuationImage image = image_of({still.at(away), moving.at({{10.0_mm, 0, 0}, {1, 0, 0, 0}})}, 40.0_mm);
    const Pose to{{13.0_mm, 9.0_mm, -4.0_mm}, quat_from_rotation_vector({0, 0.4, 0.9})};
    AttenuatingBody unchanged = still.at(away);
    unchanged.changed = std::span<const std::size_t>{};
    image.update(std::vector{unchanged, moving.at(to)});
    EXPECT_EQ(image.values(), image_of({still.at(away), moving.at(to)}, 40.0_mm).values());

    // It goes, and comes back.
    image.update(std::vector{unchanged});
    EXPECT_EQ(image.values(), image_of({still.at(away)}, 40.0_mm).values());
    image.update(std::vector{unchanged, moving.at(to)});
    EXPECT_EQ(image.values(), image_of({still.at(away), moving.at(to)}, 40.0_mm).values());
}

TEST(AttenuationImage, HasNoBoneAtAPoseThatIsNotFinite) {
    const Bone bone = block();
    AttenuationImage image = image_of({bone.at()});
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
        image.update(std::vector{bone.at({{bad, 0, 0}, {1, 0, 0, 0}})});
        EXPECT_EQ(image.values(), image_of({}).values()) << bad;
        image.update(std::vector{bone.at()});
        EXPECT_EQ(image.values(), image_of({bone.at()}).values()) << bad;
    }
}

TEST(AttenuationImage, LeavesUnchangedBodiesAlone) {
    const Bone bone = block();
    AttenuationImage image = image_of({bone.at()});
    AttenuatingBody body = bone.at();
    body.changed = std::span<const std::size_t>{};
    image.update(std::vector{body});
    EXPECT_EQ(image.updated_voxels(), 0u);
}

TEST(AttenuationImage, FollowsSnapshotsOfThePresentBone) {
    const Body body = block().body;
    PresentBone present(body, 4096);
    AttenuationImage image = AttenuationImage::around(test::cube(24.0_mm), {.voxels = 96});
    const std::vector<BodyInImage> bodies(1);
    image.update(present.image(), bodies);
    image.update(present.image(), bodies);
    EXPECT_EQ(image.updated_voxels(), 0u);

    const ToolSolid bit({{0.0, 2.0_mm}, {-20.0_mm, 2.0_mm}});
    CutRecord record;
    record.from = record.to = test::pointing({0, 0, 0}, {0, 0, -1});
    (void)present.apply(record, bit);
    const BoneImage drilled = present.image();
    image.update(drilled, bodies);
    EXPECT_GT(image.updated_voxels(), 0u);
    EXPECT_LT(image.updated_voxels(), image.values().size() / 10);
    AttenuationImage anew = AttenuationImage::around(test::cube(24.0_mm), {.voxels = 96});
    anew.update(drilled, bodies);
    EXPECT_EQ(image.values(), anew.values());

    // Metal is not bone.
    image.update(drilled, std::vector{BodyInImage{.is_bone = false}});
    EXPECT_EQ(image.values(), image_of({}).values());
    image.update(drilled, bodies);
    EXPECT_EQ(image.values(), anew.values());
}

TEST(AttenuationImage, FillsHolesWithWaterAndCavitiesWithAir) {
    Bone bone = block();
    bone.body.hollow = LevelSet::build(bone.body.grid(), [](Vec3 p) {
        return length(p - Vec3{5.0_mm, 0, 0}) - 4.0_mm;
    });
    bone.cut = CutField(bone.body, 4096);
    bone.drill(2.0_mm, {-6.0_mm, 0, 20.0_mm}, {-6.0_mm, 0, 0});
    AttenuatingBody body = bone.at();
    EXPECT_EQ(at(image_of({body}), {5.0_mm, 0, 0}), 0);
    EXPECT_EQ(at(image_of({body}), {-6.0_mm, 0, 5.0_mm}), 64);
    body.has_air = false;
    EXPECT_EQ(at(image_of({body}), {5.0_mm, 0, 0}), 64);
}

}  // namespace
}  // namespace kerf::bone
