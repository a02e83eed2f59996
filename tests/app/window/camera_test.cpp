// SPDX-License-Identifier: Apache-2.0
#include "app/window/camera.h"

#include <gtest/gtest.h>

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
    EXPECT_NEAR(std::asin(camera.towards().z), 0.4, 1e-9);
    EXPECT_NEAR(dot(camera.up(), camera.towards()), 0.0, 1e-12);
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
