// SPDX-License-Identifier: Apache-2.0
// The landmark page, drawn without a display and used with clicks and keys.
#include "app/window/landmark_screen.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "app/window/offscreen.h"
#include "tests/app/window/ball.h"

namespace kerf::window {
namespace {

using namespace literals;
using test::ball_centre, test::ball_radius;

constexpr int width = 1280, height = 800;

struct Page {
    std::unique_ptr<Offscreen> offscreen;
    test::PickedFile ball;
    LandmarkList list;
    std::unique_ptr<LandmarkScreen> screen;

    Page() {
        std::string error;
        offscreen = Offscreen::open(width, height, error);
        if (offscreen == nullptr) throw std::runtime_error(error);
        screen = std::make_unique<LandmarkScreen>(*ball.bone, list);
        screen->draw(width, height);
        screen->see_from('2');
        settle();
    }
    void settle() {
        for (int i = 0; i < 100 && screen->needs_frame(); ++i) screen->draw(width, height);
    }
    void move_to(ImVec2 at) {
        screen->take({.kind = Input::Kind::move, .x = at.x, .y = at.y});
        settle();
    }
    void button(bool is_pressed) {
        screen->take({.kind = Input::Kind::button, .code = 0, .is_pressed = is_pressed});
        settle();
    }
    void click(ImVec2 at) {
        move_to(at);
        button(true);
        button(false);
    }
    void press(int key, bool has_control = false, bool has_shift = false) {
        screen->take({.kind = Input::Kind::key,
                      .code = key,
                      .is_pressed = true,
                      .has_control = has_control,
                      .has_shift = has_shift});
        screen->take({.kind = Input::Kind::key, .code = key, .has_control = has_control, .has_shift = has_shift});
        settle();
    }
    void type(const std::string& text) {
        for (const char c : text) screen->take({.kind = Input::Kind::character, .code = c});
        settle();
    }
    /// Returns the point of the ball's back that lies so far to the right and above of the middle, seen from behind.
    [[nodiscard]] static Vec3 on_back(double right, double above) {
        const Vec3 off{right, 0, above};
        return ball_centre + off + Vec3{0, std::sqrt(ball_radius * ball_radius - dot(off, off)), 0};
    }
    [[nodiscard]] ImVec2 pixel(Vec3 point) const {
        return screen->area().pixel_of(screen->camera(), point).value_or(ImVec2{});
    }
};

TEST(LandmarkScreen, PicksTheClickedPointOfTheSurface) {
    Page page;
    const Vec3 point = Page::on_back(6.0_mm, -4.0_mm);
    page.click(page.pixel(point));
    ASSERT_EQ(page.list.all().size(), 1U);
    EXPECT_LT(length(page.list.all()[0].at - point), 0.03_mm);
    EXPECT_EQ(page.list.all()[0].id, "point_1");
}

TEST(LandmarkScreen, PicksNothingBesideTheBone) {
    Page page;
    page.click(page.pixel(ball_centre + Vec3{23.0_mm, 0, 0}));
    page.click({100.0f, 700.0f});  // in the panel
    EXPECT_TRUE(page.list.all().empty());
}

TEST(LandmarkScreen, TurnsByADragAndPicksNothing) {
    Page page;
    const Vec3 eye = page.screen->camera().eye();
    page.move_to({790.0f, 400.0f});
    page.button(true);
    page.move_to({860.0f, 420.0f});
    page.button(false);
    EXPECT_TRUE(page.list.all().empty());
    EXPECT_GT(length(page.screen->camera().eye() - eye), 5.0_mm);
}

TEST(LandmarkScreen, DragsAPointAlongTheSurface) {
    Page page;
    const Vec3 first = Page::on_back(6.0_mm, -4.0_mm), second = Page::on_back(-3.0_mm, 7.0_mm);
    page.click(page.pixel(first));
    page.move_to(page.pixel(first));
    page.button(true);
    page.move_to(page.pixel(Page::on_back(0, 0)));
    page.move_to(page.pixel(second));
    page.button(false);
    ASSERT_EQ(page.list.all().size(), 1U);
    EXPECT_LT(length(page.list.all()[0].at - second), 0.03_mm);
    page.press('Z', true);
    EXPECT_LT(length(page.list.all()[0].at - first), 0.03_mm) << "one change";
}

TEST(LandmarkScreen, PicksByKeysAlone) {
    Page page;
    page.move_to(page.pixel(Page::on_back(0, 0)));
    page.press(Input::space);
    for (int i = 0; i < 20; ++i) page.press(Input::arrow_right);
    page.press(Input::space);
    ASSERT_EQ(page.list.all().size(), 2U);
    EXPECT_LT(page.list.all()[1].at.x, page.list.all()[0].at.x + 30.0_mm);
    EXPECT_GT(length(page.list.all()[1].at - page.list.all()[0].at), 1.0_mm);
    page.press('A');
    ASSERT_EQ(page.list.all().size(), 1U);
    EXPECT_TRUE(page.list.all()[0].to);
    page.press(Input::erase);
    EXPECT_TRUE(page.list.all().empty());
    page.press('Z', true);
    EXPECT_EQ(page.list.all().size(), 1U);
}

TEST(LandmarkScreen, RenamesTheSelectedPoint) {
    Page page;
    page.click(page.pixel(Page::on_back(0, 0)));
    page.press(Input::f2);
    page.type("tip");
    page.press(Input::enter);
    EXPECT_EQ(page.list.all()[0].id, "tip");
    page.press('X');  // a command again, no letter
    EXPECT_EQ(page.list.all()[0].id, "tip");
}

TEST(LandmarkScreen, ReplacesTheSelectedPoint) {
    Page page;
    const Vec3 second = Page::on_back(-3.0_mm, 7.0_mm);
    page.click(page.pixel(Page::on_back(0, 0)));
    page.press('R');
    page.click(page.pixel(second));
    ASSERT_EQ(page.list.all().size(), 1U);
    EXPECT_LT(length(page.list.all()[0].at - second), 0.03_mm);
}

TEST(LandmarkScreen, CopiesAndWritesByKeys) {
    Page page;
    page.press('C', true);
    EXPECT_FALSE(page.screen->take_copied()) << "nothing is picked";
    page.click(page.pixel(Page::on_back(0, 0)));
    page.press('C', true);
    const std::string copied = page.screen->take_copied().value_or("");
    EXPECT_TRUE(copied.starts_with("  points:\n    point_1: {at: 3 16 5 mm, tolerance: 1 mm")) << copied;
    page.press('S', true);
    EXPECT_TRUE(page.list.all().empty());
    EXPECT_EQ(test::contents_of(page.ball.file), test::ball_text + "\nlandmarks:\n" + copied);
}

TEST(LandmarkScreen, WritesNoTwoOfOneName) {
    Page page;
    page.list.add("tip", Page::on_back(0, 0));
    page.list.add("tip", Page::on_back(2.0_mm, 0));
    page.press('S', true);
    EXPECT_EQ(page.list.all().size(), 2U);
    EXPECT_EQ(test::contents_of(page.ball.file), test::ball_text);
}

TEST(LandmarkScreen, MarksAPointWhereItIs) {
    Page page;
    const ImVec2 at = page.pixel(Page::on_back(5.0_mm, 5.0_mm));
    page.click(at);
    page.move_to({20.0f, 700.0f});
    const Pixels pixels = page.screen->pixels();
    const auto colour = [&](float x, float y) {
        return &pixels.rgb[3 * (static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x))];
    };
    EXPECT_GT(colour(at.x, at.y)[0], 220) << "orange, as the selected one";
    EXPECT_LT(colour(at.x, at.y)[2], 40);
    EXPECT_GT(colour(at.x + 60.0f, at.y + 60.0f)[2], 60) << "bone";
}

TEST(LandmarkScreen, DrawsInAnySize) {
    Page page;
    page.press(Input::f1);
    for (const auto& [wide, tall] : {std::pair(1, 1), {40, 30}, {320, 200}, {2000, 400}}) page.screen->draw(wide, tall);
}

}  // namespace
}  // namespace kerf::window
