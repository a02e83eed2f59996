// SPDX-License-Identifier: Apache-2.0
// The start page, drawn without a display and used with clicks and keys.
#include "app/window/start_screen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "app/window/offscreen.h"
#include "core/field/grid/level_set.h"
#include "run/view/surface_view.h"

namespace kerf::window {
namespace {

constexpr int width = 1280, height = 800;

/// Two procedures, an attempt at the first, one device that is ready.
class TwoProcedures final : public StartSource {
public:
    TwoProcedures() {
        contents.procedures = {{.file = "a.yaml", .id = "a", .title = "First", .summary = "1 step"},
                               {.file = "b.yaml", .id = "b", .title = "Second", .summary = "2 steps"}};
        contents.details = {.steps = {{"Drill", "pilot", {"depth at least 30 mm"}, {}}},
                            .rehearsals = {{"expert", "With care"}},
                            .time_limit = 90.0};
        contents.attempts = {
            {.procedure = "a", .number = 1, .folder = "x/001", .verdict = "pass", .score = 90.0, .has_session = true}};
        contents.devices = {{"udp/1", "a hand", ""}};
    }
    const StartPage& page(StartSelection& selection) override {
        contents.learner_refusal = selection.learner.find(' ') != std::string::npos ? "No blanks." : "";
        return contents;
    }
    std::shared_ptr<const StartPicture> picture(const StartSelection&) override { return drawn; }
    [[nodiscard]] std::string picture_state() const override { return "Drawing the bone"; }
    void open_folder(const std::string& folder) override { opened = folder; }
    void forget_message() override {}

    StartPage contents;
    std::shared_ptr<const StartPicture> drawn;
    std::string opened = "nothing";
};

struct Page {
    std::unique_ptr<Offscreen> offscreen;
    TwoProcedures source;
    StartSelection selection;
    std::unique_ptr<StartScreen> screen;

