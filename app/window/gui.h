// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

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

    /// Calls `paint` within a frame, and draws what it painted.
    void draw(int width, int height, const std::function<void(const Fonts&)>& paint);

private:
    ImGuiContext* context_;
    Fonts fonts_;
};

}  // namespace kerf::window
