// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <thread>

#include "app/window/glfw_window.h"
#include "app/window/pixels.h"

namespace kerf::window {

/// Shows a page until the user closes the window, `is_ended` returns true or `draw` returns false. Without input the
/// page is drawn five times a second: on a software renderer a picture of bone costs 30 ms.   [main]
/// @param on_picture  called with a picture of the page when the user presses F12; may be empty
/// @param draw        draws the screen into the window; returns whether the page stays
template <class Screen, class Draw>
void show_page(GlfwWindow& window, Screen& screen, const std::function<void(const Pixels&)>& on_picture,
               const std::function<bool()>& is_ended, const Draw& draw) {
    constexpr auto frame = std::chrono::milliseconds(16);
    constexpr int frames_without_input = 12;
    screen.take(window.pointer());  // it reports motion only
    for (int unchanged = frames_without_input; !window.should_close() && !is_ended(); ++unchanged) {
        bool takes_picture = false;
        for (const Input& input : window.poll()) {
            takes_picture =
                takes_picture || (input.kind == Input::Kind::key && input.code == Input::f12 && input.is_pressed);
            screen.take(input);
        }
        if (screen.needs_frame() || takes_picture || unchanged >= frames_without_input) {
            unchanged = 0;
            const bool stays = draw();
            if (takes_picture && on_picture) on_picture(screen.pixels());
            window.swap();
            if (!stays) return;
        }
        std::this_thread::sleep_for(frame);
    }
}

}  // namespace kerf::window
