// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/window/camera.h"
#include "app/window/gui.h"
#include "app/window/input.h"
#include "app/window/kept_picture.h"
#include "app/window/landmark_list.h"
#include "app/window/landmark_overlay.h"
#include "app/window/landmark_page.h"
#include "app/window/pixels.h"
#include "app/window/scene_renderer.h"
#include "app/window/step_view.h"

namespace kerf::window {

/// The page on which a user picks landmarks of a bone. Draws into the framebuffer that is bound.
class LandmarkScreen {
public:
    /// Pre: a context of OpenGL 3.3 is current; both outlive this object. Throws std::runtime_error if the driver
    /// refuses.
    LandmarkScreen(LandmarkSource& source, LandmarkList& list);
    LandmarkScreen(const LandmarkScreen&) = delete;
    LandmarkScreen& operator=(const LandmarkScreen&) = delete;

    void take(const Input& input);
    void draw(int width, int height);
    /// Returns whether a new frame would show more.
    [[nodiscard]] bool needs_frame() const noexcept;
    [[nodiscard]] Pixels pixels() const { return read_pixels(width_, height_); }
    /// Returns the text that the user has copied since the last call.
    [[nodiscard]] std::optional<std::string> take_copied() { return std::exchange(copied_, std::nullopt); }
    /// Shows the bone from a side: '1' front, '2' back, '3' left, '4' right, '5' head, '6' foot; '0' from above the
    /// right of the back.
    void see_from(char side);
    [[nodiscard]] PictureArea area() const;
    [[nodiscard]] const Camera& camera() const noexcept { return camera_; }

private:
    void take_key(const Input& input);
    void take_list_key(const Input& input);
    void take_shortcut(int key);
    void take_button(const Input& input);
    void take_motion(const Input& input);
    void take_arrow(const Input& input);
    void advance();
    void turn(double right, double up);
    void zoom(double factor);
    void change_view();
    void change_list();
    void move_cursor(float x, float y);

    void pick();
    void put_point(Vec3 at);
    void join();
    void remove();
    void undo();
    void copy_yaml();
    void write();
    [[nodiscard]] std::string free_name(const std::string& stem) const;
    [[nodiscard]] std::string problem_of(std::size_t index) const;
    [[nodiscard]] std::string problem_of_any() const;
    void report(const std::string& message, bool is_bad);

    void draw_bone();
    void paint(const Fonts& fonts);
    void paint_panel(const Fonts& fonts);
    void paint_picked(const Fonts& fonts);
    void paint_selected(const Fonts& fonts);
    void paint_actions(const Fonts& fonts);
    void paint_written(const Fonts& fonts) const;
    void paint_bottom(const Fonts& fonts) const;
    void paint_cursor() const;
    void paint_keys(const Fonts& fonts) const;

    LandmarkSource* source_;
    LandmarkList* list_;
    Gui gui_;
    SceneRenderer renderer_;
    run::ViewedState state_;
    Sphere bone_;
    Camera camera_;
    KeptPicture kept_;
    LandmarkOverlay overlay_;
    bool is_overlay_old_ = true;

    float cursor_x_ = 0.0f, cursor_y_ = 0.0f;  ///< [pixel] follows the mouse and the arrow keys
    std::optional<SurfacePoint> under_cursor_;
    std::array<bool, 3> is_held_{};         ///< buttons, pressed in the picture
    std::array<bool, 4> arrows_{};          ///< left, right, up, down
    bool turns_ = false, is_slow_ = false;  ///< what the arrows do
    float pressed_x_ = 0.0f, pressed_y_ = 0.0f;
    bool has_moved_ = false;  ///< since the left button was pressed
    std::optional<LandmarkOverlay::End> dragged_, replaced_;

    std::array<char, 80> name_{};
    std::optional<std::size_t> named_;  ///< landmark in `name_`
    bool focuses_name_ = false, is_naming_ = false;
    std::string message_;
    bool is_message_bad_ = false, shows_keys_ = false;
    std::optional<std::string> copied_;
    int width_ = 0, height_ = 0, frames_due_ = 0;
};

}  // namespace kerf::window
