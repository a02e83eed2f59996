// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/window/camera.h"
#include "app/window/input.h"
#include "run/view/viewed_run.h"

namespace kerf::window {

/// What mouse and keys need to know of the picture and of the tool.
struct LeadContext {
    Camera camera;
    double metres_per_pixel = 1e-4;  ///< at the tool
    Pose world_from_tool{};
    run::ViewedTool::Lead lead = run::ViewedTool::Lead::across;
    bool is_in_bone = false;
};

/// Returns how a mouse moves the tool of a state.
[[nodiscard]] run::ViewedTool::Lead lead_of(const run::ViewedScene& scene, const run::ViewedState& state);

/// The keys that lead the tool; those of a left-handed layout mirror the others.
struct LeadKeys {
    int feed, withdraw, turn_left, turn_right, tilt;
    int grip_button;  ///< of the mouse; the other of left and right turns the view
};
inline constexpr LeadKeys right_handed{'W', 'S', 'Q', 'E', 'R', 0}, left_handed{'I', 'K', 'U', 'O', 'Y', 1};

/// Turns mouse and keys into totals that move the aim of a hand. While the grip button is held, the mouse moves the
/// tool in a plane: across the axis of a drill, in the blade of a saw, facing the camera for a burr. The wheel moves it
/// through that plane, keys along its axis. Nothing moves without an input.
class MouseLead {
public:
    /// Takes an input. Returns whether it was one of these.
    bool take(const Input& input, const LeadContext& context);
    /// Follows the cursor while the mouse does not lead.
    void see_cursor(float x, float y) noexcept;
    /// Lets keys that are held act for a time [s].
    void pass(double seconds, const LeadContext& context);

    [[nodiscard]] const run::MouseTotals& totals() const noexcept { return totals_; }
    /// Returns whether the mouse grips the tool: the cursor is not shown.
    [[nodiscard]] bool is_gripping() const noexcept { return is_gripping_; }
    [[nodiscard]] bool is_paused() const noexcept { return totals_.is_paused; }
    void set_left_handed(bool is_left) noexcept { keys_ = is_left ? left_handed : right_handed; }
    [[nodiscard]] bool is_left_handed() const noexcept { return keys_.grip_button == 1; }
    [[nodiscard]] const LeadKeys& keys() const noexcept { return keys_; }

private:
    bool take_key(const Input& input, const LeadContext& context);
    void move(double right, double up, const LeadContext& context);
    void turn_wheel(double notches, const LeadContext& context);
    void tilt(double right, double up, const LeadContext& context);

    LeadKeys keys_ = right_handed;
    run::MouseTotals totals_;
    bool is_gripping_ = false, is_latched_ = false, is_trigger_held_ = false, is_slow_ = false;
    bool is_feeding_ = false, is_withdrawing_ = false, is_turning_left_ = false, is_turning_right_ = false;
    bool is_tilting_ = false;
    bool is_right_ = false, is_left_ = false, is_up_ = false, is_down_ = false;  ///< arrow keys
    float x_ = 0.0f, y_ = 0.0f;
    bool has_position_ = false;  ///< of the cursor
    bool is_behind_ = false;     ///< the handle pointed away from the viewer when the tilt began
};

}  // namespace kerf::window
