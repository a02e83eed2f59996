// SPDX-License-Identifier: Apache-2.0
#include "devices/openhaptics/hd.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace kerf::openhaptics {
namespace {

void set_transform(double (&transform)[16], const Quat& rotation, Vec3 millimetres) {
    const Vec3 columns[] = {rotate(rotation, {1, 0, 0}), rotate(rotation, {0, 1, 0}), rotate(rotation, {0, 0, 1}),
                            millimetres};
    for (int i = 0; i < 4; ++i) {
        transform[4 * i] = columns[i].x;
        transform[4 * i + 1] = columns[i].y;
        transform[4 * i + 2] = columns[i].z;
        transform[4 * i + 3] = i == 3 ? 1.0 : 0.0;
    }
}

TEST(HdTransform, GivesAnyRotation) {
    for (const Vec3 r : {Vec3{3.1, 0.2, 0.1}, {0.1, 3.1, 0.2}, {0.2, 0.1, 3.1}, {0.3, -0.4, 0.5}, {0, 0, 0}}) {
        const Quat q = quat_from_rotation_vector(r);
        double transform[16] = {};
        set_transform(transform, q, {10, 20, 30});
        const auto pose = pose_of(transform);
        ASSERT_TRUE(pose);
        EXPECT_NEAR(length(pose->position - Vec3{0.01, 0.02, 0.03}), 0.0, 1e-15);
        const Quat& p = pose->rotation;
        EXPECT_NEAR(std::abs(p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z), 1.0, 1e-12);
    }
}

TEST(HdTransform, RefusesWhatIsNoPose) {
    double none[16] = {}, mirrored[16] = {}, far[16] = {};
    EXPECT_FALSE(pose_of(none));
    set_transform(mirrored, {1, 0, 0, 0}, {});
    mirrored[10] = -1.0;
    EXPECT_FALSE(pose_of(mirrored));
    set_transform(far, {1, 0, 0, 0}, {std::nan(""), 0, 0});
    EXPECT_FALSE(pose_of(far));
}

TEST(HdErrors, AreNamedInWords) {
    EXPECT_EQ(text_of({.code = 0x302, .internal = -28, .device = 0}),
              "communication with the device failed (0x302, internal -28)");
    EXPECT_NE(advice_for(0x302).find("cable"), std::string::npos);
    EXPECT_NE(text_of({.code = 0x999, .internal = 1, .device = 0}).find("0x999"), std::string::npos);
    EXPECT_EQ(advice_for(0x999), "");
}

TEST(HdCalibration, PrefersTheInkwell) {
    EXPECT_EQ(preferred_style(7), 4u);
    EXPECT_EQ(preferred_style(3), 2u);
    EXPECT_EQ(preferred_style(1), 1u);
    EXPECT_EQ(preferred_style(0), 0u);
    EXPECT_EQ(calibration_advice(4), "Put the stylus into the inkwell.");
}

}  // namespace
}  // namespace kerf::openhaptics
