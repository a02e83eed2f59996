// SPDX-License-Identifier: Apache-2.0
#include "app/picked_bone.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>

#include "documents/names.h"
#include "documents/read_anatomy.h"
#include "tests/app/window/ball.h"

namespace kerf::app {
namespace {

using namespace literals;
using test::ball_centre, test::ball_radius, test::PickedFile;
using window::PickedLandmark, window::SurfacePoint;

double voxels_off(const PickedBone& bone, Vec3 p) {
    return uncut_distance(bone.body(), locate(bone.body(), p)) / bone.body().grid().spacing;
}

TEST(PickedBone, SnapsToAnAnalyticBall) {
    const PickedFile ball;
    int hits = 0;
    for (int i = 0; i < 200; ++i) {
        const double turn = 2.399963 * i, height = 1.0 - 2.0 * (i + 0.5) / 200.0,
                     wide = std::sqrt(1.0 - height * height);
        const Vec3 out{wide * std::cos(turn), wide * std::sin(turn), height};
        const Vec3 aim = ball_centre + 0.6 * ball_radius * cross(out, Vec3{0.36, -0.48, 0.8});  // off the centre
        const Vec3 from = ball_centre + 90.0_mm * out, along = normalized(aim - from);
        const auto point = ball.bone->surface_point(from, along);
        ASSERT_TRUE(point) << i;
        const double b = dot(from - ball_centre, along),
                     c = dot(from - ball_centre, from - ball_centre) - ball_radius * ball_radius;
        const Vec3 expected = from + (-b - std::sqrt(b * b - c)) * along;
        EXPECT_LT(std::abs(voxels_off(*ball.bone, point->position)), 0.01) << i;
        EXPECT_LT(length(point->position - expected), 0.02_mm) << i;
        EXPECT_GT(dot(point->normal, normalized(expected - ball_centre)), 0.999) << i;
        EXPECT_EQ(point->tissue, "cortical");
        ++hits;
    }
    EXPECT_EQ(hits, 200);
}

TEST(PickedBone, SnapsToATubeOffEveryAxis) {
    std::string text = test::ball_text;
    const std::string ball = "sphere: {centre: 3 -4 5 mm, radius: 20 mm}";
    text.replace(text.find(ball), ball.size(), "tube: {from: -20 -10 -30 mm, to: 25 15 40 mm, radius: 9 mm}");
    const PickedFile tube(text);
    const Vec3 a{-20.0_mm, -10.0_mm, -30.0_mm}, b{25.0_mm, 15.0_mm, 40.0_mm}, along = normalized(b - a);
    for (int i = 0; i < 60; ++i) {
        const Vec3 middle = a + (0.2 + 0.01 * i) * (b - a);
        const Vec3 out = normalized(cross(along, {std::cos(0.7 * i), std::sin(0.7 * i), 0.3}));
        const auto point = tube.bone->surface_point(middle + 60.0_mm * out, -1.0 * out);
        ASSERT_TRUE(point) << i;
        EXPECT_LT(std::abs(voxels_off(*tube.bone, point->position)), 0.01) << i;
        EXPECT_LT(length(point->position - (middle + 9.0_mm * out)), 0.03_mm) << i;
    }
}

TEST(PickedBone, FindsNoPointBesideBone) {
    const PickedFile ball;
    EXPECT_FALSE(ball.bone->surface_point(ball_centre + Vec3{0, 0, 90.0_mm}, {0, 0, 1}));
    EXPECT_FALSE(ball.bone->surface_point(ball_centre + Vec3{20.6_mm, 0, 90.0_mm}, {0, 0, -1}));
    EXPECT_FALSE(ball.bone->surface_point(ball_centre, {0, 0, 1})) << "it leaves the bone";
    EXPECT_FALSE(ball.bone->surface_point({NAN, 0, 0}, {0, 0, -1}));
    EXPECT_FALSE(ball.bone->surface_point(ball_centre, {0, 0, 0}));
}

/// Returns the point in front of the ball, as seen from `out`.
Vec3 seen_from(const PickedBone& bone, Vec3 out) {
    return bone.surface_point(ball_centre + 90.0_mm * out, -1.0 * out).value_or(SurfacePoint{}).position;
}

TEST(PickedBone, WritesLandmarksThatReadBack) {
    PickedFile ball;
    const Vec3 tip = seen_from(*ball.bone, normalized(Vec3{1, 2, 3})), base = seen_from(*ball.bone, {-1, 0, 0});
    EXPECT_EQ(ball.bone->write({{.id = "tip", .at = tip}, {.id = "across", .at = base, .to = tip}}), "");
    EXPECT_TRUE(test::contents_of(ball.file).starts_with(test::ball_text));
    const auto anatomy = documents::read_anatomy(ball.file);
    ASSERT_TRUE(anatomy);
    EXPECT_LT(length(documents::find_id(anatomy->points, "tip")->at - tip), 0.01_mm);
    EXPECT_LT(length(documents::find_id(anatomy->axes, "across")->to - tip), 0.01_mm);
    EXPECT_EQ(ball.bone->written().size(), 2U);
    // The next one goes to the same file.
    EXPECT_EQ(ball.bone->write({{.id = "base", .at = base}}), "");
    EXPECT_EQ(ball.bone->written().size(), 3U);
    ball.open();
    EXPECT_EQ(ball.bone->written().size(), 3U);
}

/// A box in RAS and centimetres: x 1 to 3, y 0.5 to 2, z −1 to 1.
void write_box(const std::string& file) {
    std::ofstream obj(file);
    for (int i = 0; i < 8; ++i)
        obj << "v " << ((i & 1) != 0 ? 3 : 1) << ' ' << ((i & 2) != 0 ? 2.0 : 0.5) << ' ' << ((i & 4) != 0 ? 1 : -1)
            << '\n';
    obj << "f 1 3 4\nf 1 4 2\nf 5 6 8\nf 5 8 7\nf 1 2 6\nf 1 6 5\nf 3 7 8\nf 3 8 4\nf 1 5 7\nf 1 7 3\nf 2 4 8\nf 2 8 "
           "6\n";
}

TEST(PickedBone, WritesTheFrameOfTheDocument) {
    PickedFile box;
    write_box(box.folder / "box.obj");
    std::string text = test::ball_text;
    const std::size_t begin = text.find("phantom:");
    text.replace(begin, text.find("tissues:") - begin, "mesh: {file: box.obj, unit: cm, frame: RAS}\n");
    std::ofstream(box.file) << text;
    box.open();
    // Towards the back, onto the front of the box. In LPS it lies at the right of the patient.
    const auto point = box.bone->surface_point({-22.0_mm, -60.0_mm, 3.0_mm}, {0, 1, 0});
    ASSERT_TRUE(point);
    EXPECT_LT(length(point->position - Vec3{-22.0_mm, -20.0_mm, 3.0_mm}), 0.02_mm);
    EXPECT_EQ(box.bone->write({{.id = "front", .at = point->position}}), "");
    const auto anatomy = documents::read_anatomy(box.file);
    ASSERT_TRUE(anatomy);
    const Vec3 read = documents::find_id(anatomy->points, "front")->at;
    EXPECT_LT(length(read - point->position), 0.01_mm);
    EXPECT_LT(std::abs(voxels_off(*box.bone, read)), 0.05);
}

TEST(PickedBone, RefusesToWriteWhatItMustNot) {
    PickedFile ball;
    const std::vector<PickedLandmark> picked{{.id = "tip", .at = seen_from(*ball.bone, {0, 0, 1})}};
    const auto refused = [&](const std::string& words, const std::vector<PickedLandmark>& landmarks) {
        const std::string before = test::contents_of(ball.file), refusal = ball.bone->write(landmarks);
        EXPECT_NE(refusal.find(words), std::string::npos) << refusal;
        EXPECT_EQ(test::contents_of(ball.file), before);
        EXPECT_FALSE(std::filesystem::exists(ball.file + ".part"));
    };
    refused("must lie", {{.id = "off", .at = ball_centre}});  // `lies: on_bone`, and it lies inside
    chmod(ball.file.c_str(), 0444);
    refused("protected against writing", picked);
    chmod(ball.file.c_str(), 0600);
    std::ofstream(ball.file, std::ios::app) << "# changed\n";
    refused("has changed", picked);
    ball.open(ball.folder.path());
    refused("belongs to Kerf", picked);
    ball.open();
    EXPECT_EQ(ball.bone->write(picked), "");
    EXPECT_EQ(std::filesystem::status(ball.file).permissions(),
              std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST(PickedBone, WritesThroughALink) {
    PickedFile ball;
    std::filesystem::rename(ball.file, ball.folder / "real.yaml");
    std::filesystem::create_symlink("real.yaml", ball.file);
    EXPECT_EQ(ball.bone->write({{.id = "tip", .at = seen_from(*ball.bone, {0, 0, 1})}}), "");
    EXPECT_TRUE(std::filesystem::is_symlink(ball.file));
    EXPECT_NE(test::contents_of(ball.folder / "real.yaml").find("tip:"), std::string::npos);
}

TEST(PickedBone, RefusesNames) {
    PickedFile ball(test::ball_text + "landmarks: {points: {tip: {at: 3 -4 25 mm, tolerance: 1 mm}}}\n");
    EXPECT_EQ(ball.bone->problem_of_name("base_2"), "");
    EXPECT_NE(ball.bone->problem_of_name("tip").find("already"), std::string::npos);
    for (const char* name : {"", "a b", "_a", "null", "ä", "a: b"})
        EXPECT_NE(ball.bone->problem_of_name(name), "") << name;
    EXPECT_NE(ball.bone->problem_of_name(std::string(65, 'a')), "");
}

TEST(PickedBone, OpensAFileWhoseLandmarksAreOff) {
    const PickedFile ball(test::ball_text +
                          "landmarks: {points: {tip: {at: 3 -4 95 mm, tolerance: 1 mm, lies: on_bone}}}\n");
    EXPECT_EQ(ball.bone->written().size(), 1U);
}

}  // namespace
}  // namespace kerf::app
