// SPDX-License-Identifier: Apache-2.0
#include "app/window/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace kerf::window {
namespace {

glm::vec3 in_picture(const Camera& camera, Vec3 at) {
    const glm::vec4 clip = camera.clip_from_view(1.0) * camera.view_from_world() * glm::vec4(single(at), 1.0f);
    return glm::vec3(clip) / clip.w;
}

TEST(Camera, SeesItsTargetInTheMiddleAndUpUpwards) {
    Camera camera;
    camera.see({0.01, 0.02, 0.03}, 0.05, {0, 1, 0}, {0, 0, 1});
    const glm::vec3 middle = in_picture(camera, {0.01, 0.02, 0.03}), above = in_picture(camera, {0.01, 0.02, 0.05});
    EXPECT_NEAR(middle.x, 0.0f, 1e-5f);
    EXPECT_NEAR(middle.y, 0.0f, 1e-5f);
    EXPECT_GT(above.y, 0.1f);
    EXPECT_NEAR(above.x, 0.0f, 1e-5f);
}

TEST(Camera, SeesASphereWhole) {
    Camera camera;
    camera.see({0, 0, 0}, 0.05, {0, 1, 0}, {0, 0, 1});
    EXPECT_LT(in_picture(camera, {0.049, 0, 0}).x, 1.0f);
    EXPECT_GT(std::abs(in_picture(camera, {0.055, 0, 0}).x), 1.0f);
}

TEST(Camera, OrbitsByTheAngle) {
    Camera camera;
    camera.see({0, 0, 0}, 0.05, {0, 1, 0}, {0, 0, 1});
    camera.orbit(0.3, 0.0);
    const Vec3 after = camera.towards();
    EXPECT_NEAR(std::acos(after.y), 0.3, 1e-9);
    EXPECT_NEAR(after.z, 0.0, 1e-9);
    camera.orbit(0.0, 0.4);
    EXPECT_NEAR(std::asin(camera.towards().z), -0.4, 1e-9);
    EXPECT_NEAR(dot(camera.up(), camera.towards()), 0.0, 1e-12);
}

TEST(Camera, TurnsTheNearSideWithTheMouse) {
    for (const auto& [right, up] : {std::pair{0.3, 0.2}, {-0.3, 0.2}, {0.3, -0.2}}) {
        Camera camera;
        camera.see({0, 0, 0}, 0.05, {0, 1, 0}, {0, 0, 1});
        camera.orbit(right, up);
        const glm::vec3 near = in_picture(camera, {0, 0.03, 0});
        EXPECT_GT(near.x * right, 0.0) << right << ' ' << up;
        EXPECT_GT(near.y * up, 0.0) << right << ' ' << up;
    }
}

TEST(Camera, PansByFractionsOfTheHeight) {
    Camera camera;
    camera.see({0, 0, 0}, 0.05, {0, 1, 0}, {0, 0, 1});
    camera.pan(0.25, -0.1);
    const glm::vec3 at = in_picture(camera, {0, 0, 0});  // −1 … 1 over the whole height
    EXPECT_NEAR(at.x, 0.5f, 1e-5f) << "what is seen follows the mouse";
    EXPECT_NEAR(at.y, -0.2f, 1e-5f);
}

TEST(Camera, ZoomsWithinItsRange) {
    Camera camera;
    camera.see({0, 0, 0}, 0.05, {0, 1, 0}, {0, 0, 1});
    const double height = camera.height_at_target();
    camera.zoom(0.5);
    EXPECT_NEAR(camera.height_at_target(), 0.5 * height, 1e-12);
    camera.zoom(1e-6);
    EXPECT_NEAR(length(camera.eye()), 5e-3, 1e-12);
    camera.zoom(1e6);
    EXPECT_NEAR(length(camera.eye()), 3.0, 1e-12);
}

TEST(Camera, ShowsAPointWhereItsRayGoes) {
    Camera camera;
    camera.see({0.01, 0.02, 0.03}, 0.05, {0.3, 1, 0.2}, {0, 0, 1});
    constexpr double aspect = 1.6;
    for (const double right : {-0.7, 0.2})
        for (const double up : {-0.4, 0.9}) {
            const Vec3 point = camera.eye() + 0.2 * camera.direction_through(right, up, aspect);
            const auto shown = camera.shown_at(point, aspect);
            ASSERT_TRUE(shown);
            EXPECT_NEAR(shown->x, right, 1e-6);
            EXPECT_NEAR(shown->y, up, 1e-6);
            const glm::vec4 clip =
                camera.clip_from_view(aspect) * camera.view_from_world() * glm::vec4(single(point), 1.0f);
            EXPECT_NEAR(clip.x / clip.w, right, 1e-4);
            EXPECT_NEAR(clip.y / clip.w, up, 1e-4);
        }
    EXPECT_FALSE(camera.shown_at(camera.eye() + 0.1 * camera.towards(), aspect)) << "behind the eye";
}

TEST(Camera, IsSoundForADegenerateView) {
    Camera camera;
    camera.see({0, 0, 0}, 0.0, {0, 0, 0}, {0, 1, 0});
    EXPECT_TRUE(is_finite(camera.eye()));
    EXPECT_NEAR(length(camera.up()), 1.0, 1e-12);
    camera.see({0, 0, 0}, 0.1, {0, 0, 1}, {0, 0, 1});
    EXPECT_NEAR(dot(camera.up(), camera.towards()), 0.0, 1e-12);
}

}  // namespace
}  // namespace kerf::window
