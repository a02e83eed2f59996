// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "app/window/glfw_window.h"
#include "app/window/mouse_lead.h"
#include "app/window/run_screen.h"
#include "kerf/math.hpp"
#include "run/device/mouse_totals.h"

namespace kerf::test {

/// Keyboard and mouse of an X display: events as a user's hands cause them, by xdotool.
class DisplayHands {
public:
    DisplayHands() {
        if (std::system("command -v xdotool > /dev/null") == 0) pipe_ = popen("xdotool -", "w");
        if (pipe_ == nullptr) throw std::runtime_error("xdotool does not start; install xdotool");
    }
    ~DisplayHands() { pclose(pipe_); }
    DisplayHands(const DisplayHands&) = delete;
    DisplayHands& operator=(const DisplayHands&) = delete;

    /// Adds a command of xdotool.
    void add(const std::string& command) { batch_ += command + "\n"; }
    /// Sends what was added, then a button that the window does not know: its release ends the batch. A key would not
    /// do: GLFW takes presses of a key in the same millisecond for one.
    void send() {
        batch_ += "mousedown 8\nmouseup 8\n";
        std::fputs(batch_.c_str(), pipe_);
        std::fflush(pipe_);
        batch_.clear();
    }
    [[nodiscard]] static bool ends_batch(const window::Input& input) noexcept {
        constexpr int eighth = 3;  // as GLFW counts: X has the wheel between
        return input.kind == window::Input::Kind::button && input.code == eighth && !input.is_pressed;
    }

private:
    FILE* pipe_ = nullptr;
    std::string batch_;
};

/// A person who produces given totals of a mouse by events of mouse and keys, and corrects what the window has not yet
/// done.
///
/// They hold the grip button all the time, tilt with `R` and the mouse, and use Shift in bone.
class WindowPerson {
public:
    /// @param wanted  totals that the window is to reach; read on the thread of `act`
    WindowPerson(const window::RunScreen& screen, run::MouseBox& wanted) : screen_(&screen), wanted_(&wanted) {}

    /// Puts the cursor on the picture. Pre: the window has the focus, as GLFW gives it to a new one.
    void begin() {
        hands_.add("mousemove 640 300");
        hands_.send();
    }
    /// Releases all that is held.
    void end() {
        hold("shift", is_fine_, false);
        hold("e", is_turning_right_, false);
        hold("q", is_turning_left_, false);
        hold("r", is_tilting_, false);
        if (is_gripping_) hands_.add("mouseup 1");
        is_gripping_ = false;
        hands_.send();
    }
    /// Causes the events of a frame.
    void act() {
        const run::MouseTotals& wanted = wanted_->get();
        const run::MouseTotals& has = screen_->lead().totals();
        const window::LeadContext context = screen_->lead_context();
        const Vec3 shaft = rotate(context.world_from_tool.rotation, {0, 0, 1});
        owed_ = owed_ + change(wanted, last_wanted_, shaft) - change(has, last_has_, shaft);
        owed_tilt_ = owed_tilt_ + (wanted.tilted - last_wanted_.tilted) - (has.tilted - last_has_.tilted);
        owed_turn_ += (wanted.turned - last_wanted_.turned) - (has.turned - last_has_.turned);
        // About its own axis a tool is turned, not tilted.
        owed_turn_ += dot(owed_tilt_, shaft);
        owed_tilt_ = owed_tilt_ - dot(owed_tilt_, shaft) * shaft;
        last_wanted_ = wanted;
        last_has_ = has;

        if (!is_gripping_) hands_.add("mousedown 1");
        is_gripping_ = true;
        const bool is_turned = std::abs(owed_turn_) < 0.5 * fine_turn;
        hold("shift", is_fine_, std::abs(owed_turn_) < turning && (context.is_in_bone || !is_turned));
        const double step = is_fine_ ? fine_turn : step_of_turn;
        hold("e", is_turning_right_, owed_turn_ > 0.5 * step);
        hold("q", is_turning_left_, owed_turn_ < -0.5 * step);
        hold("r", is_tilting_, length(owed_tilt_) > (is_tilting_ ? tilted : begins_to_tilt));
        if (is_tilting_) {
            drag(solve_tilt(owed_tilt_, context));
            owed_ = {};
        } else {
            move(context);
        }
        for (; last_actions_ != wanted.actions; ++last_actions_) press("Return");
        if (wanted.is_driving != is_driving_) press("t");
        is_driving_ = wanted.is_driving;
        hands_.send();
    }

private:
    static constexpr double step_of_turn = 0.05, fine_turn = 0.01;  // [rad] of a frame
    static constexpr double turning = 0.1;                          // [rad]
    static constexpr double tilted = 0.004, begins_to_tilt = 0.01;  // [rad]
    static constexpr double fastest = 80.0;                         // [pixels] of a frame
    static constexpr double probed = 100.0;                         // [pixels]

