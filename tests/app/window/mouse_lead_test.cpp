// SPDX-License-Identifier: Apache-2.0
// From mouse and keys to the motion of a hand's aim.
#include "app/window/mouse_lead.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace kerf::window {
namespace {

using Lead = run::ViewedTool::Lead;

/// The camera looks along −y of the world, z up: right on the screen is −x. The tool points along +x of the world.
LeadContext context(Lead lead = Lead::across) {
    LeadContext made;
    made.camera.see({0, 0, 0}, 0.05, {0, 1, 0}, {0, 0, 1});
    made.metres_per_pixel = 1e-4;
    made.world_from_tool = {{0, 0, 0}, quat_between({0, 0, 1}, {1, 0, 0})};
    made.lead = lead;
    return made;
}

void drag(MouseLead& lead, const LeadContext& with, float right, float down, int button = 0) {
    lead.take({.kind = Input::Kind::move, .x = 300, .y = 300}, with);
    lead.take({.kind = Input::Kind::button, .code = button, .is_pressed = true}, with);
    lead.take({.kind = Input::Kind::move, .x = 300 + right, .y = 300 + down}, with);
    lead.take({.kind = Input::Kind::button, .code = button, .is_pressed = false}, with);
}

bool press(MouseLead& lead, int key, bool is_pressed = true, bool has_shift = false) {
    return lead.take({.kind = Input::Kind::key, .code = key, .is_pressed = is_pressed, .has_shift = has_shift},
                     context());
}

void expect_near(Vec3 value, Vec3 expected) { EXPECT_LT(length(value - expected), 1e-9); }

TEST(MouseLead, MovesNothingWithoutAnInput) {
    MouseLead lead;
    for (int i = 0; i < 100; ++i) lead.pass(0.02, context());
    lead.take({.kind = Input::Kind::move, .x = 700, .y = 10}, context());
    expect_near(lead.totals().moved, {});
    expect_near(lead.totals().tilted, {});
    EXPECT_EQ(lead.totals().along, 0.0);
    EXPECT_EQ(lead.totals().turned, 0.0);
    EXPECT_FALSE(lead.totals().is_driving);
}

TEST(MouseLead, MovesNothingByTheFirstPositionOfTheCursor) {
    MouseLead lead;
    lead.take({.kind = Input::Kind::button, .code = 0, .is_pressed = true}, context());
    lead.take({.kind = Input::Kind::move, .x = 640, .y = 400}, context());
    expect_near(lead.totals().moved, {});
    lead.take({.kind = Input::Kind::move, .x = 640, .y = 350}, context());
    expect_near(lead.totals().moved, {0, 0, 5e-3});
}

TEST(MouseLead, MovesADrillAcrossItsAxis) {
    MouseLead lead;
    drag(lead, context(), 0, -50);  // upwards
    expect_near(lead.totals().moved, {0, 0, 5e-3});
    // To the right on the screen is along the drill: it is seen from the side, so depth of the picture replaces it.
    MouseLead other;
    drag(other, context(), 40, 0);
    EXPECT_NEAR(other.totals().moved.x, 0.0, 1e-9);
    EXPECT_NEAR(std::abs(other.totals().moved.y), 4e-3, 1e-9);
}

TEST(MouseLead, MovesABurrInThePlaneOfThePicture) {
    MouseLead lead;
    drag(lead, context(Lead::facing), 30, 20);
    expect_near(lead.totals().moved, {-3e-3, 0, -2e-3});
}

TEST(MouseLead, MovesASawInItsBlade) {
    LeadContext with = context(Lead::in_blade);
    const Vec3 normal = rotate(with.world_from_tool.rotation, {0, 1, 0});
    MouseLead lead;
    drag(lead, with, 30, 20);
    EXPECT_NEAR(dot(lead.totals().moved, normal), 0.0, 1e-12);
    EXPECT_GT(length(lead.totals().moved), 2e-3);
}

TEST(MouseLead, MovesAFifthInBoneAndWithShift) {
    LeadContext in_bone = context();
    in_bone.is_in_bone = true;
    MouseLead lead;
    drag(lead, in_bone, 0, -50);
    expect_near(lead.totals().moved, {0, 0, 1e-3});
    MouseLead fine;
    press(fine, Input::left_shift, true, true);
    drag(fine, context(), 0, -50);
    expect_near(fine.totals().moved, {0, 0, 1e-3});
}

TEST(MouseLead, FeedsByWheelAndKeys) {
    MouseLead lead;
    lead.take({.kind = Input::Kind::wheel, .wheel = 3}, context());
    EXPECT_NEAR(lead.totals().along, 3e-3, 1e-12);
    LeadContext in_bone = context();
    in_bone.is_in_bone = true;
    lead.take({.kind = Input::Kind::wheel, .wheel = -2}, in_bone);
    EXPECT_NEAR(lead.totals().along, 2.5e-3, 1e-12);
    EXPECT_FALSE(lead.take({.kind = Input::Kind::wheel, .has_control = true, .wheel = 1}, context())) << "zooms";
    press(lead, 'W');
    lead.pass(0.2, context());
    press(lead, 'W', false);
    lead.pass(0.2, context());
    EXPECT_NEAR(lead.totals().along, 3.5e-3, 1e-12);
    press(lead, 'S');
    lead.pass(0.1, context());
    EXPECT_NEAR(lead.totals().along, 3.0e-3, 1e-12);
}

TEST(MouseLead, MovesSawAndBurrOutOfTheirPlaneByWheel) {
    const auto turned = [](const LeadContext& with) {
        MouseLead lead;
        lead.take({.kind = Input::Kind::wheel, .wheel = 2}, with);
        EXPECT_EQ(lead.totals().along, 0.0);
        return lead.totals().moved;
    };
    expect_near(turned(context(Lead::facing)), {0, -2e-3, 0});  // away from the viewer
    LeadContext with = context(Lead::in_blade);
    const Vec3 normal = rotate(with.world_from_tool.rotation, {0, 1, 0});
    const double sign = dot(normal, Vec3{0, -1, 0}) < 0.0 ? -1.0 : 1.0;
    expect_near(turned(with), 2e-3 * sign * normal);
    with.is_in_bone = true;
    expect_near(turned(with), 0.5e-3 * sign * normal);
}

// Each motion of a tool has an input in each view, so that no operation needs another view.
TEST(MouseLead, ReachesEachPositionAndAxisInEachView) {
    for (const Lead lead : {Lead::across, Lead::in_blade, Lead::facing})
        for (const auto& [towards, upwards] :
             {std::pair{Vec3{0, 1, 0}, Vec3{0, 0, 1}}, std::pair{Vec3{1, 0, 0}, Vec3{0, 0, 1}},
              std::pair{Vec3{-1, 0, 0}, Vec3{0, 0, 1}}, std::pair{Vec3{0.6, 0.64, 0.48}, Vec3{0, 0, 1}},
              std::pair{Vec3{0, 1, 0}, Vec3{1, 0, 1}}}) {
            LeadContext with = context(lead);
            with.camera.see({0, 0, 0}, 0.05, towards, upwards);
            const auto moved = [&](float right, float down, float notches) {
                MouseLead made;
                drag(made, with, right, down);
                made.take({.kind = Input::Kind::wheel, .wheel = notches}, with);
                return made.totals().moved + made.totals().along * rotate(with.world_from_tool.rotation, {0, 0, 1});
            };
            const double volume = dot(cross(moved(10, 0, 0), moved(0, -10, 0)), moved(0, 0, 1));
            EXPECT_GT(std::abs(volume), 0.2 * 1e-9);
            const auto tilted = [&](float right, float down) {
                MouseLead made;
                press(made, 'R');
                drag(made, with, right, down);
                return made.totals().tilted;
            };
            const Vec3 right = tilted(100, 0), up = tilted(0, -100);
            const Vec3 handle = rotate(with.world_from_tool.rotation, {0, 0, -1});
            EXPECT_NEAR(dot(right, handle) + dot(up, handle), 0.0, 1e-12) << "a tilt turns no tool about its axis";
            EXPECT_GT(length(cross(right, up)), 0.1 * length(right) * length(right));
        }
}

TEST(MouseLead, TiltsAHandleInThePictureTowardsTheViewer) {
    const LeadContext with = context();  // the handle points along −x of the world: to the right; the viewer is at +y
    MouseLead lead;
    press(lead, 'R');
    drag(lead, with, -100, 0);  // towards the tip
    const Vec3 handle = rotate(with.world_from_tool.rotation, {0, 0, -1});
    const Vec3 moved = cross(lead.totals().tilted, handle);
    EXPECT_NEAR(moved.y, length(lead.totals().tilted), 1e-12);
    EXPECT_NEAR(length(lead.totals().tilted), 15.0 * std::numbers::pi / 180.0, 1e-9);
}

// The handle follows a drag along it from the viewer's side through the plane of the picture.
TEST(MouseLead, TiltsThroughThePlaneOfThePicture) {
    LeadContext with = context();
    with.world_from_tool.rotation = quat_between({0, 0, -1}, {0.0, 0.5, std::sqrt(0.75)});  // handle up, to the viewer
    MouseLead lead;
    press(lead, 'R');
    for (int i = 0; i < 10; ++i) {
        const Vec3 before = lead.totals().tilted;
        drag(lead, with, 0, -50);
        const Quat turn = quat_from_rotation_vector(lead.totals().tilted - before);
        with.world_from_tool.rotation = turn * with.world_from_tool.rotation;
    }
    EXPECT_LT(dot(rotate(with.world_from_tool.rotation, {0, 0, -1}), with.camera.towards()), -0.5);
}

TEST(MouseLead, TurnsHalfATurnASecond) {
    MouseLead lead;
    press(lead, 'E');
    lead.pass(0.5, context());
    press(lead, 'E', false);
    EXPECT_NEAR(lead.totals().turned, 0.5 * std::numbers::pi, 1e-12);
    press(lead, 'Q');
    lead.pass(1.0, context());
    EXPECT_NEAR(lead.totals().turned, -0.5 * std::numbers::pi, 1e-12);
}

TEST(MouseLead, TiltsSoThatTheHandleFollowsTheMouse) {
    const LeadContext with = context();
    MouseLead lead;
    press(lead, 'R');
    drag(lead, with, 0, -100);  // the handle goes up
    press(lead, 'R', false);
    const Vec3 handle = rotate(with.world_from_tool.rotation, {0, 0, -1});
    const Vec3 moved = cross(lead.totals().tilted, handle);
    EXPECT_GT(moved.z, 0.2);
    EXPECT_NEAR(length(lead.totals().tilted), 15.0 * std::numbers::pi / 180.0, 1e-9) << "0.15 degrees a pixel";
    expect_near(lead.totals().moved, {});
}

TEST(MouseLead, DrivesWhileSpaceIsHeldOrLatched) {
    MouseLead lead;
    press(lead, Input::space);
    EXPECT_TRUE(lead.totals().is_driving);
    press(lead, Input::space, false);
    EXPECT_FALSE(lead.totals().is_driving);
    press(lead, 'T');
    press(lead, 'T', false);
    EXPECT_TRUE(lead.totals().is_driving);
    press(lead, 'T');
    EXPECT_FALSE(lead.totals().is_driving);
}

TEST(MouseLead, CountsActionsAndUndos) {
    MouseLead lead;
    press(lead, Input::enter);
    press(lead, Input::enter, false);
    press(lead, Input::enter);
    press(lead, Input::backspace);
    EXPECT_EQ(lead.totals().actions, 2u);
    EXPECT_EQ(lead.totals().undos, 1u);
}

TEST(MouseLead, MovesNothingWhilePaused) {
    MouseLead lead;
    press(lead, Input::escape);
    EXPECT_TRUE(lead.is_paused());
    drag(lead, context(), 50, 50);
    lead.take({.kind = Input::Kind::wheel, .wheel = 3}, context());
    press(lead, 'W');
    lead.pass(1.0, context());
    press(lead, 'W', false);
    expect_near(lead.totals().moved, {});
    EXPECT_EQ(lead.totals().along, 0.0);
    press(lead, Input::escape);
    EXPECT_FALSE(lead.is_paused());
}

TEST(MouseLead, MirrorsItsKeysForTheOtherHand) {
    MouseLead lead;
    lead.set_left_handed(true);
    drag(lead, context(), 0, -50, 0);
    expect_near(lead.totals().moved, {});
    drag(lead, context(), 0, -50, 1);
    expect_near(lead.totals().moved, {0, 0, 5e-3});
    EXPECT_FALSE(press(lead, 'W'));
    EXPECT_TRUE(press(lead, 'I'));
}

}  // namespace
}  // namespace kerf::window
