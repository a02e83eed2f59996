// SPDX-License-Identifier: Apache-2.0
#include "app/window/mouse_lead.h"

#include <cmath>
#include <numbers>

namespace kerf::window {

namespace {

constexpr double slow = 0.2;                                    // [–] with Shift, and in bone
constexpr double notch_in_air = 1e-3, notch_in_bone = 0.25e-3;  // [m] of the wheel
constexpr double key_speed = 5e-3;                              // [m/s] of keys
constexpr double turn_speed = std::numbers::pi;                 // [rad/s] half a turn a second
constexpr double tilt_per_pixel = 0.15 * std::numbers::pi / 180.0;

/// Directions in which the tool is moved by right and up on the screen, and by the wheel [world, units].
struct Plane {
    Vec3 right, up, through;
};

/// Returns a direction without its part along an axis, as a unit; zero if nothing is left.
Vec3 without(Vec3 direction, Vec3 axis) {
    const Vec3 rest = direction - dot(direction, axis) * axis;
    return length(rest) > 0.2 ? normalized(rest) : Vec3{};
}

/// Returns the direction from the tip of the tool to its handle.
Vec3 handle_of(const LeadContext& context) { return rotate(context.world_from_tool.rotation, {0, 0, -1}); }

Plane plane_of(const LeadContext& context) {
    using Lead = run::ViewedTool::Lead;
    const Vec3 right = context.camera.right(), up = context.camera.up();
    const Vec3 away = -context.camera.towards();
    if (context.lead == Lead::facing) return {right, up, away};
    const bool is_blade = context.lead == Lead::in_blade;
    const Vec3 normal = rotate(context.world_from_tool.rotation, is_blade ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
    const bool is_on_edge = std::abs(dot(normal, away)) < 0.2;
    const Vec3 onwards = is_on_edge ? right + 0.5 * up : away;  // the wheel moves a blade so in the picture
    const Vec3 through = is_blade && dot(normal, onwards) < 0.0 ? -normal : normal;
    if (!is_on_edge) return {without(right, normal), without(up, normal), through};
    // On edge the plane is a line in the picture: the mouse moves along it, and across it into the picture.
    const Vec3 line = normalized(cross(normal, away)), depth = without(away, normal);
    if (std::abs(dot(line, right)) >= std::abs(dot(line, up)))
        return {dot(line, right) < 0.0 ? -line : line, depth, through};
    return {depth, dot(line, up) < 0.0 ? -line : line, through};
}

}  // namespace

run::ViewedTool::Lead lead_of(const run::ViewedScene& scene, const run::ViewedState& state) {
    return state.tool < scene.tools.size() ? scene.tools[state.tool].lead_by : run::ViewedTool::Lead::across;
}

bool MouseLead::take(const Input& input, const LeadContext& context) {
    switch (input.kind) {
        case Input::Kind::key:
            is_slow_ = input.has_shift;
            return take_key(input, context);
        case Input::Kind::button:
            if (input.code != keys_.grip_button) return false;
            is_gripping_ = input.is_pressed;
            return true;
        case Input::Kind::move: {
            const bool has_moved = has_position_;  // a first position is no motion
            const double right = static_cast<double>(input.x - x_), up = static_cast<double>(y_ - input.y);
            see_cursor(input.x, input.y);
            if (!has_moved || !is_gripping_ || totals_.is_paused) return false;
            if (is_tilting_)
                tilt(right, up, context);
            else
                move(right * context.metres_per_pixel, up * context.metres_per_pixel, context);
            return true;
        }
        case Input::Kind::wheel:
            if (input.has_control || totals_.is_paused) return false;
            turn_wheel(static_cast<double>(input.wheel) * (input.has_shift ? slow : 1.0), context);
            return true;
        case Input::Kind::character:
            break;
    }
    return false;
}

void MouseLead::see_cursor(float x, float y) noexcept {
    x_ = x;
    y_ = y;
    has_position_ = true;
}

bool MouseLead::take_key(const Input& input, const LeadContext& context) {
    const bool was_tilting = is_tilting_;
    const auto held = [&](int code, bool& flag) {
        if (input.code != code) return false;
        flag = input.is_pressed;
        return true;
    };
    const bool is_lead = held(keys_.feed, is_feeding_) || held(keys_.withdraw, is_withdrawing_) ||
                         held(keys_.turn_left, is_turning_left_) || held(keys_.turn_right, is_turning_right_) ||
                         held(keys_.tilt, is_tilting_) || held(Input::space, is_trigger_held_) ||
                         held(Input::arrow_left, is_left_) || held(Input::arrow_right, is_right_) ||
                         held(Input::arrow_up, is_up_) || held(Input::arrow_down, is_down_);
    if (is_tilting_ && !was_tilting) is_behind_ = dot(handle_of(context), context.camera.towards()) < -0.2;
    bool is_known = is_lead;
    if (input.is_pressed && !is_lead) {
        is_known = true;
        if (input.code == 'T')
            is_latched_ = !is_latched_;
        else if (input.code == Input::enter)
            ++totals_.actions;
        else if (input.code == Input::backspace)
            ++totals_.undos;
        else if (input.code == Input::escape)
            totals_.is_paused = !totals_.is_paused;
        else
            is_known = false;
    }
    totals_.is_driving = is_trigger_held_ || is_latched_;
    return is_known;
}

void MouseLead::pass(double seconds, const LeadContext& context) {
    if (totals_.is_paused) return;
    const double speed = key_speed * (is_slow_ ? slow : 1.0);
    const auto sign = [](bool plus, bool minus) { return (plus ? 1.0 : 0.0) - (minus ? 1.0 : 0.0); };
    totals_.along += sign(is_feeding_, is_withdrawing_) * speed * seconds;
    totals_.turned += sign(is_turning_right_, is_turning_left_) * turn_speed * (is_slow_ ? slow : 1.0) * seconds;
    const double right = sign(is_right_, is_left_), up = sign(is_up_, is_down_);
    if (right == 0.0 && up == 0.0) return;
    if (is_tilting_) {
        constexpr double pixels_per_second = 100.0;
        tilt(right * pixels_per_second * seconds, up * pixels_per_second * seconds, context);
    } else {
        move(right * speed * seconds, up * speed * seconds, context);
    }
}

/// Moves the aim in the plane of the tool.
void MouseLead::move(double right, double up, const LeadContext& context) {
    const double scale = (is_slow_ ? slow : 1.0) * (context.is_in_bone ? slow : 1.0);
    const Plane plane = plane_of(context);
    totals_.moved = totals_.moved + scale * (right * plane.right + up * plane.up);
}

/// Moves the aim through the plane of the tool: a drill along its axis.
void MouseLead::turn_wheel(double notches, const LeadContext& context) {
    const double distance = notches * (context.is_in_bone ? notch_in_bone : notch_in_air);
    if (context.lead == run::ViewedTool::Lead::across)
        totals_.along += distance;
    else
        totals_.moved = totals_.moved + distance * plane_of(context).through;
}

/// Tilts the tool about its tip, so that the handle follows the mouse. A motion along the handle tilts it towards the
/// viewer or away. The sense of that is kept during a drag: one that followed the handle would stop it in the plane of
/// the picture.
void MouseLead::tilt(double right, double up, const LeadContext& context) {
    const double scale = tilt_per_pixel * (is_slow_ ? slow : 1.0);
    const Vec3 towards = context.camera.towards(), handle = handle_of(context);
    const Vec3 moved = right * context.camera.right() + up * context.camera.up();
    const Vec3 shown = without(handle, towards);  // zero for a handle that points at the viewer
    const double lying = dot(moved, shown);
    const Vec3 shortened = (is_behind_ ? -1.0 : 1.0) * lying * cross(towards, shown);
    totals_.tilted = totals_.tilted + scale * (cross(handle, moved - lying * shown) + shortened);
}

}  // namespace kerf::window
