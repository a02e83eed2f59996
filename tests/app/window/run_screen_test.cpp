// SPDX-License-Identifier: Apache-2.0
// The picture of a run, drawn without a display. All cases use one drawn run.
#include "app/window/run_screen.h"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>

#include "app/window/offscreen.h"
#include "run/run_procedure.h"
#include "run/view/recorded_view.h"
#include "run/view/run_view.h"
#include "tests/app/window/made_run.h"
#include "tests/support/short_scene.h"

namespace kerf::window {
namespace {

constexpr int width = 1280, height = 800;

/// The short scene after its run, on a screen. A lateral radiograph was requested by keys before the first tick.
struct Shown {
    std::unique_ptr<Offscreen> offscreen;
    run::RunView view{test::short_scene(), {.mode = "practice", .hand = "rehearsal expert"}};
    std::unique_ptr<RunScreen> screen;

    Shown() {
        std::string error;
        offscreen = Offscreen::open(width, height, error);
        if (offscreen == nullptr) throw std::runtime_error(error);
        screen = std::make_unique<RunScreen>(view);
        view.request_inspection(true);
        press('A');
        press('F');
        run::RunRequest request;
        request.observers = {&view};
        static_cast<void>(run::run_procedure(test::short_scene(), test::plugins(), request));
        for (int i = 0; i < 2000 && view.radiograph() == nullptr; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    Pixels picture(int wide = width, int tall = height) {
        screen->draw(wide, tall, wall += 0.02);
        return screen->pixels();
    }
    void press(int key) { screen->take({.kind = Input::Kind::key, .code = key, .is_pressed = true}); }
    double wall = 0.0;
};

Shown& shown() {
    static Shown one;
    return one;
}

struct Region {
    int left = 0, top = 0, right = width, bottom = height;
};
constexpr Region picture_region{240, 90, 980, 750}, left_panel{0, 40, 230, 750}, plot_above_zero{1020, 80, 1265, 172};

/// Counts the pixels of a region for which `is_one(red, green, blue)` is true.
template <class IsOne>
int count(const Pixels& pixels, const Region& region, const IsOne& is_one) {
    int found = 0;
    for (int y = region.top; y < region.bottom; ++y)
        for (int x = region.left; x < region.right; ++x) {
            const std::uint8_t* p = &pixels.rgb[3 * static_cast<std::size_t>(y * pixels.width + x)];
            found += is_one(int{p[0]}, int{p[1]}, int{p[2]}) ? 1 : 0;
        }
    return found;
}
const auto is_bone = [](int r, int g, int b) { return r > 110 && r > g && g > b && r - b < 90 && r - b > 12; };
const auto is_zone = [](int r, int g, int b) { return r > g + 40 && b > g + 25; };
const auto is_steel = [](int r, int g, int b) { return r > 120 && std::abs(r - g) < 12 && b >= g && b - r < 25; };
const auto is_plan = [](int r, int g, int b) { return b > r + 80 && b > g + 30; };
const auto is_plotted = [](int r, int g, int b) { return r > 200 && g > 200 && b > 200; };

TEST(RunScreen, ShowsBoneToolZonesAndPlan) {
    const Pixels pixels = shown().picture();
    EXPECT_GT(count(pixels, picture_region, is_bone), 30'000);
    EXPECT_GT(count(pixels, picture_region, is_steel), 2'000);
    EXPECT_GT(count(pixels, picture_region, is_zone), 1'000);
    EXPECT_GT(count(pixels, picture_region, is_plan), 200);
}

TEST(RunScreen, DrawsTheSamePictureTwice) {
    const Pixels first = shown().picture(), second = shown().picture();
    EXPECT_EQ(first.rgb, second.rgb);
}

TEST(RunScreen, HidesZonesPlanAndForceByKeys) {
    for (const int key : {'Z', 'P', 'V'}) shown().press(key);
    const Pixels pixels = shown().picture();
    for (const int key : {'Z', 'P', 'V'}) shown().press(key);
    EXPECT_EQ(count(pixels, picture_region, is_zone), 0);
    EXPECT_LT(count(pixels, picture_region, is_plan), 20);
    EXPECT_GT(count(pixels, picture_region, is_bone), 30'000);
}

TEST(RunScreen, SeesThroughBone) {
    shown().press('Z');
    const int solid = count(shown().picture(), picture_region, is_bone);
    shown().press('X');
    const int through = count(shown().picture(), picture_region, is_bone);
    shown().press('X');
    shown().press('Z');
    EXPECT_LT(through, solid / 10);
}

TEST(RunScreen, CutsBoneAway) {
    const int whole = count(shown().picture(), picture_region, is_bone);
    shown().press('C');
    const Pixels cut = shown().picture();
    shown().press('C');
    EXPECT_NE(count(cut, picture_region, is_bone), whole);
    EXPECT_GT(count(cut, picture_region, is_bone), whole / 10);
}

TEST(RunScreen, PlotsTheForceUpToTheShownTime) {
    const int at_end = count(shown().picture(), plot_above_zero, is_plotted);
    shown().screen->timeline().show_at(0.1);
    const int at_start = count(shown().picture(), plot_above_zero, is_plotted);
    EXPECT_NEAR(shown().screen->state().time, 0.1, 17e-3);
    shown().screen->timeline().follow();
    EXPECT_EQ(at_start, 0);
    EXPECT_GT(at_end, 100);
}

TEST(RunScreen, ShowsTheRadiographThatWasTakenByKeys) {
    ASSERT_NE(shown().view.radiograph(), nullptr);
    EXPECT_EQ(shown().view.radiograph()->words, "lateral");
    EXPECT_EQ(shown().view.radiograph()->shot, 1);
    shown().press('E');  // closes the card
    constexpr Region right_panel{width - 292, 300, width, 760};
    const auto is_grey = [](int r, int g, int b) { return r == g && g == b && r > 30 && r < 230; };
    const auto is_black = [](int r, int g, int b) { return r + g + b < 12; };
    const Pixels pixels = shown().picture();
    EXPECT_GT(count(pixels, right_panel, is_grey), 20'000) << "a circle of at least 200 pixels";
    EXPECT_GT(count(pixels, right_panel, is_black), 4'000) << "around the circle";
    shown().screen->timeline().show_at(0.0);
    const Pixels before = shown().picture();
    shown().screen->timeline().follow();
    EXPECT_LT(count(before, right_panel, is_grey), 500) << "it is not yet taken";
    shown().press('E');
}

TEST(RunScreen, ShowsTheLayersOfAnInspectionByKey) {
    const Pixels before = shown().picture();
    constexpr Region slices{250, 490, 700, 725}, values{1010, 240, 1260, 700};
    const auto is_edge = [](int r, int g, int b) { return r > 200 && g > 110 && g < 175 && b < 100; };
    const auto is_tissue = [](int r, int g, int b) { return r > 100 && r > b + 15 && g > b; };
    const auto is_text = [](int r, int g, int b) { return r > 150 && g > 150 && b > 150; };
    shown().press(Input::f4);
    const Pixels all = shown().picture();
    EXPECT_GT(count(all, picture_region, is_edge), 50) << "arrows and edges in bone";
    EXPECT_GT(count(all, slices, is_tissue), 3'000);
    EXPECT_GT(count(all, values, is_text), 1'000);
    shown().press(Input::f4);
    const Pixels contacts = shown().picture();
    shown().press(Input::f4);
    const Pixels field = shown().picture();
    shown().press(Input::f4);
    const Pixels coupling = shown().picture();
    EXPECT_NE(contacts.rgb, field.rgb);
    EXPECT_NE(field.rgb, coupling.rgb);
    EXPECT_NE(coupling.rgb, contacts.rgb);
    shown().press(Input::f4);
    shown().press('3');
    EXPECT_EQ(before.rgb, shown().picture().rgb);
}

TEST(RunScreen, ReportsATimeWithoutInspection) {
    shown();  // has a context of OpenGL
    MadeRun run;
    run.pass_to(1.0);
    RunScreen screen(run);
    screen.draw(width, height, 0.0);
    const Pixels before = screen.pixels();
    screen.inspect(all_layers);
    screen.draw(width, height, 0.02);
    const auto is_warning = [](int r, int g, int b) { return r > 180 && g > 110 && b < 60; };
    constexpr Region top{240, 84, 980, 120};
    EXPECT_GT(count(screen.pixels(), top, is_warning), 200);
    EXPECT_EQ(count(before, top, is_warning), 0);
}

TEST(RunScreen, HidesThePanels) {
    const auto is_panel = [](int r, int g, int b) { return r == 0x12 && g == 0x16 && b == 0x1b; };
    EXPECT_GT(count(shown().picture(), left_panel, is_panel), 100'000);
    shown().press(Input::tab);
    EXPECT_EQ(count(shown().picture(), left_panel, is_panel), 0);
    shown().press(Input::tab);
}

TEST(RunScreen, ListsItsKeys) {
    const Pixels before = shown().picture();
    shown().press(Input::f1);
    const Pixels with_keys = shown().picture();
    shown().press(Input::escape);
    EXPECT_NE(before.rgb, with_keys.rgb);
    EXPECT_EQ(before.rgb, shown().picture().rgb);
}

TEST(RunScreen, TurnsWithTheMouse) {
    const Pixels before = shown().picture();
    shown().screen->take({.kind = Input::Kind::move, .x = 600, .y = 400});
    shown().screen->take({.kind = Input::Kind::button, .code = 1, .is_pressed = true});
    shown().screen->take({.kind = Input::Kind::move, .x = 700, .y = 380});
    shown().screen->take({.kind = Input::Kind::button, .code = 1, .is_pressed = false});
    EXPECT_NE(before.rgb, shown().picture().rgb);
    shown().press('3');
    EXPECT_EQ(before.rgb, shown().picture().rgb);
}

TEST(RunScreen, ScrubsOnTheTimeLine) {
    const double end = shown().screen->state().time;
    const Layout layout{width, height, true};
    const float x = layout.line_from() + 0.1f * (layout.line_to() - layout.line_from());
    shown().screen->take({.kind = Input::Kind::move, .x = x, .y = height - 10});
    shown().screen->take({.kind = Input::Kind::button, .code = 0, .is_pressed = true});
    shown().screen->take({.kind = Input::Kind::button, .code = 0, .is_pressed = false});
    shown().picture();
    EXPECT_NEAR(shown().screen->state().time, 0.1 * std::max(30.0, 1.25 * end), 0.05);
    shown().press('L');
    shown().picture();
    EXPECT_EQ(shown().screen->state().time, end);
}

/// Returns a failed run after its end; two of its deductions have a time.
MadeRun ended_run() {
    shown();  // has a context of OpenGL
    MadeRun run;
    run.pass_to(10.0);
    run.state_.is_over = true;
    run.result_ = run::ViewedResult{.verdict = "fail", .score = 40.0};
    run.result_->deductions.push_back({50.0, 3.5, "canal: 2 mm deep"});
    run.result_->deductions.push_back({8.0, -1.0, "no radiograph"});
    run.result_->deductions.push_back({2.0, 7.25, "thrust far above the limit, again and again, for a long time"});
    return run;
}

void press(RunScreen& screen, int key) { screen.take({.kind = Input::Kind::key, .code = key, .is_pressed = true}); }

TEST(RunScreen, OpensTheMomentOfADeduction) {
    MadeRun run = ended_run();
    run.result_->deductions.resize(1);
    RunScreen screen(run);
    screen.draw(width, height, 0.0);
    // The deduction is a part of the card in the lower right corner, below the verdict.
    for (float y = 720; y > 400 && screen.timeline().is_following(); y -= 8) {
        screen.take({.kind = Input::Kind::move, .x = width - 150, .y = y});
        screen.take({.kind = Input::Kind::button, .code = 0, .is_pressed = true});
        screen.take({.kind = Input::Kind::button, .code = 0, .is_pressed = false});
    }
    ASSERT_FALSE(screen.timeline().is_following());
    EXPECT_NEAR(screen.state().time, 3.5, 17e-3);
}

TEST(RunScreen, StepsThroughDeductionsByKeys) {
    MadeRun run = ended_run();
    RunScreen screen(run);
    screen.draw(width, height, 0.0);
    const auto time_after = [&](int key) {
        press(screen, key);
        screen.draw(width, height, 0.0);
        return screen.state().time;
    };
    EXPECT_NEAR(time_after(Input::arrow_down), 3.5, 17e-3);
    EXPECT_NEAR(time_after(Input::arrow_down), 7.25, 17e-3) << "one without a time is left out";
    EXPECT_NEAR(time_after(Input::arrow_down), 7.25, 17e-3) << "it is the last one";
    EXPECT_NEAR(time_after(Input::arrow_up), 3.5, 17e-3);
}

TEST(RunScreen, LeavesByTheKeysOfItsButtonsOnly) {
    MadeRun run = ended_run();
    RunScreen screen(run);
    screen.draw(width, height, 0.0);
    using Kind = CardAction::Kind;
    for (const int key : {static_cast<int>('N'), static_cast<int>('D'), static_cast<int>(Input::enter)})
        press(screen, key);
    EXPECT_FALSE(screen.take_action()) << "it has no buttons";
    screen.set_buttons({.has_again = true, .has_debrief = true, .has_start_page = true});
    press(screen, 'N');
    EXPECT_EQ(screen.take_action()->kind, Kind::again);
    press(screen, Input::enter);
    EXPECT_EQ(screen.take_action()->kind, Kind::leave);
    press(screen, 'D');
    EXPECT_EQ(screen.take_action()->time, 0.5) << "three seconds before the largest deduction";
    screen.timeline().show_at(6.0);
    press(screen, 'D');
    const auto debrief = screen.take_action();
    EXPECT_EQ(debrief->kind, Kind::debrief);
    EXPECT_NEAR(debrief->time, 6.0, 17e-3);
}

TEST(RunScreen, KeepsTheCardOffThePicture) {
    MadeRun run = ended_run();
    RunScreen screen(run);
    screen.set_buttons({.has_again = true, .has_debrief = true, .has_start_page = true});
    screen.draw(width, height, 0.0);
    const Pixels open = screen.pixels();
    press(screen, 'E');
    screen.draw(width, height, 0.0);
    const Pixels closed = screen.pixels();
    const auto is_card = [](int r, int g, int b) { return r == 0x1a && g == 0x21 && b == 0x29; };
    constexpr Region right_panel{width - 292, 40, width, 760};
    EXPECT_GT(count(open, right_panel, is_card), 40'000);
    EXPECT_LT(count(closed, right_panel, is_card), 10'500) << "one line";
    EXPECT_EQ(count(open, picture_region, is_card), 0);
}

TEST(RunScreen, TakesNoKeyOfTheCardDuringARun) {
    MadeRun run;
    shown();
    run.pass_to(10.0);
    RunScreen screen(run);
    screen.set_buttons({.has_again = true, .has_debrief = true, .has_start_page = true});
    screen.draw(width, height, 0.0);
    for (const int key : {static_cast<int>('N'), static_cast<int>('D'), static_cast<int>(Input::enter)})
        press(screen, key);
    EXPECT_FALSE(screen.take_action());
}

TEST(RunScreen, ShowsTheNoteOfARunAndItsMotionWithoutBone) {
    shown();
    std::string error;
    const auto record = run::RecordedView::read(KERF_SOURCE_DIR "/tests/sessions/schema-4.db", "a test", error);
    ASSERT_NE(record, nullptr);
    RunScreen screen(*record);
    const auto picture_at = [&](double time) {
        screen.draw(width, height, 0.0);
        screen.timeline().show_at(time);
        screen.draw(width, height, 0.0);
        return screen.pixels();
    };
    const Pixels first = picture_at(0.0), last = picture_at(1.0);
    EXPECT_NE(first.rgb, last.rgb);
    EXPECT_GT(count(last, picture_region, is_steel), 500) << "the pointer";
    const auto is_note = [](int r, int g, int b) { return r > 200 && g > 130 && g < 190 && b < 60; };
    EXPECT_GT(count(last, {236, 700, 988, 760}, is_note), 200);
}

TEST(RunScreen, IsSoundInAnySize) {
    for (const auto& [wide, tall] : {std::pair{0, 0}, {1, 1}, {1, 800}, {60, 40}, {400, 300}, {760, 420}})
        EXPECT_NO_THROW(shown().picture(wide, tall)) << wide << " × " << tall;
    shown().picture();
}

}  // namespace
}  // namespace kerf::window
