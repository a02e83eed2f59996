// SPDX-License-Identifier: Apache-2.0
#include "app/window/landmark_window.h"

#include <chrono>
#include <stdexcept>
#include <thread>

#include "app/window/landmark_screen.h"

namespace kerf::window {

namespace {

constexpr auto frame = std::chrono::milliseconds(16);
constexpr int frames_without_input = 12;  // a page without input is drawn five times a second

void draw_until_closed(GlfwWindow& window, LandmarkScreen& screen, const std::function<void(const Pixels&)>& on_picture,
                       const std::function<bool()>& wants_end) {
    screen.take(window.pointer());  // it reports motion only
    for (int unchanged = frames_without_input; !window.should_close() && !wants_end(); ++unchanged) {
        bool takes_picture = false;
        for (const Input& input : window.poll()) {
            takes_picture =
                takes_picture || (input.kind == Input::Kind::key && input.code == Input::f12 && input.is_pressed);
            screen.take(input);
        }
        if (screen.needs_frame() || takes_picture || unchanged >= frames_without_input) {
            unchanged = 0;
            screen.draw(window.width(), window.height());
            if (takes_picture) on_picture(screen.pixels());
            window.swap();
        }
        if (const auto copied = screen.take_copied()) window.copy(*copied);
        std::this_thread::sleep_for(frame);
    }
}

}  // namespace

std::string show_landmarks(GlfwWindow& window, LandmarkSource& source, LandmarkList& list,
                           const std::function<void(const Pixels&)>& on_picture,
                           const std::function<bool()>& wants_end) {
    try {
        LandmarkScreen screen(source, list);
        draw_until_closed(window, screen, on_picture, wants_end);
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
