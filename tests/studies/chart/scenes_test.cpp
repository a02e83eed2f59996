// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>

#include "kerf/units.hpp"
#include "studies/chart/drill/scene.h"

namespace kerf::chart {
namespace {

using namespace literals;

TEST(Scenes, BeginInAirAndStayWithinTheirBoxes) {
    for (const Scene& scene : all_scenes()) {
        const Pose start = scene.pose_at(scene.depth.front());
        for (int edge = 0; edge < edge_count; ++edge)
            for (double angle = 0.0; angle < 2.0 * pi; angle += 0.3) {
                const Vec3 corner = place_on_edge(scene.drill, edge, span_of(scene.drill, edge).to, angle);
                EXPECT_EQ(scene.bone.tissue_at(start * corner), -1) << scene.id;
                const double deepest = *std::max_element(scene.depth.begin(), scene.depth.end());
                const Vec3 end = scene.pose_at(deepest) * corner;
                EXPECT_TRUE(scene.bone.tissue_at(end) < 0 ||
                            (end.x > scene.bone.low.x && end.x < scene.bone.high.x && end.y > scene.bone.low.y &&
                             end.y < scene.bone.high.y && end.z > scene.bone.low.z && end.z < scene.bone.high.z))
                    << scene.id;
            }
    }
}

TEST(Scenes, HaveNamesOfTheirOwn) {
    std::set<std::string> ids;
    for (const Scene& scene : all_scenes()) EXPECT_TRUE(ids.insert(scene.id).second) << scene.id;
    EXPECT_EQ(ids.size(), 8u);
}

TEST(Scenes, FeedNoFasterThanTheyAreTold) {
    for (const Scene& scene : all_scenes())
        for (std::size_t t = 0; t < scene.ticks(); ++t)
            EXPECT_LE(std::abs(scene.depth[t + 1] - scene.depth[t]), 1.0_mm + 1e-12) << scene.id;
}

TEST(Scenes, ThePedicleIsThatOfL4) {
    const Scene scene = pedicle_scene(0.0);
    EXPECT_NEAR(std::acos(-scene.along.y) / 1.0_deg, 17.7, 0.1) << "its transverse angle";
    EXPECT_EQ(scene.bone.tissues.size(), 2u);
    EXPECT_NEAR(scene.bone.surface(scene.entry), 0.0, 2.0_um);
    EXPECT_EQ(scene.bone.tissues[static_cast<std::size_t>(scene.bone.tissue_at(scene.pose_at(10.0_mm).position))].id,
              "cancellous");
}

TEST(Scenes, TheBreachOpensTheCanalAndThePlannedWayDoesNot) {
    const auto is_open = [](const Scene& scene) {
        for (double depth = 8.0_mm; depth < 22.0_mm; depth += 0.2_mm)
            for (double angle = 0.0; angle < pi; angle += 0.2)
                for (const int lip : {0, 1})
                    if (scene.bone.tissue_at(scene.pose_at(depth) *
                                             place_on_edge(scene.drill, lip, span_of(scene.drill, lip).to, angle)) < 0)
                        return true;
        return false;
    };
    EXPECT_FALSE(is_open(pedicle_scene(0.0)));
    EXPECT_TRUE(is_open(pedicle_scene(medial_breach)));
}

}  // namespace
}  // namespace kerf::chart
