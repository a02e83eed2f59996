// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "app/window/input.h"
#include "app/window/theme.h"

struct ImGuiContext;

namespace kerf::window {

/// ImGui on the present context of OpenGL, with the fonts of the panels. It stores no file.
class Gui {
public:
    Gui();
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    /// Passes an input on to widgets, in the next frame. Of a key or button that is pressed and released at once, each
    /// change gets a frame of its own.
    void take(const Input& input) { waiting_.push_back(input); }
    /// Returns whether inputs wait for a later frame.
    [[nodiscard]] bool has_waiting_input() const noexcept { return !waiting_.empty(); }
    /// Returns whether a widget of the last frame, such as an open list, lies below the mouse.
    [[nodiscard]] bool has_mouse() const;
    /// Returns whether a text field of the last frame takes the keys.
    [[nodiscard]] bool has_keyboard() const;
    /// Calls `paint` within a frame, and draws what it painted.
    void draw(int width, int height, const std::function<void(const Fonts&)>& paint);

private:
    void feed();

    ImGuiContext* context_;
    Fonts fonts_;
    std::vector<Input> waiting_;
};

}  // namespace kerf::window
