// SPDX-License-Identifier: Apache-2.0
#include "app/window/start_window.h"

#include <stdexcept>

#include "app/window/page_loop.h"
#include "app/window/start_screen.h"

namespace kerf::window {

std::optional<StartAction> show_start(GlfwWindow& window, StartSource& source, StartSelection& selection,
                                      const std::function<void(const Pixels&)>& on_picture,
                                      const std::function<bool()>& is_ended, std::string& error) {
    try {
        StartScreen screen(source, selection);
        StartAction action;
        show_page(window, screen, on_picture, is_ended, [&] {
            action = screen.draw(window.width(), window.height());
            return action.kind == StartAction::Kind::none;
        });
        if (action.kind != StartAction::Kind::none) return action;
    } catch (const std::runtime_error& fault) {
        error = fault.what();
    }
    return std::nullopt;
}

}  // namespace kerf::window
