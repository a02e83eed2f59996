// SPDX-License-Identifier: Apache-2.0
// A shipped operation by events of mouse and keyboard on a display, from the event to the verdict.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/operation.h"
#include "tests/support/own_display.h"
#include "tests/support/windowed_operation.h"

namespace kerf::test {
namespace {

TEST(WindowOperation, BurrsAndDrillsByMouseAndKeys) {
    const OwnDisplay display;
    const run::Scene scene = scene_of(KERF_SOURCE_DIR "/procedures/pedicle-burr.yaml", "", {"accuracy.spacing=0.5 mm"});
    std::string error;
    const auto window = window::GlfwWindow::open("kerf", error);
    ASSERT_NE(window, nullptr) << error;
    OperationAtAWindow operation(scene, plugins(), *window);
    operation.drawn_each = 200;
    const WindowedOperation made = operation.on_virtual_clock("");
    const session::RunSummary& summary = made.outcome.summary;
    EXPECT_EQ(summary.verdict, session::Verdict::pass) << ::testing::PrintToString(summary.reasons);
    EXPECT_EQ(summary.hand, "mouse");
    EXPECT_GT(made.frames, 3000u);
    EXPECT_GE(made.legs_done + 1, made.legs);
}

}  // namespace
}  // namespace kerf::test