    Page() {
        std::string error;
        offscreen = Offscreen::open(width, height, error);
        if (offscreen == nullptr) throw std::runtime_error(error);
        screen = std::make_unique<StartScreen>(source, selection);
        static_cast<void>(screen->draw(width, height));
    }
    /// Draws until nothing changes. Returns the first action.
    StartAction settle() {
        StartAction first;
        for (int i = 0; i < 200 && screen->needs_frame(); ++i) {
            const StartAction action = screen->draw(width, height);
            if (first.kind == StartAction::Kind::none) first = action;
        }
        return first;
    }
    StartAction click(float x, float y) {
        screen->take({.kind = Input::Kind::move, .x = x, .y = y});
        settle();
        screen->take({.kind = Input::Kind::button, .code = 0, .is_pressed = true});
        screen->take({.kind = Input::Kind::button, .code = 0, .is_pressed = false});
        return settle();
    }
    void type(const std::string& text) {
        for (const char c : text) screen->take({.kind = Input::Kind::character, .code = c});
        settle();
    }
    void press(int key) {
        screen->take({.kind = Input::Kind::key, .code = key, .is_pressed = true});
        screen->take({.kind = Input::Kind::key, .code = key, .is_pressed = false});
        settle();
    }
    Pixels picture() {
        static_cast<void>(screen->draw(width, height));
        return screen->pixels();
    }
};

// Points on the page of 1280 × 800.
constexpr std::pair second_procedure{100.0f, 135.0f}, start_button{1120.0f, 315.0f}, code_field{1120.0f, 79.0f},
    watch_button{1140.0f, 650.0f}, folder_field{140.0f, 740.0f};

int count(const Pixels& pixels, int left, int top, int right, int bottom,
          const std::function<bool(int, int, int)>& is_one) {
    int found = 0;
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) {
            const std::uint8_t* p = &pixels.rgb[3 * static_cast<std::size_t>(y * pixels.width + x)];
            found += is_one(p[0], p[1], p[2]) ? 1 : 0;
        }
    return found;
}

TEST(StartScreen, ChoosesAClickedProcedure) {
    Page page;
    page.selection.variant = "of-the-first";
    page.click(second_procedure.first, second_procedure.second);
    EXPECT_EQ(page.selection.procedure, 1u);
    EXPECT_EQ(page.selection.variant, "");
}

TEST(StartScreen, StartsByItsButtonOnce) {
    Page page;
    EXPECT_EQ(page.click(start_button.first, start_button.second).kind, StartAction::Kind::start);
    EXPECT_EQ(page.screen->draw(width, height).kind, StartAction::Kind::none);
}

TEST(StartScreen, KeepsItsButtonForAnyChoice) {
    for (const bool has_variant : {false, true})
        for (const char* device : {"", "udp/1"}) {
            Page page;
            if (has_variant) page.source.contents.procedures[0].variants = {{"left", "The left side"}};
            page.selection.device = device;
            page.selection.mode = has_variant ? "exam" : "practice";
            page.picture();
            EXPECT_EQ(page.click(start_button.first, start_button.second).kind, StartAction::Kind::start)
                << has_variant << device;
        }
}

TEST(StartScreen, HidesLimitsOfAnExamination) {
    Page page;
    page.selection.device = "udp/1";
    page.source.contents.details.steps[0].limits = {"thrust at most 60 N"};
    const Pixels practice = page.picture();
    page.selection.mode = "exam";
    const Pixels exam = page.picture();
    page.source.contents.details.steps[0].limits.clear();
    EXPECT_EQ(exam.rgb, page.picture().rgb) << "limits change nothing";
    EXPECT_NE(practice.rgb, exam.rgb);
}

TEST(StartScreen, TypesTheCodeOfALearner) {
    Page page;
    page.click(code_field.first, code_field.second);
    page.type("L18");
    page.press(Input::backspace);
    page.type("7");
    EXPECT_EQ(page.selection.learner, "L17");
}

TEST(StartScreen, StartsNothingWithAWrongCode) {
    Page page;
    page.click(code_field.first, code_field.second);
    page.type("A B");
    EXPECT_EQ(page.click(start_button.first, start_button.second).kind, StartAction::Kind::none);
}

TEST(StartScreen, WatchesAnAttemptAgain) {
    Page page;
    const StartAction action = page.click(watch_button.first, watch_button.second);
    EXPECT_EQ(action.kind, StartAction::Kind::watch);
    EXPECT_EQ(action.attempt, 0u);
}

TEST(StartScreen, ListsAttemptsOfTheChosenProcedureOnly) {
    Page page;
    page.selection.procedure = 1;
    EXPECT_EQ(page.click(watch_button.first, watch_button.second).kind, StartAction::Kind::none);
    page.selection.shows_all_attempts = true;
    EXPECT_EQ(page.click(watch_button.first, watch_button.second).kind, StartAction::Kind::watch);
}

TEST(StartScreen, OpensTheFolderThatIsTyped) {
    Page page;
    page.click(folder_field.first, folder_field.second);
    page.type("/x");
    page.press(Input::enter);
    EXPECT_EQ(page.source.opened, "/x");
}

TEST(StartScreen, ShowsTheLampOfADevice) {
    Page page;
    const auto is_green = [](int r, int g, int b) { return g > 170 && r < 80 && b > 110 && b < 160; };
    EXPECT_GT(count(page.picture(), 970, 346, 992, 401, is_green), 50);
    page.source.contents.devices[0].problem = "it is in use";
    EXPECT_EQ(count(page.picture(), 970, 299, 992, 354, is_green), 0);
}

TEST(StartScreen, ListsAFileThatCannotBeUsedInRed) {
    Page page;
    const auto is_red = [](int r, int g, int b) { return r > 120 && 5 * g < 3 * r && 5 * b < 3 * r; };
    const int before = count(page.picture(), 0, 170, 290, 600, is_red);
    page.source.contents.refused = {"broken.yaml: line 2: a bracket is not closed"};
    EXPECT_EQ(before, 0);
    EXPECT_GT(count(page.picture(), 0, 170, 290, 600, is_red), 50);
}

TEST(StartScreen, DrawsAndTurnsTheBone) {
    Page page;
    auto picture = std::make_shared<StartPicture>();
    Body body;
    body.id = "ball";
    body.surface = LevelSet::build(Grid::covering({-9e-3, -9e-3, -9e-3}, {9e-3, 9e-3, 9e-3}, 1e-3),
                                   [](Vec3 p) { return std::max(length(p) - 8e-3, p.x - 2e-3); });
    body.materials.push_back({.id = "cortical", .density = 1850.0, .border = {}});
    PresentBone bone(body, 1);
    run::SurfaceView view;
    picture->surface = view.update(bone, {true});
    picture->scene.tissues = {{"cortical", {232, 220, 196}}};
    picture->scene.tools.emplace_back();
    picture->scene.steps = {{.title = "Drill", .length = 5e-3}};
    picture->state.body_count = 1;
    picture->state.bodies[0] = {.kind = run::ViewedBody::Kind::bone, .world_from_body = identity_pose()};
    page.source.drawn = picture;

    const Pixels first = page.picture();
    const auto is_bone = [](int r, int g, int b) { return r > 110 && r > g && g > b && r - b < 90; };
    EXPECT_GT(count(first, 300, 90, 950, 340, is_bone), 5'000);
    page.screen->take({.kind = Input::Kind::move, .x = 600, .y = 200});
    page.screen->take({.kind = Input::Kind::button, .code = 0, .is_pressed = true});
    page.screen->take({.kind = Input::Kind::move, .x = 700, .y = 220});
    page.screen->take({.kind = Input::Kind::button, .code = 0, .is_pressed = false});
    page.settle();
    EXPECT_NE(first.rgb, page.picture().rgb);
}

TEST(StartScreen, IsSoundInAnySize) {
    Page page;
    for (const auto& [wide, tall] : {std::pair{0, 0}, {1, 1}, {60, 40}, {400, 300}, {900, 600}})
        EXPECT_NO_THROW(static_cast<void>(page.screen->draw(wide, tall))) << wide << " × " << tall;
}

}  // namespace
}  // namespace kerf::window
