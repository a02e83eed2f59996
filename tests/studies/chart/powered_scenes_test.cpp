// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <stdexcept>
#include <string>

#include "studies/chart/drill/scene.h"
#include "studies/chart/powered/powered_measure.h"
#include "tests/studies/papers/as_printed/printed_rig.h"

namespace kerf::chart {
namespace {

const Plugins& plugins() {
    static const Plugins found{&test::own_plugins(), &test::printed_plugins()};
    return found;
}
PoweredMethod powered_method(const PoweredScene& scene, const std::string& id) {
    for (const PoweredMethod& one : powered_methods(plugins(), scene, false))
        if (one.id == id) return one;
    throw std::runtime_error("no method " + id);
}

TEST(PoweredScenes, HaveNamesOfTheirOwn) {
    std::set<std::string> ids;
    for (const Scene& scene : all_scenes()) ids.insert(scene.id);
    for (const PoweredScene& scene : all_powered_scenes()) EXPECT_TRUE(ids.insert(scene.id).second) << scene.id;
}

TEST(PoweredScenes, BeginInAirAndStayWithinTheirBoxes) {
    for (const PoweredScene& scene : all_powered_scenes()) {
        EXPECT_LT(scene.bone.tissue_at(scene.path.front().position), 0) << scene.id;
        for (const Pose& pose : scene.path) {
            const Vec3 p = pose.position;
            EXPECT_TRUE(scene.bone.surface(p) > 0.0 ||
                        (p.x > scene.bone.low.x && p.x < scene.bone.high.x && p.y > scene.bone.low.y &&
                         p.y < scene.bone.high.y && p.z > scene.bone.low.z && p.z < scene.bone.high.z))
                << scene.id;
        }
    }
}

TEST(PoweredScenes, HaveAnExactLawOfTheirPlugin) {
    for (const PoweredScene& scene : all_powered_scenes()) EXPECT_EQ(why_no_exact_law(plugins(), scene), "");
    PoweredScene other = burr_groove_scene();
    other.needs.push_back("no_such_parameter");
    EXPECT_NE(why_no_exact_law(plugins(), other).find("rebuild"), std::string::npos);
    const PluginRegistry none;
    EXPECT_NE(why_no_exact_law({&none, &none}, other).find("kerf.burring"), std::string::npos);
}

TEST(PoweredMethods, TheLawOnFieldsComesNearTheExactGroove) {
    const PoweredScene scene = burr_groove_scene();
    const PoweredReference exact = reference_along(plugins(), scene, prescribed_motion(scene), true);
    const auto at = [&](const char* id, Fineness fineness) {
        return measure_powered(plugins(), powered_method(scene, id), scene, exact, fineness, 1, 1.0);
    };
    const Measured fields = at("M10", {0.125e-3, 336, {}}), voxels = at("M2", {0.25e-3, 84, {}});
    EXPECT_LT(fields.force_error, 0.08);
    EXPECT_LT(fields.volume_error, 0.005);
    EXPECT_LT(fields.force_error, 0.5 * voxels.force_error);
    EXPECT_EQ(fields.exact_share, 1.0);
}

TEST(PoweredMethods, VoxelsThatGoInTheEndAreFeltAgain) {  // S-12
    const PoweredScene scene = burr_groove_scene();
    const auto fails = [&](const char* id) {
        return powered_standing(plugins(), powered_method(scene, id), scene, {0.25e-3, 84, {}}).fails;
    };
    const auto voxels = fails("M2");
    EXPECT_NE(std::find(voxels.begin(), voxels.end(), "S-12"), voxels.end());
    EXPECT_TRUE(fails("M10").empty());
}

TEST(PoweredScenes, GrazingHasNoForceOnTheWayBack) {
    const PoweredScene scene = grazing_scene();
    const PoweredReference exact = reference_along(plugins(), scene, prescribed_motion(scene), true);
    double there = 0.0, back = 0.0;
    for (std::size_t t = 0; t < scene.ticks(); ++t) {
        const Vec3 step = scene.path[t + 1].position - scene.path[t].position;
        double& most = step.x > 0.0 ? there : back;
        if (step.x != 0.0) most = std::max(most, length(linear(exact.wrench[t])));
    }
    EXPECT_GT(there, 1.0) << "50 um deep";
    EXPECT_LT(back, 1e-3) << "coplanar with its own groove";
}

TEST(PoweredMethods, TheSameRunGivesTheSameFigures) {
    PoweredScene scene = burr_groove_scene();
    scene.path.resize(4000);
    const PoweredReference exact = reference_along(plugins(), scene, prescribed_motion(scene), true);
    const auto once = [&] {
        return measure_powered(plugins(), powered_method(scene, "M10"), scene, exact, {0.25e-3, 84, {}}, 1, 1.0);
    };
    const Measured a = once(), b = once();
    EXPECT_EQ(a.force_error, b.force_error);
    EXPECT_EQ(a.torque_error, b.torque_error);
    EXPECT_EQ(a.volume_error, b.volume_error);
}

}  // namespace
}  // namespace kerf::chart
