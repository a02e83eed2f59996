// SPDX-License-Identifier: Apache-2.0
// A scene sees what was fitted, not the guess.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <optional>
#include <string>

#include "run/scene.h"
#include "tests/support/drill_rig.h"
#include "tests/support/temporary_folder.h"

namespace kerf::run {
namespace {

using namespace literals;

// A rod along z. The guess leans by 7° in the plane of y and z.
const char* const rod = R"(apiVersion: kerf/v1
kind: Anatomy
metadata: {id: rod, title: A rod of bone}
phantom: {parts: [{id: rod, tube: {from: 0 0 -40 mm, to: 0 0 40 mm, radius: 12 mm}}]}
tissues: [{id: bone, density: 1.5 g/cm3}]
landmarks:
  axes: {way: {from: 0 5 50 mm, to: 0 -3 -18 mm, fit: {tube: {radius: 11 mm}}, tolerance: 1 mm}}
  planes: {level: {at: 0 0 0 mm, normal: NORMAL, tolerance: 1 mm}}
)";

const char* const slot = R"(apiVersion: kerf/v1
kind: Procedure
metadata: {id: slot, title: A slot, version: 0.1.0, status: draft}
needs: {landmarks: [way, level], tissues: [bone]}
anatomy: rod.yaml
accuracy: {spacing: 0.5 mm}
haptics: {device: touch, force_scale: 1/50}
instruments:
  saw:
    plugin: kerf.sawing
    tool: oscillating_blade
    force: saw_cutting
    drives: {stroke_rate: 12000 1/min}
steps:
  - {id: saw, title: Saw, instrument: saw, axis: way, plane: level, goals: [{depth: {at_least: 10 mm}}]}
)";

std::optional<Scene> scene_with(const std::string& normal, text::Diagnostics& diagnostics) {
    const test::TemporaryFolder folder;
    std::string anatomy = rod;
    anatomy.replace(anatomy.find("NORMAL"), 6, normal);
    std::ofstream(folder / "rod.yaml") << anatomy;
    std::ofstream(folder / "slot.yaml") << slot;
    return make_scene(folder / "slot.yaml", "", test::plugins()).take(diagnostics);
}

TEST(FittedLandmarks, GiveStepsTheirAxes) {
    text::Diagnostics diagnostics;
    const auto scene = scene_with("0 1 0", diagnostics);
    ASSERT_TRUE(scene) << to_text(diagnostics);
    EXPECT_LT(length(scene->frames.at(0).along - Vec3{0, 0, -1.0}), 1e-6);
    EXPECT_LT(length(scene->frames[0].entry - Vec3{0, 0, 40.0_mm}), 0.1_mm /* a step along the axis */);
    EXPECT_FALSE(scene->anatomy.axes.at(0).fit);
}

TEST(FittedLandmarks, AreHeldInTheirPlane) {
    // Given a plane that the guess lies in, and the rod does not: it leans by 7°
    text::Diagnostics diagnostics;
    const auto scene = scene_with("0 0.9932 -0.1168", diagnostics);
    EXPECT_FALSE(scene);
    ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
    EXPECT_EQ(diagnostics[0].code, "E0507");
}

}  // namespace
}  // namespace kerf::run
