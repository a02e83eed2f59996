// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>

#include "app/window/camera.h"
#include "app/window/gui.h"
#include "app/window/input.h"
#include "app/window/kept_picture.h"
#include "app/window/pixels.h"
#include "app/window/scene_renderer.h"
#include "app/window/start_page.h"

namespace kerf::window {

/// The rectangles of the start page, in pixels from the upper left corner.
struct StartLayout {
    static constexpr float top = 40.0f;
    float width = 0.0f, height = 0.0f;

    [[nodiscard]] float left() const noexcept { return std::clamp(0.23f * width, 200.0f, 300.0f); }
    [[nodiscard]] float right() const noexcept { return width - std::clamp(0.25f * width, 236.0f, 320.0f); }
    [[nodiscard]] float bottom() const noexcept { return height - std::clamp(0.28f * height, 140.0f, 240.0f); }
    /// Returns the upper and lower end of the picture, which lies between `left` and `right`.
    [[nodiscard]] float picture_low() const noexcept { return top + 46.0f; }
    [[nodiscard]] float picture_high() const noexcept { return picture_low() + 0.56f * (bottom() - picture_low()); }
};

/// The start page: procedures, picture and steps of the chosen one, the choices of the next run, earlier attempts.
/// Draws into the framebuffer that is bound.
class StartScreen {
public:
    /// Pre: a context of OpenGL 3.3 is current; both outlive this object.
    StartScreen(StartSource& source, StartSelection& selection);
    StartScreen(const StartScreen&) = delete;
    StartScreen& operator=(const StartScreen&) = delete;

    void take(const Input& input);
    /// Draws the page. Returns what the user has chosen in this frame. Throws std::runtime_error if the driver refuses.
    [[nodiscard]] StartAction draw(int width, int height);
    /// Returns whether a new frame would show more: inputs wait, or a widget reacts over several frames.
    [[nodiscard]] bool needs_frame() const noexcept { return gui_.has_waiting_input() || frames_due_ > 0; }
    [[nodiscard]] Pixels pixels() const { return read_pixels(width_, height_); }

private:
    void take_picture();
    void draw_picture(const StartLayout& layout);
    void paint(const StartLayout& layout, const Fonts& fonts);
    void paint_procedures(const StartLayout& layout, const Fonts& fonts);
    void paint_procedure(std::size_t index, const Fonts& fonts);
    void paint_folder(const Fonts& fonts);
    void paint_title(const StartLayout& layout, const Fonts& fonts) const;
    void paint_steps(const StartLayout& layout, const Fonts& fonts) const;
    void paint_choices(const StartLayout& layout, const Fonts& fonts);
    void paint_operator(const Fonts& fonts);
    void paint_variant(const Fonts& fonts);
    void paint_assist(const Fonts& fonts);
    void paint_devices(const Fonts& fonts) const;
    void paint_attempts(const StartLayout& layout, const Fonts& fonts);
    void paint_attempt(std::size_t index, const StartAttempt& attempt);
    [[nodiscard]] std::string why_not_start() const;
    [[nodiscard]] bool is_examination() const;
    [[nodiscard]] const StartProcedure* procedure() const;

    StartSource* source_;
    StartSelection* selection_;
    const StartPage* page_ = nullptr;  ///< of this frame
    StartAction action_;
    Gui gui_;
    std::array<char, 80> learner_{};
    std::array<char, 1024> folder_{};
    std::shared_ptr<const StartPicture> picture_;
    std::unique_ptr<SceneRenderer> renderer_;  ///< of picture_
    KeptPicture kept_;                         ///< of renderer_ with this camera
    bool was_examination_ = false;             ///< in the last frame
    Camera camera_;
    bool is_turning_ = false;
    float mouse_x_ = 0.0f, mouse_y_ = 0.0f;
    int width_ = 1, height_ = 1, frames_due_ = 0;
};

}  // namespace kerf::window
