// SPDX-License-Identifier: Apache-2.0
#include "app/window/start_window.h"

#include <epoxy/gl.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include "app/window/start_screen.h"

namespace kerf::window {

namespace {

// Without input the page is drawn five times a second: on a software renderer a picture of bone costs 30 ms.
constexpr auto frame = std::chrono::milliseconds(16);
constexpr int frames_without_input = 12;

}  // namespace

std::optional<StartAction> show_start(GlfwWindow& window, StartSource& source, StartSelection& selection,
                                      const std::function<void(const Pixels&)>& on_picture,
                                      const std::function<bool()>& is_ended, std::string& error) {
    try {
        StartScreen screen(source, selection);
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
                const StartAction action = screen.draw(window.width(), window.height());
                if (takes_picture && on_picture) on_picture(screen.pixels());
                window.swap();
                if (action.kind != StartAction::Kind::none) return action;
            }
            std::this_thread::sleep_for(frame);
        }
    } catch (const std::runtime_error& fault) {
        error = fault.what();
    }
    return std::nullopt;
}

}  // namespace kerf::window
