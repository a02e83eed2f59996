// SPDX-License-Identifier: Apache-2.0
#include "app/window/landmark_window.h"

#include <stdexcept>

#include "app/window/landmark_screen.h"
#include "app/window/page_loop.h"

namespace kerf::window {

std::string show_landmarks(GlfwWindow& window, LandmarkSource& source, LandmarkList& list,
                           const std::function<void(const Pixels&)>& on_picture,
                           const std::function<bool()>& wants_end) {
    try {
        LandmarkScreen screen(source, list);
        show_page(window, screen, on_picture, wants_end, [&] {
            screen.draw(window.width(), window.height());
            if (const auto copied = screen.take_copied()) window.copy(*copied);
            return true;
        });
    } catch (const std::runtime_error& fault) {
        return fault.what();
    }
    return {};
}

std::string draw_landmarks(LandmarkSource& source, LandmarkList& list, char side,
                           const std::function<void(const Pixels&)>& on_picture) {
    constexpr int width = 1280, height = 800;
    try {
        LandmarkScreen screen(source, list);
        screen.see_from(side);
        for (int i = 0; i < 3; ++i) screen.draw(width, height);  // a widget gets its size in its first frames
        on_picture(screen.pixels());
    } catch (const std::runtime_error& fault) {
        return fault.what();
    }
    return {};
}

}  // namespace kerf::window