    struct Drag {
        double right = 0.0, up = 0.0;  ///< [pixels]
    };

    static Vec3 change(const run::MouseTotals& now, const run::MouseTotals& before, Vec3 shaft) noexcept {
        return now.moved - before.moved + (now.along - before.along) * shaft;
    }
    void hold(const std::string& key, bool& is_held, bool should) {
        if (is_held != should) hands_.add((should ? "keydown --delay 0 " : "keyup --delay 0 ") + key);
        is_held = should;
    }
    void press(const std::string& key) {
        hands_.add("keydown --delay 0 " + key);
        hands_.add("keyup --delay 0 " + key);
    }
    void drag(const Drag& by) {
        const auto whole = [](double pixels) { return std::lround(std::clamp(pixels, -fastest, fastest)); };
        const long right = whole(by.right), down = whole(-by.up);
        if (right != 0 || down != 0)
            hands_.add("mousemove_relative -- " + std::to_string(right) + " " + std::to_string(down));
    }

    /// Returns the totals that a drag would add, from a copy of the lead.
    [[nodiscard]] run::MouseTotals dragged(Drag by, const window::LeadContext& context) const {
        window::MouseLead tried = screen_->lead();
        // The keys of this batch come before its drag.
        tried.take({.kind = window::Input::Kind::key, .code = 'R', .is_pressed = is_tilting_, .has_shift = is_fine_},
                   context);
        tried.take({.kind = window::Input::Kind::button, .code = 0, .is_pressed = true}, context);
        tried.take({.kind = window::Input::Kind::move, .x = 0.0f, .y = 0.0f}, context);
        const run::MouseTotals begun = tried.totals();
        tried.take(
            {.kind = window::Input::Kind::move, .x = static_cast<float>(by.right), .y = static_cast<float>(-by.up)},
            context);
        run::MouseTotals done = tried.totals();
        done.moved = done.moved - begun.moved;
        done.tilted = done.tilted - begun.tilted;
        return done;
    }
    /// Returns the drag whose tilt comes nearest to a rotation.
    [[nodiscard]] Drag solve_tilt(Vec3 tilt, const window::LeadContext& context) const {
        const Vec3 right = (1.0 / probed) * dragged({probed, 0.0}, context).tilted;
        const Vec3 up = (1.0 / probed) * dragged({0.0, probed}, context).tilted;
        const double rr = dot(right, right), ru = dot(right, up), uu = dot(up, up);
        const double determinant = rr * uu - ru * ru;
        if (determinant < 1e-6 * rr * uu || determinant == 0.0) return {};
        const double r = dot(right, tilt), u = dot(up, tilt);
        return {(uu * r - ru * u) / determinant, (rr * u - ru * r) / determinant};
    }
    /// Moves the tool by mouse and wheel by what is owed.
    void move(const window::LeadContext& context) {
        const Vec3 right = (1.0 / probed) * dragged({probed, 0.0}, context).moved;
        const Vec3 up = (1.0 / probed) * dragged({0.0, probed}, context).moved;
        const Vec3 notch = notch_of(context);
        const Vec3 normal = cross(right, up);
        const double volume = dot(normal, notch);
        if (std::abs(volume) < 1e-3 * length(normal) * length(notch) || volume == 0.0) return;
        const double notches = dot(normal, owed_) / volume;
        drag({dot(cross(up, notch), owed_) / volume, dot(cross(notch, right), owed_) / volume});
        const long whole = std::clamp(std::lround(notches), -4L, 4L);
        for (long i = 0; i < std::abs(whole); ++i) {
            const std::string button = whole > 0 ? "4" : "5";
            hands_.add("mousedown " + button);
            hands_.add("mouseup " + button);
        }
    }
    [[nodiscard]] Vec3 notch_of(const window::LeadContext& context) const {
        window::MouseLead tried = screen_->lead();
        const run::MouseTotals before = tried.totals();
        tried.take({.kind = window::Input::Kind::wheel, .has_shift = is_fine_, .wheel = 1.0f}, context);
        return change(tried.totals(), before, rotate(context.world_from_tool.rotation, {0, 0, 1}));
    }

    const window::RunScreen* screen_;
    run::MouseBox* wanted_;
    DisplayHands hands_;
    run::MouseTotals last_wanted_, last_has_;
    Vec3 owed_{}, owed_tilt_{};  ///< [m], [rad] that the window has not done
    double owed_turn_ = 0.0;     ///< [rad]
    std::uint32_t last_actions_ = 0;
    bool is_gripping_ = false, is_fine_ = false, is_turning_right_ = false, is_turning_left_ = false;
    bool is_tilting_ = false, is_driving_ = false;
};

}  // namespace kerf::test
