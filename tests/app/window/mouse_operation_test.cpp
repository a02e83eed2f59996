// SPDX-License-Identifier: Apache-2.0
// A step led by keys of the window, on a virtual clock: from the input to the verdict.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "app/window/offscreen.h"
#include "app/window/run_screen.h"
#include "run/live_run.h"
#include "run/view/run_view.h"
#include "tests/support/operation.h"
#include "tests/support/short_scene.h"

namespace kerf::window {
namespace {

/// A person at the window: sees what it shows sixty times a second of the run, and presses keys.
class PersonAtTheWindow final : public run::TickClock {
public:
    /// @param enough  [N] force on the drill at which the person waits
    PersonAtTheWindow(RunScreen& screen, double enough) : screen_(&screen), enough_(enough) {}

    std::uint32_t wait() noexcept override {
        if (ticks_++ % 16 == 0) {
            act();
            screen_->update(1e-3 * static_cast<double>(ticks_));
        }
        return 0;
    }

private:
    void act() {
        const run::ViewedState& state = screen_->state();
        if (ticks_ == 1) press('T', true);  // latches the drive
        constexpr double deep = 4e-3, out = -4e-3;
        if (state.depth > deep) is_withdrawing_ = true;
        if (state.depth < out || state.step > 0) is_withdrawing_ = false;
        if (state.step > 0) return;
        press('W', !is_withdrawing_ && state.force < enough_);
        press('S', is_withdrawing_);
    }
    void press(int key, bool is_pressed) {
        screen_->take({.kind = Input::Kind::key, .code = key, .is_pressed = is_pressed});
    }

    RunScreen* screen_;
    double enough_;
    std::uint64_t ticks_ = 0;
    bool is_withdrawing_ = false;
};

/// Returns the end of the first step: drilling through the cortex.
session::StepRow opened_by_keys(double enough) {
    const run::Scene scene = test::scene_of(KERF_SOURCE_DIR "/procedures/pedicle-awl.yaml", "",
                                            {"accuracy.spacing=0.5 mm", "time_limit=60 s"});
    std::string error;
    const auto offscreen = Offscreen::open(64, 64, error);
    if (offscreen == nullptr) throw std::runtime_error(error);
    run::RunView view(scene, {.mode = "practice", .hand = "mouse"});
    run::MouseBox box;
    view.let_mouse_lead(box);
    RunScreen screen(view);
    screen.draw(1280, 800, 0.0);
    PersonAtTheWindow person(screen, enough);
    run::RunRequest request;
    request.observers = {&view};
    const run::RunOutcome outcome = run::run_on_clock(scene, test::plugins(), request, person, box);
    EXPECT_EQ(outcome.summary.hand, "mouse");
    return outcome.summary.steps.front();
}

TEST(MouseOperation, DrillsThroughTheCortexByKeys) {
    const session::StepRow step = opened_by_keys(30.0);
    EXPECT_TRUE(step.done);
    EXPECT_TRUE(step.broken_limits.empty());
}

// The push that has grown in the cortex drives the drill on when the cortex breaks.
TEST(MouseOperation, PlungesIfThePersonLeansOnTheDrill) {
    const session::StepRow step = opened_by_keys(1000.0);
    EXPECT_EQ(step.broken_limits, std::vector<std::string>{"depth"});
}

}  // namespace
}  // namespace kerf::window
